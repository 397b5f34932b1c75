#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

#include "catalyst/ranks.hpp"

namespace breccia::insitu {

/// "" when pictures can be made here: the display of $BRECCIA_DISPLAY can be drawn on, or, where that is not, Xvfb is
/// installed or the one of $DISPLAY can be drawn on; else what to do about it.
[[nodiscard]] std::string display_problem();

/// The process continues when the server of an open X display (a pointer of Xlib's) closes.
void spare_process(void* display);

/// A display for pictures, as long as it lives: the one that $BRECCIA_DISPLAY names; else an Xvfb of our own, one a
/// machine, started by the lowest rank there, which ends with this object and with the process that has started it,
/// however that ends; else the one of $DISPLAY. Sets $DISPLAY meanwhile. Errors of X end the process no more.
class Display {
 public:
  /// Collective, as is its end. Throws PipelineError, on all ranks. @pre ranks outlives this
  explicit Display(const Ranks& ranks);
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  ~Display();

  /// Whether its server has closed: then ParaView must not draw any more. On this rank.
  [[nodiscard]] bool lost() const;

 private:
  void set(const std::string& name);
  void start_own();

  const Ranks& ranks_;
  void* link_ = nullptr;  ///< of Xlib: detects that the server has closed
  pid_t xvfb_ = 0;
  bool replaced_ = false;
  bool was_set_ = false;
  std::string old_;
};

}  // namespace breccia::insitu
