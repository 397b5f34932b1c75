#pragma once

#include <string>

#include "case/reader_values.hpp"

namespace breccia::case_ {

/// Compares the sections and key names of a case file with the schema: unknown keys, tables written as lists and the
/// other way round. Values are left to ValueReader.
void check_keys(const Node& table, ValueReader& values);

/// The deepest node on a dotted path with indices that exists; the root if none.
[[nodiscard]] const Node& deepest_on_path(const Node& root, std::string_view path);

}  // namespace breccia::case_
