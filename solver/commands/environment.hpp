#pragma once

namespace breccia {

/// Throws InputError for variables of the environment that are ours and say nothing that we know.
void check_environment();

}  // namespace breccia
