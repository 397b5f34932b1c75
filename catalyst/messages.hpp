#pragma once

#include <string>
#include <vector>

namespace breccia::insitu {

/// VTK's messages go to us instead of the terminal: errors and warnings are kept, the rest is dropped. Idempotent;
/// called again after ParaView has started, since that installs its own.
void capture_messages();

/// The first error since the last call, in one line, "class: message (and 3 more)"; empty when there was none.
[[nodiscard]] std::string take_errors();

/// The warnings since the last call, "class: message", each once.
[[nodiscard]] std::vector<std::string> take_warnings();

}  // namespace breccia::insitu
