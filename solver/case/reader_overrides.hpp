#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/reader_toml.hpp"

namespace breccia::case_ {

/// Puts the values of `--set key=value` into the tree of a case file. A key is a dotted path; an entry of a list is
/// named by its index (`material[0].young`) or by its name, group or surface (`material.glass.young`). Tables on the
/// way are made if the schema knows them. Problems (no "=", unknown key with the nearest known one, index past the end,
/// a name that fits no entry or several) are appended.
void apply_overrides(Node& root, std::span<const std::string> overrides, std::vector<Problem>& problems);

}  // namespace breccia::case_
