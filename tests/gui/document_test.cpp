#include "core/document.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QCoreApplication>
#include <QDirIterator>
#include <QElapsedTimer>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <random>

#include "case/reader.hpp"
#include "case/schema.hpp"

namespace breccia::gui::document_test {
namespace {

QByteArray bytes_of(const QString& file) {
  QFile in(file);
  return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray("unreadable");
}

QStringList shipped_cases() {
  QStringList found;
  QDirIterator it(BRECCIA_MESHES, {"*.toml"}, QDir::Files, QDirIterator::Subdirectories);
  while (it.hasNext()) found << it.next();
  found.sort();
  return found;
}

void let_events_run(int ms) {
  QElapsedTimer timer;
  timer.start();
  while (timer.elapsed() < ms) QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
}

TEST(Document, EveryShippedCaseIsSavedByteForByte) {
  const QTemporaryDir scratch;
  ASSERT_GT(shipped_cases().size(), 20);
  for (const QString& file : shipped_cases()) {
    Document document(scratch.filePath("state"));
    ASSERT_EQ(document.open(file), "");
    EXPECT_TRUE(document.editable_as_text());
    EXPECT_TRUE(document.problems().empty()) << file.toStdString() << "\n" << document.problems().front().text();
    QFile::remove(scratch.filePath("case.toml"));
    ASSERT_TRUE(QFile::copy(file, scratch.filePath("case.toml")));
    ASSERT_EQ(document.open(scratch.filePath("case.toml")), "");
    ASSERT_EQ(document.save_as(scratch.filePath("copy.toml")), "");
    EXPECT_EQ(bytes_of(scratch.filePath("copy.toml")), bytes_of(file)) << file.toStdString();
  }
}

TEST(Document, SavedInAnotherFolderNamesTheSameFiles) {
  const QTemporaryDir scratch;
  ASSERT_TRUE(QDir(scratch.path()).mkpath("here") && QDir(scratch.path()).mkpath("there/deep"));
  const auto path = [&](const char* name) { return scratch.filePath(name); };
  const QByteArray text =
      "[start]\nfrom = \"../run\"\n[mesh]\nfile = \"a.geo\"  # mine\n[[insitu.pipeline]]\nname = \"stress\"\n"
      "[[insitu.pipeline]]\nname = \"see.py\"\n[[insitu.pipeline]]\nname = \"/abs/see.py\"\n"
      "[[stage]]\ngravity = [0, 0, { csv = { file = \"g.csv\" } }]\n[[stage.constraint]]\nvelocity = { x = { csv = "
      "[{ file = \"x.csv\", time = 2 }] } }\n[[stage.pressure]]\nvalue.csv.file = \"p.csv\"\n";
  QFile file(path("here/case.toml"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly) && file.write(text) == text.size());
  file.close();
  Document document(path("state"));
  ASSERT_EQ(document.open(file.fileName()), "");
  ASSERT_EQ(document.save_as(path("there/deep/case.toml")), "");
  QByteArray moved = text;
  moved.replace("../run", "../../run").replace("a.geo", "../../here/a.geo").replace("\"see.py", "\"../../here/see.py");
  for (const char* name : {"g.csv", "x.csv", "p.csv"}) moved.replace(name, QByteArray("../../here/") + name);
  EXPECT_EQ(bytes_of(path("there/deep/case.toml")), moved);
  EXPECT_FALSE(document.modified());
  ASSERT_NE(document.save_as(path("here/case.toml/case.toml")), "");
  EXPECT_EQ(document.text(), moved) << "as before what could not be written";
}

/// One edit of some kind at some place.
void edit(Document& document, std::mt19937& random) {
  const auto any = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const auto& all = document.places().all();
  const std::string path = all.empty() ? "title" : all[any(all.size())].path;
  switch (any(5)) {
    case 0:
      document.remove(QString::fromStdString(path));
      break;
    case 1:
      document.add_entry("material", QString("group = \"g%1\"\n").arg(random() % 100));
      break;
    case 2: {
      QByteArray text = document.text();
      const auto at = static_cast<int>(any(static_cast<std::size_t>(text.size()) + 1));
      document.set_text(text.insert(at, QByteArray("#x\n[q] =\"").left(static_cast<int>(any(9)) + 1)));
      break;
    }
    default:
      document.set_value(QString::fromStdString(any(4) == 0 ? path + ".new" : path),
                         QString("\"%1 mm\"").arg(random() % 1000));
  }
}

TEST(Document, TwoHundredRandomEditsAndTheirUndosGiveBackTheFile) {
  const QTemporaryDir scratch;
  std::mt19937 random(7);
  for (const QString& file : shipped_cases()) {
    Document document(scratch.filePath("state"));
    ASSERT_EQ(document.open(file), "");
    const QByteArray before = document.text();
    for (int i = 0; i < 200; ++i) edit(document, random);
    const QByteArray after = document.text();
    EXPECT_NE(after, before);
    while (document.undo_stack().canUndo()) document.undo_stack().undo();
    ASSERT_EQ(document.text(), before) << file.toStdString();
    while (document.undo_stack().canRedo()) document.undo_stack().redo();
    ASSERT_EQ(document.text(), after) << file.toStdString();
  }
}

TEST(Document, LettersTypedOneBehindTheOtherAreOneStep) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(shipped_cases().front()), "");
  QByteArray text = document.text();
  for (const char c : std::string("# why")) document.set_text(text.append(c));
  EXPECT_EQ(document.undo_stack().count(), 1);
}

