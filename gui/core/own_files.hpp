#pragma once

#include <QString>
#include <QStringList>

namespace breccia::gui {

/// The beginning of the name of a hidden file or folder that this process makes for itself and removes when it ends. It
/// holds machine and process, so that what a killed process leaves is known as such.
/// @param kind  "draft", "preview", "film"
[[nodiscard]] QString own_name(const QString& kind);

/// Removes from folders what processes of this user on this machine have left that are no more; on another thread, as
/// folders may be slow to read. Unsaved edits are kept elsewhere (`Document::recoveries`) and are not touched.
void remove_orphans(const QStringList& folders);

}  // namespace breccia::gui
