#pragma once

#include <string>
#include <vector>

#include "model/whole_model.hpp"
#include "parallel/communicator.hpp"
#include "state/records.hpp"

namespace breccia {

/// Finds the corners on surfaces again (tag_corners) where the stages of a run break other surfaces than those of the
/// run that left the records. Only elements that had a corner there before can have one now. Collective.
/// @param cut   all surfaces that either run breaks
/// @param mine  this rank's originals; their corners are replaced
/// O(elements on surfaces, of all ranks).
void tag_corners_anew(const Communicator& communicator, const WholeModel& whole, const std::vector<std::string>& cut,
                      Records& mine);

}  // namespace breccia