TEST(Document, SaysWhatTheReaderSaysWithTheSameWords) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(QString(BRECCIA_MESHES) + "/block_wall/case.toml"), "");
  document.set_value("material[0].poisson", "0.7");
  document.set_value("time.safty", "0.5");
  ASSERT_EQ(document.save_as(scratch.filePath("wrong.toml")), "");
  std::vector<std::string> told, expected;
  for (const Problem& p : document.problems()) told.push_back(p.text());
  try {
    (void)case_::read_case(scratch.filePath("wrong.toml").toStdString());
  } catch (const InputError& error) {
    for (const Problem& p : error.problems()) expected.push_back(p.text());
  }
  EXPECT_GE(told.size(), 2U);
  EXPECT_EQ(told, expected);
}

TEST(Document, TextThatCannotBeShownExactlyIsNotEditedAsText) {
  const QTemporaryDir scratch;
  QFile file(scratch.filePath("latin1.toml"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("title = \"caf\xe9\"\n");
  file.close();
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(file.fileName()), "");
  EXPECT_FALSE(document.editable_as_text());
  document.set_value("mesh.file", "\"a.geo\"");
  ASSERT_EQ(document.save(), "");
  EXPECT_EQ(bytes_of(file.fileName()), QByteArray("title = \"caf\xe9\"\n\n[mesh]\nfile = \"a.geo\"\n"));
}

TEST(Document, AFileThatIsNotThereIsTold) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  EXPECT_NE(document.open(scratch.filePath("none.toml")), "");
  EXPECT_FALSE(document.is_open());
}

TEST(Document, EditsThatAreTwoSecondsOldSurviveAKill) {
  const QTemporaryDir scratch;
  const QString file = scratch.filePath("case.toml"), state = scratch.filePath("state");
  ASSERT_TRUE(QFile::copy(QString(BRECCIA_MESHES) + "/block_wall/case.toml", file));
  const pid_t child = ::fork();
  if (child == 0) {
    Document document(state);
    if (!document.open(file).isEmpty()) ::_exit(1);
    document.set_value("material[0].young", "\"31 GPa\"");
    let_events_run(2000);
    ::kill(::getpid(), SIGKILL);
  }
  siginfo_t about{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &about, WEXITED | WNOWAIT), 0);
  const std::vector<Recovery> found = Document::recoveries(state);
  ::waitpid(child, nullptr, 0);
  ASSERT_EQ(found.size(), 1U) << "a process that has ended counts until its parent has heard of it";
  EXPECT_EQ(found[0].file, file);
  Document document(state);
  document.recover(found[0]);
  EXPECT_EQ(document.value("material[0].young"), "\"31 GPa\"");
  EXPECT_TRUE(document.modified());
  document.undo_stack().undo();
  EXPECT_EQ(document.text(), bytes_of(file));
  document.close();
  EXPECT_TRUE(Document::recoveries(state).empty());
}

