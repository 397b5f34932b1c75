#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "model/whole_model.hpp"
#include "state/records.hpp"

namespace breccia {

/// Whether every index of the records points to something that the model has: elements, groups, bodies, joint laws,
/// faces, corners and axes. O(records).
[[nodiscard]] bool are_possible(const Records& records, const WholeModel& whole);

/// What the checksums of a checkpoint do not tell: that it was a run that wrote it. Throws InputError that names the
/// file: the bytes of the model are not whole, or an index points beyond it.
/// @param whole_model  pack(WholeModel), domains/piece_mesh.hpp
void demand_possible(const std::filesystem::path& file, std::span<const std::byte> whole_model, const Records& records);

}  // namespace breccia
