#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <set>

#include "catalyst/watch_thread.hpp"

namespace breccia::insitu {

/// Closes a TCP connection that does not respond: VTK's sockets know no time limit, so that a stopped ParaView, or
/// another service at the port, would block the run for ever. A thread of its own shuts down the sockets to the port,
/// and the call that waits for them returns with an error.
class LinkWatch {
 public:
  /// @param port  of the other side
  /// @param run_ends  called by the thread during a call: whether to stop waiting
  LinkWatch(int port, std::function<bool()> run_ends);
  LinkWatch(const LinkWatch&) = delete;
  LinkWatch& operator=(const LinkWatch&) = delete;

  /// A call begins that may take so long; nothing: as long as the run does not end.
  void begin(std::optional<std::chrono::milliseconds> limit);
  /// It has returned. @return  whether it was cut short
  bool end();

 private:
  void look();

  int port_;
  std::function<bool()> run_ends_;
  bool cut_ = false;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
  std::chrono::duration<double> stopped_before_{0.0};  ///< of the thread, when the call began
  std::set<int> before_;                               ///< sockets that were there when the call began
  WatchThread thread_;                                 ///< the last member: it reads the others
};

}  // namespace breccia::insitu
