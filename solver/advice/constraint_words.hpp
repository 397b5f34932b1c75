#pragma once

#include <string>

#include "case/case.hpp"

namespace breccia {

/// The key by which a constraint holds or moves its nodes.
[[nodiscard]] const char* kind_of(const case_::Constraint& entry);

/// "stage[0].constraint[1] (fixed, \"bottom\", line 24)"
[[nodiscard]] std::string name_of(const case_::Constraint& entry);

}  // namespace breccia
