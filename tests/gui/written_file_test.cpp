#include "core/written_file.hpp"

#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>

#include "gui/full_disk.hpp"

namespace breccia::gui::written_file_test {
namespace {

QByteArray content(const QString& name) {
  QFile file(name);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

TEST(WrittenFile, AFullDiskIsToldAndTheFileStaysAsItWas) {
  const QTemporaryDir scratch;
  const QString name = scratch.filePath("case.toml");
  for (const int size : {10, 100000}) {  // less and more than what is written at once
    ASSERT_EQ(written(name, "before"), QString());
    QString told;
    {
      const test::FullDisk full;
      told = written(name, QByteArray(size, 'x'));
    }
    EXPECT_TRUE(told.contains("File too large")) << told.toStdString();
    EXPECT_EQ(content(name), "before");
    EXPECT_EQ(QDir(scratch.path()).entryList(QDir::Files | QDir::Hidden), QStringList{"case.toml"});
  }
}

}  // namespace
}  // namespace breccia::gui::written_file_test
