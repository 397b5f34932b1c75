#include "commands/terminal.hpp"

#include <fmt/core.h>
#include <iostream>

#include "base/printable.hpp"

namespace breccia {

void print_lines(const std::string& text) { fmt::print("{}", printable_lines(text)); }

void print_warning(const std::string& sentence) {
  std::cerr << "breccia: warning: " << printable_lines(sentence) << '\n';
}

void print_warnings(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) print_warning(sentence);
}

}  // namespace breccia
