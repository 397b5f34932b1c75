#pragma once

#include "domains/domain.hpp"

namespace breccia {

// Ranks receive each other's speeds one or two steps later. Contact searches and proxies are still in time, and results
// are the same on any number of ranks, as long as no node moves further in a step n than
//   L_n = min(2 L_(n-1) + r H, H/2),
// L_(n-1) the furthest motion of any node in the step before, H the mean size of a contactor, and r = kUnforeseen, or
// kUnforeseenAtStart in the first step of a stage, whose constraints and loads may begin at their full values. Points
// that move further than H/2 may pass a surface undetected. A step in which a node exceeds the limit is an error, the
// same on any number of ranks (also on one), thrown at the start of the second step after it, when all ranks know.
// Without contact nothing depends on it.
inline constexpr double kUnforeseen = 0.005, kUnforeseenAtStart = 0.04;

/// A node that this rank moves.
struct FastestNode {
  GlobalId node = -1;
  double speed = 0;  ///< m/s
};
/// O(nodes)
[[nodiscard]] FastestNode fastest_node(const Domain& domain);

/// The largest r H of the last steps, m; 0 on one rank, which knows all of them. @param unknown  number of these steps
[[nodiscard]] double unforeseen_motion(const Domain& domain, int unknown);

/// After the motion of a step: keeps this rank's fastest node if it may have exceeded the limit. O(1), O(nodes) then.
void note_motion(Domain& domain);

/// After the largest speed of an earlier step has been received: whether a node exceeded the limit in it. O(1)
void record_received_motion(Domain& domain);

/// Where ranks are connected anew: the same for the step before the last of a state that was written before they knew.
void record_motion_before_last(Domain& domain);

/// At the start of a step: throws SimulationError, the same on all ranks, if a node exceeded the limit two steps ago.
/// Collective if it throws.
void check_motion(const Domain& domain);

/// After the last step of a run: checks this step and the one before it. Collective. Throws likewise.
/// @pre conclude() has been called
void check_last_motion(Domain& domain);

}  // namespace breccia
