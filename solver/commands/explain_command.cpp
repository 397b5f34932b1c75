#include "commands/commands.hpp"

#include "case/explain.hpp"
#include "commands/terminal.hpp"

namespace breccia {

int explain_command(const std::string& key, bool all) {
  print_lines((key.empty() ? case_::explain_all(all) : case_::explain(key, all)) + "\n");
  return 0;
}

}  // namespace breccia
