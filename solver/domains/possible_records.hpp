#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "case/case.hpp"
#include "model/whole_model.hpp"
#include "state/records.hpp"

namespace breccia {

/// Whether every index of the records points to something that the model has: elements, groups, bodies, joint laws,
/// faces, corners and axes; offsets belong to points of their elements, which are among the records.
/// Entries of constraints are only known to be no less than 0: demand_constraints. O(records log records).
[[nodiscard]] bool are_possible(const Records& records, const WholeModel& whole);

/// Checks the consistency of a checkpoint beyond its checksums. Throws InputError with the file: the bytes of the model
/// are incomplete, or an index is out of range.
/// @param whole_model  pack(WholeModel), domains/piece_mesh.hpp
void demand_possible(const std::filesystem::path& file, std::span<const std::byte> whole_model, const Records& records);

/// Checks against the case of a checkpoint: every anchor belongs to a constraint of the stage. Throws InputError with
/// the file. O(holds).
/// @param stage  of the case, in which the checkpoint was written
void demand_constraints(const std::filesystem::path& file, const Records& records, const case_::Stage& stage);

}  // namespace breccia
