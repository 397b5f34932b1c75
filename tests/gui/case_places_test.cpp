#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>

#include "case/reader.hpp"
#include "core/case_outline.hpp"
#include "core/places.hpp"
#include "gui/full_disk.hpp"

namespace breccia::gui::case_places_test {
namespace {

Places places_in(const QTemporaryDir& scratch) {
  Places places;
  places.meshes = BRECCIA_MESHES;
  places.projects = scratch.filePath("projects");
  places.state = scratch.filePath("state");
  return places;
}

TEST(Templates, EachIsCopiedIntoAFolderOfItsOwnAndCanBeRead) {
  const QTemporaryDir scratch;
  const Places places = places_in(scratch);
  const std::vector<Template> list = templates(places);
  ASSERT_EQ(list.size(), 12U);
  for (const Template& t : list) {
    QString error;
    const QString first = copy_template(t, places, &error), second = copy_template(t, places, &error);
    ASSERT_FALSE(first.isEmpty()) << error.toStdString();
    EXPECT_NE(first, second);
    EXPECT_NO_THROW((void)case_::read_case(first.toStdString())) << first.toStdString();
    EXPECT_TRUE(QFileInfo(first).isWritable());
  }
}

TEST(Templates, AFolderThatCannotBeMadeIsTold) {
  const QTemporaryDir scratch;
  Places places = places_in(scratch);
  QFile file(scratch.filePath("file"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  places.projects = file.fileName();
  QString error;
  EXPECT_TRUE(copy_template(templates(places).front(), places, &error).isEmpty());
  EXPECT_TRUE(error.contains(file.fileName()) && error.contains("Not a directory")) << error.toStdString();
}

TEST(Templates, OneThatFindsNoRoomIsToldWithItsReasonAndLeavesNothing) {
  const QTemporaryDir scratch;
  const Places places = places_in(scratch);
  QString error;
  {
    const test::FullDisk full;
    EXPECT_TRUE(copy_template(templates(places).front(), places, &error).isEmpty());
  }
  EXPECT_TRUE(error.contains(places.projects) && error.contains("File too large")) << error.toStdString();
  EXPECT_FALSE(QFileInfo::exists(places.projects));
}

TEST(RecentCases, TheNewestIsFirstAndThoseThatAreGoneAreLeftOut) {
  const QTemporaryDir scratch;
  const Places places = places_in(scratch);
  const QString a = QString(BRECCIA_MESHES) + "/block_wall/case.toml",
                b = QString(BRECCIA_MESHES) + "/bar_wave/case.toml";
  for (const QString& file : {a, b, QString("/no/such/case.toml"), a}) EXPECT_EQ(remember_case(places, file), "");
  EXPECT_EQ(recent_cases(places), QStringList({a, b}));
}

TEST(CaseOutline, AProblemBelongsToTheStageOfItsSection) {
  const auto name = [](const char* path) { return work_stages()[static_cast<std::size_t>(stage_of(path))].name; };
  EXPECT_EQ(name("material[1].young"), "Materials");
  EXPECT_EQ(name("joint[0].softening.kind"), "Joints");
  EXPECT_EQ(name("joints.broken"), "Joints");
  EXPECT_EQ(name("stage[0].constraint[2].fixed"), "Loads and constraints");
  EXPECT_EQ(name("mesh.raster.slit.lower"), "Geometry and mesh");
  EXPECT_EQ(name("contact_points.field"), "Contacts");
}

TEST(CaseOutline, AStepOfTheHistoryNamesWhatItIsAbout) {
  const TomlPlaces places("[[joint]]\ngroup = \"glass\"\n[[stage]]\nend = 1\n");
  EXPECT_EQ(words_of("joint[0].softening.c", places), "softening c of joint: glass");
  EXPECT_EQ(words_of("joint[0]", places), "joint: glass");
  EXPECT_EQ(words_of("stage[0].constraint", places), "constraint of stage");
  EXPECT_EQ(words_of("mesh.raster.cell_size", places), "mesh raster cell size");
  EXPECT_EQ(numbered_words("stage[0].constraint[1]"), "stage 1, constraint 2");
  EXPECT_EQ(numbered_words("initial_velocity[0]"), "initial velocity 1");
}

}  // namespace
}  // namespace breccia::gui::case_places_test
