#include "core/value_text.hpp"

#include <gtest/gtest.h>

#include "core/toml_places.hpp"

#include <QDirIterator>
#include <QFile>

namespace breccia::gui::value_text_test {
namespace {

QString typed(const char* key, const char* text) { return typed_value(case_::key_of(key), text); }
QString shown(const char* key, const char* toml) { return shown_value(case_::key_of(key), toml); }

TEST(ValueText, WhatIsTypedBecomesToml) {
  EXPECT_EQ(typed("material[].young", "70 GPa"), "\"70 GPa\"");
  EXPECT_EQ(typed("material[].young", " 7e10 "), "7e10");
  EXPECT_EQ(typed("material[].young", "3,5 GPa"), "\"3.5 GPa\"");
  EXPECT_EQ(typed("initial_velocity[].velocity", "0, -3 m/s, 0"), "[0, \"-3 m/s\", 0]");
  EXPECT_EQ(typed("mesh.raster.cell_size", "5 mm"), "\"5 mm\"");
  EXPECT_EQ(typed("mesh.raster.cells", "4, 4, 1"), "[4, 4, 1]");
  EXPECT_EQ(typed("contact[].between", "*, glass"), "[\"*\", \"glass\"]");
  EXPECT_EQ(typed("output.gauges", "a"), "[\"a\"]");
  EXPECT_EQ(typed("material[].group", "12"), "\"12\"");
  EXPECT_EQ(typed("material[].group", "glass, frame"), "[\"glass\", \"frame\"]");
  EXPECT_EQ(typed("time.step", "auto"), "\"auto\"");
  EXPECT_EQ(typed("detection.verify", "true"), "true");
  EXPECT_EQ(typed("stage[].pressure[].value", "{ linear = \"1 GPa/s\" }"), "{ linear = \"1 GPa/s\" }");
  EXPECT_EQ(typed("material[].young", ""), "");
}

TEST(ValueText, TomlIsShownAsPeopleWriteIt) {
  EXPECT_EQ(shown("material[].young", "\"70 GPa\""), "70 GPa");
  EXPECT_EQ(shown("initial_velocity[].velocity", "[0, \"-3 m/s\", 0]"), "0, -3 m/s, 0");
  EXPECT_EQ(shown("title", "\"a \\\"b\\\"\""), "\"a \\\"b\\\"\"");
  EXPECT_EQ(shown("stage[].constraint[].velocity", "{ y = 1 }"), "{ y = 1 }");
}

TEST(ValueText, NamesOfGroupsAreReadFromATextAndFromAList) {
  EXPECT_EQ(shown("joint[].group", "[\"left\", \"right\"]"), "left, right");
  EXPECT_EQ(names_in("[\"left\", 'right']"), (QStringList{"left", "right"}));
  EXPECT_EQ(names_in("\"left\""), QStringList{"left"});
  EXPECT_TRUE(names_in("").isEmpty());
  const QString comma = "\"bolt, M6\"";
  EXPECT_EQ(names_in(comma), QStringList{"bolt, M6"});
  EXPECT_EQ(typed_value(case_::key_of("joint[].group"), shown_value(case_::key_of("joint[].group"), comma)), comma);
}

TEST(ValueText, AnglesAreTypedAndShownInDegrees) {
  EXPECT_EQ(typed("material[].friction_angle", "35"), "\"35 deg\"");
  EXPECT_EQ(typed("material[].friction_angle", "0.6 rad"), "\"0.6 rad\"");
  EXPECT_EQ(typed("material[].friction_angle", "0"), "0");
  EXPECT_EQ(shown("material[].friction_angle", "\"35 deg\""), "35 deg");
  EXPECT_EQ(shown("material[].friction_angle", "0.6"), "0.6 rad");
  EXPECT_EQ(shown("material[].friction_angle", "0"), "0");
  EXPECT_EQ(shown_unit("rad"), "deg");
  EXPECT_TRUE(tooltip_of(case_::key_of("material[].friction_angle")).contains("deg; rad"));
}

TEST(ValueText, PowersInUnitsAreRaisedAndNumbersHaveTheirWords) {
  EXPECT_EQ(shown_unit("kg/m3"), "kg/m³");
  EXPECT_EQ(shown_unit("kg m2/s"), "kg m²/s");
  EXPECT_EQ(shown_unit("m/s/s"), "m/s²");
  EXPECT_EQ(shown_unit("1/s"), "1/s");
  EXPECT_EQ(counted(1, "element", "elements"), "1 element");
  EXPECT_EQ(counted(421824, "element", "elements"), "421824 elements");
}

TEST(ValueText, EveryValueOfEveryShippedCaseMeansTheSameTypedAgain) {
  QDirIterator it(BRECCIA_MESHES, {"*.toml"}, QDir::Files, QDirIterator::Subdirectories);
  int values = 0;
  while (it.hasNext()) {
    QFile file(it.next());
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    const TomlPlaces places(file.readAll().toStdString());
    for (const Place& place : places.all()) {
      const case_::Key* key = case_::find_key(case_::pattern_of(place.path));
      if (key == nullptr || key->is_section()) continue;
      const std::string_view text = places.value(place.path);
      const QString toml = QString::fromUtf8(text.data(), static_cast<int>(text.size()));
      const QString again = typed_value(*key, shown_value(*key, toml));
      const auto plain = [](QString s) { return s.remove(' ').replace('\'', '"').toStdString(); };
      EXPECT_EQ(plain(again), plain(toml)) << place.path << " in " << file.fileName().toStdString();
      ++values;
    }
  }
  EXPECT_GT(values, 300);
}

TEST(ValueText, EveryKeyHasLabelAndTooltipWithUnitRangeAndDefault) {
  for (const case_::Key& key : case_::schema()) {
    if (key.is_section()) continue;
    EXPECT_FALSE(label_of(key).isEmpty());
    for (const char* part : {"Unit:", "Allowed:", "Default:", "Example:"})
      EXPECT_TRUE(tooltip_of(key).contains(part)) << key.path;
  }
}

}  // namespace
}  // namespace breccia::gui::value_text_test
