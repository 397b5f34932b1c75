#include "core/material_library.hpp"

#include <gtest/gtest.h>

#include <QJsonArray>
#include <QJsonDocument>
#include <QRegularExpression>
#include <QSet>
#include <QTemporaryDir>
#include <cmath>

#include "case/reader.hpp"
#include "case/units.hpp"
#include "gui/block_case.hpp"

namespace breccia::gui::material_library_test {
namespace {

const QByteArray kCase = test::block_case(1, "1 us");

QString case_in(const QTemporaryDir& scratch) { return test::written_case(scratch, kCase); }

double number(QString toml, const char* unit) { return case_::to_si(toml.remove('"').toStdString(), unit); }

TEST(MaterialLibrary, ThereAreRocksConcretesGlassesCeramicsMetalsAndIceWithASourceForEveryValue) {
  QSet<QString> kinds, names;
  for (const LibraryMaterial& material : shipped_materials()) {
    kinds << material.kind;
    EXPECT_FALSE(names.contains(material.name)) << material.name.toStdString();
    names << material.name;
    for (const char* key : {"young", "poisson", "density"})
      EXPECT_FALSE(material.value(key).isEmpty()) << material.name.toStdString() << " " << key;
    for (const MaterialValue& v : material.values)
      EXPECT_GT(v.source.size(), 10) << material.name.toStdString() << " " << v.key.toStdString();
  }
  EXPECT_EQ(kinds, (QSet<QString>{"rock", "concrete", "glass", "ceramic", "metal", "ice"}));
  EXPECT_GE(names.size(), 15);
}

TEST(MaterialLibrary, ACaseWithAnyOfThemIsAccepted) {
  for (const LibraryMaterial& material : shipped_materials()) {
    const QTemporaryDir scratch;
    Document document(scratch.filePath("state"));
    ASSERT_TRUE(document.open(case_in(scratch)).isEmpty());
    take_material(document, "material[0]", material);
    EXPECT_TRUE(document.problems().empty()) << material.name.toStdString();
    EXPECT_EQ(document.value("material[0].young"), material.value("young"));
    if (const QString strength = material.value("joint.tensile_strength"); !strength.isEmpty()) {
      EXPECT_EQ(document.value("joint[0].tensile_strength"), strength);
    }
    document.undo_stack().undo();
    EXPECT_EQ(document.text(), kCase) << "one step takes it back";
  }
}

TEST(MaterialLibrary, JointsOfAnyGroupTakeItsStrengthsToo) {
  const LibraryMaterial marble{"marble", "own", {}, true, {{"joint.tensile_strength", "\"7 MPa\"", {}}}};
  for (const QByteArray& group : {QByteArray("\"*\""), QByteArray("[\"other\", \"block\"]")}) {
    const QTemporaryDir scratch;
    Document document(scratch.filePath("state"));
    QByteArray text = kCase;
    text.replace("[[joint]]\ngroup = \"block\"", "[[joint]]\ngroup = " + group);
    ASSERT_TRUE(document.open(test::written_case(scratch, text)).isEmpty());
    take_material(document, "material[0]", marble);
    EXPECT_EQ(document.value("joint[0].tensile_strength"), "\"7 MPa\"") << group.toStdString();
  }
}

TEST(MaterialLibrary, OfTheUserIsNotWrittenOverWhereNotAllOfItWasRead) {
  const QTemporaryDir scratch;
  const QString file = scratch.filePath("own.toml");
  const UserLibrary library(file);
  const LibraryMaterial marble{"marble", "own", {}, true, {{"young", "\"60 GPa\"", {}}}};
  EXPECT_TRUE(library.add(marble).isEmpty());
  EXPECT_EQ(library.load().size(), 1U);
  for (const QByteArray& text :
       {QByteArray("[[material]]\nkind = \"own\"\nyoung = \"1 GPa\"\n"), QByteArray("not TOML at all = = 1\n")}) {
    QFile out(file);
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
    out.write(text);
    out.close();
    EXPECT_FALSE(library.add(marble).isEmpty());
    EXPECT_FALSE(library.remove("marble").isEmpty());
    ASSERT_TRUE(out.open(QIODevice::ReadOnly));
    EXPECT_EQ(out.readAll(), text);
  }
}

TEST(MaterialLibrary, EnergiesDerivedFromAToughnessFollowFromIt) {
  static const QRegularExpression toughness(R"(K_Ic = ([0-9.]+) MPa)");
  int seen = 0;
  for (const LibraryMaterial& material : shipped_materials()) {
    for (const MaterialValue& v : material.values) {
      const auto match = toughness.match(v.source);
      if (!match.hasMatch()) continue;
      const double k = 1e6 * match.captured(1).toDouble(), nu = material.value("poisson").toDouble();
      const double energy = k * k * (1 - nu * nu) / number(material.value("young"), "Pa");
      EXPECT_NEAR(number(v.toml, "J/m2"), energy, 0.01 * energy) << material.name.toStdString();
      ++seen;
    }
  }
  EXPECT_GE(seen, 4);
}

TEST(MaterialLibrary, AMaterialOfTheCaseGoesIntoTheUsersLibraryAndBack) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  ASSERT_TRUE(document.open(case_in(scratch)).isEmpty());
  const UserLibrary library(scratch.filePath("state/materials.toml"));
  EXPECT_TRUE(library.load().empty());
  ASSERT_TRUE(library.add(material_of(document, "material[0]", "my \"stone\"")).isEmpty());
  ASSERT_TRUE(library.add(material_of(document, "material[0]", "other")).isEmpty());
  std::vector<LibraryMaterial> list = library.load();
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].name, "my \"stone\"");
  EXPECT_TRUE(list[0].own);
  EXPECT_EQ(list[0].value("young"), "\"40 GPa\"");
  EXPECT_EQ(list[0].value("joint.energy_mode_1"), "\"100 J/m2\"");
  EXPECT_TRUE(list[0].value("group").isEmpty());
  document.set_value("material[0].young", "\"1 GPa\"");
  take_material(document, "material[0]", list[0]);
  EXPECT_EQ(document.value("material[0].young"), "\"40 GPa\"");
  ASSERT_TRUE(library.remove("other").isEmpty());
  EXPECT_EQ(library.load().size(), 1U);
}

}  // namespace
}  // namespace breccia::gui::material_library_test
