#pragma once

#include <string>

namespace breccia {

/// Raises a low limit of the stack as far as allowed. @return  empty, or the message if the limit remains too low
[[nodiscard]] std::string stack_problem();

/// Throws InputError for unknown values of Breccia's environment variables.
void check_environment();

}  // namespace breccia
