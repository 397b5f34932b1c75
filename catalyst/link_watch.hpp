#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

namespace breccia::insitu {

/// Cuts a link over TCP short that waits in vain: VTK's sockets know no time limit, so that a ParaView that is stopped,
/// or a service that says nothing, would hold the run for ever. A thread of its own shuts down the sockets to the port,
/// and the call that waits for them returns with an error.
class LinkWatch {
 public:
  /// @param port  of the other side
  /// @param run_ends  asked by the thread while a call goes on: whether it must not be waited for any longer
  LinkWatch(int port, std::function<bool()> run_ends);
  LinkWatch(const LinkWatch&) = delete;
  LinkWatch& operator=(const LinkWatch&) = delete;
  ~LinkWatch();

  /// A call begins that may take so long; nothing: as long as the run does not end.
  void begin(std::optional<std::chrono::milliseconds> limit);
  /// It has returned. @return  whether it was cut short
  bool end();

 private:
  void watch();

  int port_;
  std::function<bool()> run_ends_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool active_ = false, cut_ = false, leave_ = false;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
  std::set<int> before_;  ///< sockets that were there when the call began
  std::thread thread_;
};

}  // namespace breccia::insitu
