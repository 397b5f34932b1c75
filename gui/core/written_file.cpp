#include "core/written_file.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QSaveFile>

namespace breccia::gui {

QString written(const QString& file, const QByteArray& bytes) {
  QDir().mkpath(QFileInfo(file).absolutePath());
  QSaveFile out(file);
  // flush: commit does not report that the buffer finds no space, and would replace the file by an empty one.
  if (out.open(QIODevice::WriteOnly) && out.write(bytes) == bytes.size() && out.flush() && out.commit()) return {};
  return QCoreApplication::translate("files", "%1 cannot be written: %2").arg(file, out.errorString());
}

}  // namespace breccia::gui
