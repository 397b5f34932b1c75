#include "core/own_files.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QThreadPool>

namespace breccia::gui::own_files_test {
namespace {

/// The number of a process that has ended.
pid_t ended_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

TEST(OwnFiles, WhatProcessesThatAreGoneHaveLeftIsRemovedAndNothingElse) {
  const QTemporaryDir scratch;
  const QDir folder(scratch.path());
  const QString own = QString::number(::getpid()), gone = QString::number(ended_process());
  const auto name = [&](const QString& kind, const QString& process) {
    return own_name(kind).replace(QRegularExpression("\\d+$"), process);
  };
  const QStringList stay{name("draft", own) + ".toml",       ".breccia-draft-elsewhere-" + gone + ".toml",
                         ".breccia-queued-0123456789a.toml", "case.toml",
                         name("draft", gone) + ".toml.mine", name("preview", own) + "-AbCdEf"};
  const QStringList go{name("draft", gone) + ".toml", name("draft", gone) + ".toml.AbCdEf",
                       name("preview", gone) + "-AbCdEf", name("film", gone) + "-x1Y2z3"};
  for (const QString& entry : stay + go) {
    if (!entry.contains(".toml")) folder.mkpath(entry + "/1");
    QFile file(folder.filePath(entry.contains(".toml") ? entry : entry + "/1/elements"));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  }
  remove_orphans({scratch.path()});
  QThreadPool::globalInstance()->waitForDone();
  QStringList left = folder.entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot), wanted = stay;
  left.sort();
  wanted.sort();
  EXPECT_EQ(left, wanted) << left.join(" ").toStdString();
}

}  // namespace
}  // namespace breccia::gui::own_files_test
