#include "core/written_file.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QSaveFile>

namespace breccia::gui {

QString written(const QString& file, const QByteArray& bytes) {
  QDir().mkpath(QFileInfo(file).absolutePath());
  QSaveFile out(file);
  // flush: commit does not tell that what was still in the buffer finds no room, and would put an empty file in place.
  if (out.open(QIODevice::WriteOnly) && out.write(bytes) == bytes.size() && out.flush() && out.commit()) return {};
  return QCoreApplication::translate("files", "%1 cannot be written: %2").arg(file, out.errorString());
}

}  // namespace breccia::gui
