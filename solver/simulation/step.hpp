#pragma once

#include "domains/domain.hpp"

namespace breccia {

/// Optional results of a step beside the motion.
struct StepOptions {
  bool sample = false;       ///< the energies at t_n are sampled on the way: Domain::sample
  StepSignals signals = {};  ///< of this rank, received by all ranks in the next step: Signals::received
};

/// One step: takes x_n, v_(n-1/2) to x_(n+1), v_(n+1/2) by central differences. Collective.
///
/// On several ranks the sweep begins with the elements that others wait for, which leave at once, as does, before the
/// sweep, what ranks send each other. So a rank waits for another only where that is behind by the rest of a sweep.
/// What the sweep finds out, speeds and failures, is received two steps later: a rank that has failed stands still
/// until then. A rank computes the forces on its originals, nothing else: joints and couples with an element of another
/// rank are computed on both, from the same numbers in the same order.
///
/// Throws SimulationError on all ranks when a velocity was not finite: on a rank that is alone, and when the energies
/// are sampled, in that step, else in the one after the next, or in conclude().
void step(Domain& domain, const StepOptions& options = {});

}  // namespace breccia
