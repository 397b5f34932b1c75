#pragma once

#include <string>
#include <vector>

#include "catalyst2/standin.hpp"

namespace breccia::test {

/// The leaf at a path; null: there is none.
[[nodiscard]] const StandinLeaf* leaf_of(const StandinTree& tree, const std::string& path);

/// Leaves below a path.
[[nodiscard]] std::vector<const StandinLeaf*> leaves_below(const StandinTree& tree, const std::string& path);

/// Names of what stands directly below a path, in order.
[[nodiscard]] std::vector<std::string> names_below(const StandinTree& tree, const std::string& path);

/// The i-th value of a view, read through offset and stride, as its bits.
[[nodiscard]] std::uint64_t bits_of(const StandinLeaf& view, std::int64_t i);

/// What is wrong with the state and the channels of an execution by the Conduit Mesh Blueprint: shapes, counts, types,
/// corners that are no points, views that overlap themselves or have no address.
[[nodiscard]] std::vector<std::string> blueprint_problems(const StandinTree& tree);

/// Appends a line a cell to a file: channel, step, bits of all values, of corners' places too.
void dump_cells(const StandinTree& tree, const std::string& file);

}  // namespace breccia::test
