#pragma once

#include "case/case.hpp"

namespace breccia {

/// Prepares a case for display only: reading a file is aborted after a minute, unless the case sets a time limit.
inline void limit_preview(case_::Case& input) {
  constexpr double kPreviewSeconds = 60;
  if (input.mesh.time_limit == 0) input.mesh.time_limit = kPreviewSeconds;
}

}  // namespace breccia
