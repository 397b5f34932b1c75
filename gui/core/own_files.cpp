#include "core/own_files.hpp"

#include <signal.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>
#include <QSysInfo>
#include <QThreadPool>
#include <cerrno>

namespace breccia::gui {

QString own_name(const QString& kind) {
  return QString(".breccia-%1-%2-%3").arg(kind, QSysInfo::machineHostName()).arg(::getpid());
}

namespace {

void remove_orphans_of(const QString& folder) {
  // After the number: six letters of a temporary folder, the ending of a draft, six letters while it is written.
  static const QRegularExpression form(
      R"(^\.breccia-(?:draft|preview|film)-(.+)-(\d+)(?:-\w{6})?(?:\.toml)?(?:\.\w{6})?$)");
  const QDir dir(folder);
  const auto entries = dir.entryInfoList({".breccia-*"}, QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
  for (const QFileInfo& entry : entries) {
    const QRegularExpressionMatch match = form.match(entry.fileName());
    // The processes of another machine, which shares the folder, are not seen from here.
    if (!match.hasMatch() || match.captured(1) != QSysInfo::machineHostName() || entry.ownerId() != ::geteuid())
      continue;
    const bool gone = ::kill(static_cast<pid_t>(match.captured(2).toInt()), 0) != 0 && errno == ESRCH;
    if (!gone) continue;
    if (entry.isDir() && !entry.isSymLink()) {
      QDir(entry.absoluteFilePath()).removeRecursively();
    } else {
      QFile::remove(entry.absoluteFilePath());
    }
  }
}

}  // namespace

void remove_orphans(const QStringList& folders) {
  QThreadPool::globalInstance()->start([folders] {
    for (const QString& folder : folders) remove_orphans_of(folder);
  });
}

}  // namespace breccia::gui
