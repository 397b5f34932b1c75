#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "output/checkpoint/checkpoint.hpp"
#include "output/frames/vtkhdf_layout.hpp"

namespace breccia {

/// A dataset of a checkpoint, derived from a row of a table of fields: a field of all records of a list, of the model
/// or of the run's position. Rows of the table with numbers of several kinds (element fields, joint histories) become a
/// dataset each.
struct CheckpointColumn {
  std::string group, name, unit;
  NumberType type;
  int components;
  std::size_t rows;               ///< of this rank
  bool of_list;                   ///< of a list of the records: every rank has rows of its own; else the root has all
  std::function<bool()> is_zero;  ///< all bits of all rows here
  /// The rows as they are stored, one behind the other. @param bytes  is replaced
  std::function<void(std::vector<std::byte>& bytes)> pack;
  /// Back. @param first  where the rows go in the list, which has been made long enough; for lists only
  std::function<void(std::span<const std::byte> bytes, std::size_t first)> unpack;

  [[nodiscard]] std::string path() const { return group.empty() ? name : group + "/" + name; }
  [[nodiscard]] std::size_t row_size() const { return static_cast<std::size_t>(components) * size_of(type); }
};

/// All of them, always in the same order. They refer to the checkpoint, which must outlive them.
[[nodiscard]] std::vector<CheckpointColumn> checkpoint_columns(Checkpoint& checkpoint);

/// The lists of records by name, as groups of a checkpoint, and the length of each.
struct NamedLength {
  std::string name;
  std::size_t length;
};
[[nodiscard]] std::vector<NamedLength> lengths_of_lists(const Records& records);
/// Makes the lists longer. @param more  by list
void lengthen_lists(Records& records, const std::vector<std::size_t>& more);

}  // namespace breccia
