#pragma once

class QMainWindow;

namespace breccia::gui {

/// Lists what the window does by keys and by the mouse: the entries of its menus, buttons and boxes that have keys of
/// their own, and the ways in the view and the panels. The window lives meanwhile.
void show_keys(QMainWindow& window);

}  // namespace breccia::gui
