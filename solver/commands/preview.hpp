#pragma once

#include "case/case.hpp"

namespace breccia {

/// Makes a case one that is only shown: a file that takes more than a minute to read is given up, unless the case
/// itself says how long it may take.
inline void limit_preview(case_::Case& input) {
  constexpr double kPreviewSeconds = 60;
  if (input.mesh.time_limit == 0) input.mesh.time_limit = kPreviewSeconds;
}

}  // namespace breccia
