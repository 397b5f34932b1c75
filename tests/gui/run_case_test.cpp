#include "core/run_case.hpp"

#include <gtest/gtest.h>

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QTemporaryDir>

#include "core/study.hpp"

namespace breccia::gui::test::run_case_test {
namespace {

/// Folders of runs and the cases that they may be of.
struct Runs {
  QTemporaryDir scratch;

  QString write(const QString& name, const QByteArray& text) const {
    const QString file = scratch.filePath(name);
    QDir().mkpath(QFileInfo(file).path());
    QFile out(file);
    EXPECT_TRUE(out.open(QIODevice::WriteOnly) && out.write(text) == text.size());
    return file;
  }

  /// A run that names its case so. @param text  of the case
  RunRecord run(const QString& folder, const QString& named, const QByteArray& text) const {
    const QByteArray sum = QCryptographicHash::hash(text, QCryptographicHash::Sha256).toHex();
    write(folder + "/provenance.json", R"({"program": "breccia", "inputs": [{"file": ")" + named.toUtf8() +
                                           R"(", "sha256": ")" + sum + R"("}]})");
    write(folder + "/case.toml", text);
    return {scratch.filePath(folder), {}, 1, {}, {}};
  }
};

TEST(RunCase, IsTheOneThatWasNotedWhenTheRunWasStarted) {
  const Runs at;
  RunRecord record = at.run("a", "other.toml", "x = 1");
  record.case_file = at.write("own.toml", "x = 2");
  EXPECT_EQ(case_of_run(record), record.case_file);
  EXPECT_TRUE(is_run_of(record, record.case_file, "edited"));
}

TEST(RunCase, IsTheFileThatTheProvenanceNamesThoughItHasBeenEditedSince) {
  const Runs at;
  const QString file = at.write("cases/own.toml", "x = 2");
  const RunRecord record = at.run("far/away", file, "x = 1");
  EXPECT_EQ(case_of_run(record), file);
  EXPECT_TRUE(is_run_of(record, file, "x = 2"));
  EXPECT_FALSE(is_run_with(record, file, "x = 2"));
}

TEST(RunCase, NamedRelativeToAFolderThatNothingTellsIsOneNearTheRunThatReadsTheSame) {
  const Runs at;
  const QString file = at.write("case.toml", "x = 1");
  EXPECT_EQ(case_of_run(at.run("one", "case.toml", "x = 1")), file);
  EXPECT_EQ(case_of_run(at.run("runs/two", "case.toml", "x = 1")), file);
  EXPECT_EQ(case_of_run(at.run("three", "case.toml", "x = 2")), at.scratch.filePath("three/case.toml"));
}

TEST(RunCase, IsThatOfTheNameOfTheRunAndThatOfItsStudy) {
  const Runs at;
  const QString file = at.write("own.toml", "x = 1");
  EXPECT_EQ(case_of_run(at.run("runs/own-20260131-235959", ".breccia-queued-1.toml", "x = 2")), file);
  const Study study{at.scratch.filePath("runs/own-20260131-235959-study"),
                    file,
                    1,
                    {{"x", {"1"}}},
                    {{at.scratch.filePath("runs/own-20260131-235959-study/001"), {"1"}}}};
  ASSERT_EQ(save_study(study), "");
  EXPECT_EQ(case_of_run(at.run("runs/own-20260131-235959-study/001", ".breccia-queued-2.toml", "x = 3")), file);
}

TEST(RunCase, OfNoneThatIsStillThereIsTheCopyInTheFolderOfTheRun) {
  const Runs at;
  const RunRecord record = at.run("a", "/not/there.toml", "x = 1");
  EXPECT_EQ(case_of_run(record), at.scratch.filePath("a/case.toml"));
  const QString same = at.write("same.toml", "x = 1"), other = at.write("other.toml", "x = 2");
  EXPECT_TRUE(is_run_of(record, same, "x = 1")) << "a case that reads the same has the same results";
  EXPECT_FALSE(is_run_of(record, other, "x = 2"));
}

/// The copy in the folder of a run names files from there.
TEST(RunCase, IsRunWithATextThatItsProvenanceKnows) {
  const Runs at;
  const RunRecord record = at.run("a", "c.toml", "x = 1");
  at.write("a/case.toml", "x = 1 # a copy");
  EXPECT_TRUE(is_run_with(record, at.scratch.filePath("b.toml"), "x = 1"));
  EXPECT_FALSE(is_run_with(record, at.scratch.filePath("b.toml"), "x = 2"));
}

TEST(RunCase, IsNoneWhereTheCopyCannotBeReadOrLeadsElsewhere) {
  const Runs at;
  const RunRecord record = at.run("a", "/not/there.toml", "x = 1");
  ASSERT_TRUE(QFile::remove(at.scratch.filePath("a/case.toml")));
  EXPECT_EQ(case_of_run(record), "");
  ASSERT_TRUE(QFile::link(at.write("secret.toml", "x = 3"), at.scratch.filePath("a/case.toml")));
  EXPECT_EQ(case_of_run(record), "");
  EXPECT_FALSE(is_run_with(record, at.scratch.filePath("secret.toml"), ""));
}

TEST(RunCase, TellsOfFramesWithoutElements) {
  const Runs at;
  EXPECT_TRUE(writes_elements(at.run("a", "c.toml", "[output]\nelements = true\n").folder));
  EXPECT_FALSE(writes_elements(at.run("b", "c.toml", "[output]\nelements = false\n").folder));
  EXPECT_TRUE(writes_elements(at.scratch.filePath("none")));
}

}  // namespace
}  // namespace breccia::gui::test::run_case_test
