#pragma once

#include "case/case.hpp"
#include "commands/advice.hpp"

namespace breccia {

/// Values and stages that are allowed and hardly ever meant: an angle where a coefficient of friction is asked for,
/// densities, wave speeds and strains of no solid, motions and loads whose course lies beyond the end of their stage,
/// constraints or gravity that a later stage does not repeat, gravity on an absorbing base that has carried nothing
/// yet. O(entries).
[[nodiscard]] Advice plausibility_advice(const case_::Case& input);

}  // namespace breccia
