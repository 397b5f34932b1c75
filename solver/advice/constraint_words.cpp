#include "advice/constraint_words.hpp"

#include <fmt/core.h>

namespace breccia {

const char* kind_of(const case_::Constraint& entry) {
  switch (entry.kind) {
    case case_::ConstraintKind::fixed:
      break;
    case case_::ConstraintKind::velocity:
      return "velocity";
    case case_::ConstraintKind::displacement:
      return "displacement";
  }
  return "fixed";
}

std::string name_of(const case_::Constraint& entry) {
  return fmt::format("{} ({}, \"{}\", line {})", entry.origin.key, kind_of(entry), entry.group, entry.origin.line);
}

}  // namespace breccia
