#pragma once

#include <QString>
#include <QStringList>

namespace breccia::gui {

/// Lines that only one of two texts has, in their order: "- removed", "+ new".
/// O(lines of what differs squared); a difference of more than a few thousand lines lists all of them.
[[nodiscard]] QStringList line_differences(const QString& before, const QString& after);

}  // namespace breccia::gui
