#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "catalyst/watch_thread.hpp"

namespace breccia::insitu {

/// Ends what a script does without end. Its Python is interrupted (KeyboardInterrupt) when it has taken `limit`, and
/// again every second; what does not come back to Python, such as a wait in a library, ends the program at three times
/// the limit, with a line that names the pipeline, since no rank could go on.
class ScriptWatch {
 public:
  /// @param limit  s; 0: none
  explicit ScriptWatch(double limit);
  ScriptWatch(const ScriptWatch&) = delete;
  ScriptWatch& operator=(const ScriptWatch&) = delete;

  /// A script's turn, as long as it lives. @pre of the thread that has started Python
  class Turn {
   public:
    Turn(ScriptWatch& watch, const std::string& pipeline) : watch_(watch) { watch_.begin(pipeline); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    ~Turn() { watch_.end(); }

   private:
    ScriptWatch& watch_;
  };

  /// The turn counts anew: it has waited for other ranks, not worked.
  void restart();

  /// Whether the present turn, or the last one, has been interrupted.
  [[nodiscard]] bool interrupted() const;

 private:
  void begin(const std::string& pipeline);
  void end();
  void look();

  std::chrono::duration<double> limit_;
  std::string pipeline_;
  std::chrono::steady_clock::time_point began_;
  std::optional<WatchThread> thread_;  ///< none without a limit; the last member: it reads the others
};

}  // namespace breccia::insitu
