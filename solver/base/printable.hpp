#pragma once

#include <string>
#include <string_view>

namespace breccia {

/// Text of an input as it may stand in a message: control characters, which could move the cursor or hide what is
/// printed, are written as \n, \t, \x1b, ...; everything else is kept.
[[nodiscard]] std::string printable(std::string_view text);

/// Likewise of a text of several lines: line feeds and tabs are kept.
[[nodiscard]] std::string printable_lines(std::string_view text);

}  // namespace breccia
