#pragma once

#include "case/case.hpp"
#include "domains/partition.hpp"
#include "output/checkpoint/checkpoint.hpp"
#include "parallel/communicator.hpp"
#include "simulation/run.hpp"

namespace breccia {

/// A rank's part of the state of a checkpoint, from which a partition continues. @param from  its records are moved
[[nodiscard]] Snapshot checkpoint_snapshot(const case_::Case& input, const Communicator& communicator,
                                           Checkpoint& from);

/// The same for another case: before its first stage, with what new laws change, which are the stable step and the
/// energy that the state holds. Collective.
[[nodiscard]] Snapshot start_snapshot(const case_::Case& input, const Communicator& communicator,
                                      const StartOptions& options, Checkpoint& from);

}  // namespace breccia
