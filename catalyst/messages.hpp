#pragma once

#include <string>

namespace breccia::insitu {

/// VTK's messages go to us instead of the terminal: errors are kept, warnings and the rest are dropped. Idempotent;
/// called again after ParaView has started, since that installs its own.
void capture_messages();

/// The first error since the last call, in one line, "class: message (and 3 more)"; empty when there was none.
[[nodiscard]] std::string take_errors();

}  // namespace breccia::insitu
