#pragma once

#include <string>

namespace breccia {

/// Raises the limit of the stack as far as allowed, where it is low. @return  whether that does, else what to tell
[[nodiscard]] std::string stack_problem();

/// Throws InputError for variables of the environment that are ours and say nothing that we know.
void check_environment();

}  // namespace breccia
