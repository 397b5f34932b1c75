#pragma once

namespace breccia {

/// "0.1.0": the version of the program.
[[nodiscard]] const char* program_version();

}  // namespace breccia
