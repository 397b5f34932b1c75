#pragma once

#include <string>

#include "case/case.hpp"

namespace breccia::case_ {

/// The case as TOML in SI units with every default written out, units as comments. read_case() makes an equal Case of
/// it: numbers are written with as many digits as they need to come back bit for bit, files with their absolute names.
/// Case::resolved is not looked at.
[[nodiscard]] std::string write_case(const Case& c);

/// A text as a TOML string in quotes; control characters escaped.
[[nodiscard]] std::string toml_text(const std::string& text);

}  // namespace breccia::case_
