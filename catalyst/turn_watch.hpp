#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "catalyst/watch_thread.hpp"

namespace breccia::insitu {

/// How the code of a pipeline can be requested to return. Called with the watch's mutex locked; each may be null.
struct Interruption {
  void (*begin)() = nullptr;            ///< a turn begins
  void (*ask)(double limit) = nullptr;  ///< it has taken more than the limit, s
  void (*withdraw)() = nullptr;         ///< it has come back, or counts anew
};

/// Ends a pipeline that does not return. It is requested to return, if possible, after `limit`, and again every second;
/// at three times the limit the program ends, with a line that names it, since no rank could continue.
class TurnWatch {
 public:
  /// @param limit  s; 0: none
  explicit TurnWatch(double limit, const Interruption& interruption = {});
  TurnWatch(const TurnWatch&) = delete;
  TurnWatch& operator=(const TurnWatch&) = delete;

  /// A turn, as long as it lives. @pre of the run's own thread
  class Turn {
   public:
    /// @param who  "pipeline stress"
    Turn(TurnWatch& watch, const std::string& who) : watch_(watch) { watch_.begin(who); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    ~Turn() { watch_.end(); }

   private:
    TurnWatch& watch_;
  };

  /// The turn counts anew: it has waited for other ranks, not worked.
  void restart();

 private:
  void begin(const std::string& who);
  void end();
  void look();
  void withdraw() const;
  void restart_clock();

  std::chrono::duration<double> limit_;
  Interruption interruption_;
  std::string who_;
  std::chrono::steady_clock::time_point began_;
  std::chrono::duration<double> stopped_before_{0.0};  ///< of the thread, when the turn began
  std::optional<WatchThread> thread_;                  ///< none without a limit; the last member: it reads the others
};

}  // namespace breccia::insitu
