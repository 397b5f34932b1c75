#pragma once

#include <vector>

#include "case/case.hpp"
#include "model/model.hpp"

namespace breccia {

/// Two entries of a stage that ask nodes to move differently along an axis; the later one rules them.
struct ConstraintConflict {
  const case_::Constraint* earlier;
  const case_::Constraint* later;
  int axis;
  Index shared = 0;  ///< nodes of the mesh that both name
  Index of_earlier = 0;
  bool whole = false;  ///< the later entry leaves nothing of the earlier one on this axis
};

/// By stage, later entry, earlier entry, axis. Entries that ask for the same do not conflict. O(corners log corners)
/// for each entry of a pair that could.
/// @param model  of the whole mesh; a bare one will do. The result points into `input`.
[[nodiscard]] std::vector<ConstraintConflict> constraint_conflicts(const case_::Case& input, const Model& model);

}  // namespace breccia
