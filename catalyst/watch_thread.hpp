#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace breccia::insitu {

/// A thread that monitors a call of the run's own thread at intervals, during that call.
class WatchThread {
 public:
  /// @param look  called with the mutex locked, at these intervals, during a call
  WatchThread(std::chrono::milliseconds interval, std::function<void()> look);
  WatchThread(const WatchThread&) = delete;
  WatchThread& operator=(const WatchThread&) = delete;
  ~WatchThread();

  /// A call begins or has ended. @param change  of the data that `look` reads, with the mutex locked
  void begin(const std::function<void()>& change);
  void end(const std::function<void()>& change);
  /// Changes what `look` reads in between.
  void change(const std::function<void()>& change);
  /// Time for which this process was stopped, as a suspended job is, during calls: it does not count as time of a call.
  /// To be read with the mutex locked: in `look` or in a change.
  [[nodiscard]] std::chrono::duration<double> stopped() const { return stopped_; }

 private:
  void watch();

  std::chrono::milliseconds interval_;
  std::function<void()> look_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool active_ = false, leave_ = false;
  std::chrono::duration<double> stopped_{0.0};
  std::thread thread_;
};

}  // namespace breccia::insitu
