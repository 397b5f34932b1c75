#pragma once

namespace breccia::gui {

/// Colours of all widgets, light or dark.
void apply_theme(bool dark);
/// What the desktop around us prefers.
[[nodiscard]] bool system_is_dark();

}  // namespace breccia::gui
