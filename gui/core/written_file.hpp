#pragma once

#include <QByteArray>
#include <QString>

namespace breccia::gui {

/// Writes a file whole or not at all, and the folder above it where that is missing. Returns what went wrong, empty:
/// nothing; then the file is as it was.
[[nodiscard]] QString written(const QString& file, const QByteArray& bytes);

}  // namespace breccia::gui
