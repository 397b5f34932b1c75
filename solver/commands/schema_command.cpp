#include <fmt/core.h>

#include "case/schema.hpp"
#include "commands/commands.hpp"
#include "commands/json_report.hpp"

namespace breccia {

int schema_command(bool json) {
  if (json) {
    fmt::print("{}", schema_json());
    return 0;
  }
  for (const case_::Key& key : case_::schema()) fmt::print("{:<36} {}\n", key.path, case_::allowed_text(key));
  return 0;
}

}  // namespace breccia
