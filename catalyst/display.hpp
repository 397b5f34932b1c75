#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

#include "catalyst/ranks.hpp"

namespace breccia::insitu {

/// True when the X display that $DISPLAY names can be opened.
[[nodiscard]] bool display_opens();

/// "" when pictures can be made here: a display opens or Xvfb is installed; else what to do about it.
[[nodiscard]] std::string display_problem();

/// A display for pictures, as long as it lives: the one that $DISPLAY names, or an Xvfb of our own, one a machine,
/// started by the lowest rank there; it ends with this object and with the process that has started it, however that
/// ends. Sets $DISPLAY meanwhile.
class Display {
 public:
  /// Collective, as is its end. Throws PipelineError, on all ranks. @pre ranks outlives this
  explicit Display(const Ranks& ranks);
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  ~Display();

 private:
  const Ranks& ranks_;
  pid_t xvfb_ = 0;
  bool replaced_ = false;
  bool was_set_ = false;
  std::string old_;
};

}  // namespace breccia::insitu
