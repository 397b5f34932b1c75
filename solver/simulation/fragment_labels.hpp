#pragma once

#include "simulation/stepper.hpp"
#include "state/fragments.hpp"

namespace breccia {

/// Fragments of the whole model as of now: joints that have failed no longer hold, opened or not. Labels of this rank's
/// originals and proxies; the count is that of the model. Collective. O(elements + joints) and O(pairs of labels that meet at
/// borders of domains, on all ranks).
[[nodiscard]] Fragments find_fragments(const Stepper& stepper);

}  // namespace breccia