TEST(Document, EditsOfAProcessWhoseNumberAnotherOneHasNowAreOffered) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(QString(BRECCIA_MESHES) + "/block_wall/case.toml"), "");
  document.set_value("material[0].young", "\"31 GPa\"");
  let_events_run(Document::kAutosaveDelay + 300);
  EXPECT_TRUE(Document::recoveries(scratch.filePath("state")).empty()) << "this process lives";
  const QDir state(scratch.filePath("state"));
  const QStringList names = state.entryList({"unsaved-*"});
  ASSERT_EQ(names.size(), 1);
  QFile file(state.filePath(names[0]));
  ASSERT_TRUE(file.open(QIODevice::ReadWrite));
  QJsonObject json = QJsonDocument::fromJson(file.readAll()).object();
  json["started"] = json["started"].toDouble() - 1;
  file.resize(0);
  file.seek(0);
  file.write(QJsonDocument(json).toJson());
  file.close();
  EXPECT_EQ(Document::recoveries(scratch.filePath("state")).size(), 1U);
}

TEST(Document, AGroupThatTheMeshHasNotIsAProblemOnceTheMeshIsKnown) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(QString(BRECCIA_MESHES) + "/slit_plate/case_smoke.toml"), "");
  const std::vector<std::string> surfaces{"plate.x0", "plate.slit"};
  EXPECT_TRUE(document.problems(MeshGroups{{"plate"}, surfaces, {}, 1}).empty());
  document.set_value("stage[0].pressure[0].surface", "\"plate.slot\"");
  EXPECT_TRUE(document.problems().empty());
  const std::vector<Problem> found = document.problems(MeshGroups{{"plate"}, surfaces, {}, 1});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].key, "stage[0].pressure[0].surface");
}

TEST(Document, EditsThatWereRecoveredStayInTheirSnapshotUntilTheyAreInAnother) {
  const QTemporaryDir scratch;
  const QString file = scratch.filePath("case.toml"), lost = scratch.filePath("lost.json");
  for (const QString& name : {file, lost, scratch.filePath("state")}) {
    QFile out(name);
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
  }
  Document document(scratch.filePath("state"));  // a file stands in the place of its folder
  QStringList errors;
  QObject::connect(&document, &Document::snapshot_tried, [&](const QString& error) { errors << error; });
  document.recover({lost, file, "title = \"a\"\n"});
  EXPECT_TRUE(QFile::exists(lost));
  ASSERT_EQ(errors.size(), 1);
  EXPECT_TRUE(errors[0].contains("cannot be written")) << errors[0].toStdString();
}

TEST(Document, EditsThatAreUndoneLeaveNoSnapshot) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(QString(BRECCIA_MESHES) + "/block_wall/case.toml"), "");
  document.set_value("material[0].young", "\"31 GPa\"");
  let_events_run(Document::kAutosaveDelay + 300);
  EXPECT_EQ(QDir(scratch.filePath("state")).entryList({"unsaved-*"}).size(), 1);
  document.undo_stack().undo();
  let_events_run(Document::kAutosaveDelay + 300);
  EXPECT_TRUE(QDir(scratch.filePath("state")).entryList({"unsaved-*"}).isEmpty());
}

TEST(Document, ASavedCaseLeavesNoSnapshot) {
  const QTemporaryDir scratch;
  const QString file = scratch.filePath("case.toml");
  ASSERT_TRUE(QFile::copy(QString(BRECCIA_MESHES) + "/block_wall/case.toml", file));
  Document document(scratch.filePath("state"));
  ASSERT_EQ(document.open(file), "");
  document.set_value("material[0].young", "\"31 GPa\"");
  let_events_run(Document::kAutosaveDelay + 300);
  EXPECT_EQ(QDir(scratch.filePath("state")).entryList({"unsaved-*"}).size(), 1);
  ASSERT_EQ(document.save(), "");
  EXPECT_FALSE(document.modified());
  EXPECT_TRUE(QDir(scratch.filePath("state")).entryList({"unsaved-*"}).isEmpty());
}

TEST(Document, AFileThatAnotherProgramHasChangedIsNoticed) {
  const QTemporaryDir scratch;
  const QString file = scratch.filePath("case.toml");
  const auto write = [&](const QByteArray& text) {
    QFile out(file);
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
    out.write(text);
  };
  write("title = \"a\"\n");
  Document document(scratch.filePath("state"));
  ASSERT_TRUE(document.open(file).isEmpty());
  EXPECT_FALSE(document.changed_on_disk());
  document.set_value("title", "\"b\"");
  EXPECT_FALSE(document.changed_on_disk());
  write("title = \"c\"\n");
  EXPECT_TRUE(document.changed_on_disk());
  ASSERT_TRUE(document.save().isEmpty());
  EXPECT_FALSE(document.changed_on_disk());
}

}  // namespace
}  // namespace breccia::gui::document_test
