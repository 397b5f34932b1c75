#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "case/case.hpp"

namespace breccia::case_ {

/// Reads and checks a case file: TOML, keys of the schema, quantities in SI or with units. Defaults are filled in,
/// including a joint law for unbreakable groups without one, and Case::resolved.
/// @param overrides `key=value` of the command line, put into the file's tree before it is read (reader_overrides.hpp)
/// Throws InputError with every problem of the file: TOML, unknown and missing keys, types, units, ranges, and what
/// validate() finds. Group names are compared with the mesh later, by check_groups().
[[nodiscard]] Case read_case(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same of a text that stands, or will stand, in `file`, whose folder relative names start from.
[[nodiscard]] Case read_case_text(std::string_view text, const std::filesystem::path& file,
                                  std::span<const std::string> overrides = {});

}  // namespace breccia::case_
