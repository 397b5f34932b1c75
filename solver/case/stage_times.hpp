#pragma once

#include "case/case.hpp"

namespace breccia::case_ {

/// A stage whose functions of time do the same earlier, and which ends earlier, because stages have ended before their
/// time. Zeros change nothing.
/// @param functions, end  s, by which
[[nodiscard]] Stage brought_forward(Stage stage, double functions, double end);

}  // namespace breccia::case_
