#pragma once

#include <string>
#include <vector>

namespace breccia {

/// Prints the result of a command on stdout. What it has from files and from the command line may hold control
/// characters, which are written out (base/printable.hpp).
void print_lines(const std::string& text);

/// Prints "breccia: warning: ..." on stderr, likewise.
void print_warning(const std::string& sentence);
void print_warnings(const std::vector<std::string>& sentences);

}  // namespace breccia
