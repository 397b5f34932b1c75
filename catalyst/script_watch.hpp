#pragma once

#include "catalyst/turn_watch.hpp"

namespace breccia::insitu {

/// A watch over scripts, whose Python is interrupted (KeyboardInterrupt). What does not come back to Python, such as a
/// wait in a library, ends the program. One a process. @pre turns are of the thread that has started Python
class ScriptWatch : public TurnWatch {
 public:
  /// @param limit  s; 0: none
  explicit ScriptWatch(double limit);

  /// Whether the present turn, or the last one, has been interrupted.
  [[nodiscard]] static bool interrupted();
};

}  // namespace breccia::insitu
