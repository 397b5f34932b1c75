#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace breccia::insitu {

/// A thread that looks now and then after a call of the run's own thread, as long as that call goes on.
class WatchThread {
 public:
  /// @param look  called with the mutex held, at these intervals, while a call goes on
  WatchThread(std::chrono::milliseconds interval, std::function<void()> look);
  WatchThread(const WatchThread&) = delete;
  WatchThread& operator=(const WatchThread&) = delete;
  ~WatchThread();

  /// A call begins or has ended. @param change  of what `look` reads, with the mutex held
  void begin(const std::function<void()>& change);
  void end(const std::function<void()>& change);
  /// Changes what `look` reads in between.
  void change(const std::function<void()>& change);
  /// Time for which this process was stopped, as a suspended job is, while calls went on: no call has taken it. To be
  /// read with the mutex held: in `look` or in a change.
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
