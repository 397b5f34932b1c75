#include "commands/commands.hpp"

#include <fmt/core.h>

#include "case/explain.hpp"

namespace breccia {

int explain_command(const std::string& key) {
  fmt::print("{}\n", key.empty() ? case_::explain() : case_::explain(key));
  return 0;
}

}  // namespace breccia
