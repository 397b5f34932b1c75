#include <fmt/core.h>

#include "commands/commands.hpp"
#include "output/run_diff.hpp"

namespace breccia {

int diff_command(const DiffCommand& asked) {
  fmt::print("{}", diff_runs(asked.first, asked.second));
  return 0;
}

}  // namespace breccia
