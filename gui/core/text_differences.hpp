#pragma once

#include <QString>
#include <QStringList>

namespace breccia::gui {

/// Lines that one text has and the other has not, in their order: "- gone", "+ new".
/// O(lines of what differs squared); a difference of more than a few thousand lines is told as all of them.
[[nodiscard]] QStringList line_differences(const QString& before, const QString& after);

}  // namespace breccia::gui
