#pragma once

#include <string>
#include <vector>

#include "output/frames/frame.hpp"

namespace breccia {

// The parts of a summary for people on conditions and gauges.

/// Lines for people; empty: none became true.
[[nodiscard]] std::string conditions_text(const std::vector<ConditionReport>& conditions);
/// Lines for people: of forces and displacements the components above a tenth of the largest, elongations, strains
/// and broken joints; kMostPeakLines at most, then how many more there are.
[[nodiscard]] std::string peaks_text(const std::vector<PeakReport>& peaks);

}  // namespace breccia
