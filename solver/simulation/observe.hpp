#pragma once

#include <string>
#include <vector>

#include "output/frame.hpp"
#include "simulation/fragment_labels.hpp"
#include "simulation/stepper.hpp"
#include "state/state_hash.hpp"

namespace breccia {

/// What is told of a running model; looks, changes nothing.

/// A group whose forces and motion are recorded.
struct Gauge {
  std::string group;
  std::vector<Index> nodes;                  ///< that this rank counts, ascending
  Index volume_group = -1;                   ///< -1: a surface; contact forces are those of volume groups only
  std::vector<std::size_t> constraints;      ///< entries of the present stage that name this group
};

/// One line of the history of the whole model: budget and gauges of the last sampled step. Collective.
/// @param time  s, of that step
[[nodiscard]] HistoryRow make_history_row(const Stepper& stepper, const std::vector<Gauge>& gauges, double time);

/// Positions, velocities and histories of the whole model, the same for any number of ranks. Collective.
[[nodiscard]] StateHash hash_of(const Stepper& stepper);

}  // namespace breccia
