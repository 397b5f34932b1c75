#include "commands/commands.hpp"
#include "commands/terminal.hpp"
#include "output/folder/run_diff.hpp"

namespace breccia {

int diff_command(const DiffCommand& asked) {
  print_lines(diff_runs(asked.first, asked.second));
  return 0;
}

}  // namespace breccia
