#pragma once

#include <vector>

#include "output/frame.hpp"
#include "simulation/stepper.hpp"

namespace breccia {

/// A picture of this rank's originals at the stepper's time; looks, changes nothing. Collective.
/// @param parts  the others stay empty;  @param cost  (originals) relative, ascending by id
/// @param load   working time of this rank over that of the mean rank
[[nodiscard]] Frame make_frame(const Stepper& stepper, std::int64_t number, const FrameParts& parts, const std::vector<double>& cost,
                               double load);

}  // namespace breccia
