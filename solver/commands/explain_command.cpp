#include "commands/commands.hpp"

#include "case/explain.hpp"
#include "commands/terminal.hpp"

namespace breccia {

int explain_command(const std::string& key) {
  print_lines((key.empty() ? case_::explain() : case_::explain(key)) + "\n");
  return 0;
}

}  // namespace breccia
