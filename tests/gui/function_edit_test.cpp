#include "core/function_edit.hpp"

#include <gtest/gtest.h>

#include <QDirIterator>
#include <QTemporaryDir>

#include "gui/block_case.hpp"

namespace breccia::gui::test::function_edit_test {
namespace {

constexpr const char* kPressure = "stage[0].pressure[0].value";

/// A case with a pressure of that value, between comments.
QByteArray with_pressure(const QByteArray& value) {
  return block_case(1, "10 us") + "[[stage.pressure]]\nsurface = \"block.x1\"\nvalue = " + value + "  # mine\n";
}

/// A case that is opened; what an edit of the value makes of its text.
struct Edited {
  QTemporaryDir scratch;
  Document document{scratch.filePath("state")};
  explicit Edited(const QByteArray& text) { EXPECT_EQ(document.open(written_case(scratch, text)), ""); }
  [[nodiscard]] FunctionEdit edit(const QString& path = kPressure) const { return {document, path}; }
};

QByteArray text_of(const FunctionEdit& edit) { return QByteArray::fromStdString(edit.text()); }

QStringList kinds_of(const FunctionEdit& edit, int component = 0) {
  QStringList kinds;
  for (const FunctionPart& part : edit.parts(component)) kinds << part.kind;
  return kinds;
}

TEST(FunctionEdit, LookingAtEveryFunctionOfEveryShippedCaseChangesNothing) {
  int seen = 0;
  QDirIterator it(BRECCIA_MESHES, {"*.toml"}, QDir::Files, QDirIterator::Subdirectories);
  while (it.hasNext()) {
    QTemporaryDir scratch;
    Document document(scratch.filePath("state"));
    ASSERT_EQ(document.open(it.next()), "");
    for (const Place& place : document.places().all()) {
      const case_::Key* key = case_::find_key(case_::pattern_of(place.path));
      if (key == nullptr || !FunctionEdit::takes_functions(*key)) continue;
      FunctionEdit edit(document, QString::fromStdString(place.path));
      EXPECT_TRUE(edit.is_readable()) << place.path;
      EXPECT_TRUE(edit.problems().empty()) << place.path;
      EXPECT_FALSE(edit.curves().empty()) << place.path;
      for (int c = 0; c < edit.components().size(); ++c)
        for (const FunctionPart& part : edit.parts(c)) {
          const std::vector<FunctionEdit::Row> points =
              part.kind == "table" ? edit.points(part) : std::vector<FunctionEdit::Row>();
          for (std::size_t r = 0; r < points.size(); ++r)
            for (int i = 0; i < 2; ++i)
              edit.set_point(part, static_cast<int>(r), i, points[r][static_cast<std::size_t>(i)]);
          for (const FunctionNumber& number : edit.numbers(part))
            if (part.kind != "table") edit.set_number(number, edit.number(number));
        }
      EXPECT_EQ(text_of(edit), document.text());
      ++seen;
    }
  }
  EXPECT_GT(seen, 20);
}

TEST(FunctionEdit, ANumberIsReplacedWhereItStandsAndAllElseStays) {
  const Edited edited(with_pressure("{ linear = \"20 GPa/s\",  ramp = { to = \"8 MPa\", end = \"4 us\" } }"));
  FunctionEdit edit = edited.edit();
  EXPECT_EQ(kinds_of(edit), (QStringList{"linear", "ramp"}));
  const std::vector<FunctionNumber> ramp = edit.numbers(edit.parts(0)[1]);
  ASSERT_EQ(ramp.size(), 4U);
  EXPECT_EQ(ramp[1].unit, "Pa");
  EXPECT_EQ(ramp[3].unit, "s");
  EXPECT_EQ(edit.number(ramp[1]), "8 MPa");
  EXPECT_EQ(edit.numbers(edit.parts(0)[0])[0].unit, "Pa/s");
  edit.set_number(ramp[1], "9 MPa");
  edit.set_number(ramp[2], "1 us");
  EXPECT_EQ(text_of(edit),
            with_pressure("{ linear = \"20 GPa/s\",  ramp = { to = \"9 MPa\", end = \"4 us\", start = \"1 us\" } }"));
  edit.set_number(ramp[2], "");
  EXPECT_EQ(text_of(edit), with_pressure("{ linear = \"20 GPa/s\",  ramp = { to = \"9 MPa\", end = \"4 us\" } }"));
}

TEST(FunctionEdit, AnotherKindKeepsTheValueAndEndsWithItsStage) {
  const Edited edited(with_pressure("\"8 MPa\""));
  FunctionEdit edit = edited.edit();
  EXPECT_EQ(kinds_of(edit), QStringList{"constant"});
  for (const auto& [kind, toml] : std::initializer_list<std::pair<const char*, QByteArray>>{
           {"ramp", "{ ramp = { to = \"8 MPa\", end = \"10 us\" } }"},
           {"sine", "{ sine = { amplitude = \"8 MPa\", frequency = 0 } }"},
           {"table", "{ table = [[0, \"8 MPa\"], [\"10 us\", \"8 MPa\"]] }"},
           {"constant", "\"8 MPa\""},
           {"linear", "{ linear = 0 }"}}) {
    edit.choose(0, kind);
    EXPECT_EQ(text_of(edit), with_pressure(toml));
    EXPECT_EQ(kinds_of(edit), QStringList{kind});
    EXPECT_TRUE(edit.problems().empty());
  }
}

TEST(FunctionEdit, PartsAddUpAndAreTakenOut) {
  const Edited edited(with_pressure("\"8 MPa\""));
  FunctionEdit edit = edited.edit();
  edit.add(0, "sine");
  EXPECT_EQ(text_of(edit), with_pressure("{ constant = \"8 MPa\", sine = { amplitude = 0, frequency = 0 } }"));
  edit.add(0, "sine");
  edit.add(0, "linear");
  EXPECT_EQ(kinds_of(edit), (QStringList{"constant", "sine", "sine", "linear"}));
  EXPECT_TRUE(edit.problems().empty());
  edit.remove(0, edit.parts(0)[1]);
  EXPECT_EQ(kinds_of(edit), (QStringList{"constant", "sine", "linear"}));
  edit.remove(0, edit.parts(0)[1]);
  edit.remove(0, edit.parts(0)[0]);
  EXPECT_EQ(text_of(edit), with_pressure("{ linear = 0 }"));
  edit.remove(0, edit.parts(0)[0]);
  EXPECT_EQ(kinds_of(edit), QStringList{"linear"}) << "the last one stays";
}

TEST(FunctionEdit, PointsOfAFileHaveTheirColumnsAndUnitsInTheFormAndTheirCurve) {
  const Edited edited(with_pressure("\"8 MPa\""));
  QFile file(edited.scratch.filePath("history.csv"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("t [us];x;p\n0;0;1\n10;0;5\n");
  file.close();
  FunctionEdit edit = edited.edit();
  edit.choose(0, "csv");
  EXPECT_EQ(text_of(edit), with_pressure("{ csv = { file = \"history.csv\" } }"));
  const auto row = [&](const char* name) {
    for (const FunctionNumber& number : edit.numbers(edit.parts(0)[0]))
      if (number.row->name() == name) return number;
    ADD_FAILURE() << name;
    return FunctionNumber();
  };
  edit.set_number(row("value"), "3");
  edit.set_number(row("value_unit"), "MPa");
  EXPECT_EQ(text_of(edit), with_pressure("{ csv = { file = \"history.csv\", value = 3, value_unit = \"MPa\" } }"));
  edit.set_number(row("value"), "p");
  EXPECT_EQ(text_of(edit), with_pressure("{ csv = { file = \"history.csv\", value = \"p\", value_unit = \"MPa\" } }"));
  ASSERT_TRUE(edit.problems().empty()) << edit.problems().front().text();
  const std::vector<PlotLine> lines = edit.curves();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].y.front(), 1e6);
  EXPECT_EQ(lines[0].y.back(), 5e6);
  edit.set_number(row("file"), "gone.csv");
  ASSERT_EQ(edit.problems().size(), 1U);
  EXPECT_NE(edit.problems()[0].text().find("csv.file: the file does not exist"), std::string::npos);
}

TEST(FunctionEdit, PointsOfATableAreEditedAndPasted) {
  const Edited edited(with_pressure("{ table = [[0, 0], [\"5 us\", \"1 MPa\"]] }"));
  FunctionEdit edit = edited.edit();
  const FunctionPart table = edit.parts(0)[0];
  edit.set_point(table, 1, 1, "2 MPa");
  EXPECT_EQ(text_of(edit), with_pressure("{ table = [[0, 0], [\"5 us\", \"2 MPa\"]] }"));
  edit.set_points(table, FunctionEdit::rows_of("time [us],pressure [MPa]\n0,0\n2.5,1e1\n"));
  EXPECT_EQ(text_of(edit), with_pressure("{ table = [[\"0 us\", \"0 MPa\"], [\"2.5 us\", \"1e1 MPa\"]] }"));
  EXPECT_TRUE(edit.problems().empty());
  const std::vector<PlotLine> lines = edit.curves();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].x.back(), 10e-6);
  EXPECT_EQ(lines[0].y.back(), 10e6);
}

TEST(FunctionEdit, ACopiedTableMayBeApartByAnySign) {
  using Rows = std::vector<FunctionEdit::Row>;
  const Rows wanted{{"0", "1"}, {"2", "3"}};
  for (const char* text : {"0,1\n2,3", "0;1\r\n2;3\r\n", "0\t1\n2\t3\n", "  0   1\n2 3", "t;v\n0;1\n\n2;3;9\n"})
    EXPECT_EQ(FunctionEdit::rows_of(text), wanted) << text;
  EXPECT_EQ(FunctionEdit::rows_of("0,5;1 MPa"), (Rows{{"0,5", "1 MPa"}})) << "a decimal comma";
  EXPECT_TRUE(FunctionEdit::rows_of("no table at all").empty());
}

TEST(FunctionEdit, AxesHaveFunctionsOfTheirOwnAndMayBeFree) {
  const QByteArray begin = block_case(1, "10 us") + "[[stage.constraint]]\ngroup = \"block\"\n";
  const Edited edited(begin + "velocity = { y = \"1 m/s\" } # mine\n");
  FunctionEdit edit = edited.edit("stage[0].constraint[0].velocity");
  ASSERT_TRUE(edit.may_be_missing());
  EXPECT_TRUE(edit.parts(0).empty());
  edit.choose(0, "ramp");
  edit.choose(1, "");
  EXPECT_EQ(text_of(edit), begin + "velocity = { x = { ramp = { to = 0, end = \"10 us\" } } } # mine\n");
  EXPECT_EQ(edit.curves().size(), 1U);
  edit.choose(0, "");
  EXPECT_EQ(text_of(edit), begin);
  edit.choose(2, "constant");
  EXPECT_EQ(text_of(edit), begin + "velocity = { z = 0 }\n");
}

TEST(FunctionEdit, AVectorThatIsNotGivenBeginsWithItsDefault) {
  const Edited edited(block_case(1, "10 us"));
  FunctionEdit edit = edited.edit("stage[0].gravity");
  EXPECT_EQ(edit.components(), (QStringList{"x", "y", "z"}));
  edit.choose(2, "ramp");
  EXPECT_EQ(text_of(edit), block_case(1, "10 us") + "gravity = [0, 0, { ramp = { to = 0, end = \"10 us\" } }]\n");
}

TEST(FunctionEdit, TheCaseGetsAllAsOneEditAndMistakesInTheWordsOfTheSolver) {
  Edited edited(with_pressure("\"8 MPa\""));
  FunctionEdit edit = edited.edit();
  edit.choose(0, "ramp");
  edit.set_number(edit.numbers(edit.parts(0)[0])[1], "9 m");
  ASSERT_EQ(edit.problems().size(), 1U);
  edit.give_to(edited.document);
  EXPECT_EQ(edited.document.problems().size(), 1U);
  EXPECT_EQ(edited.document.problems()[0].text(), edit.problems()[0].text());
  edited.document.undo_stack().undo();
  EXPECT_EQ(edited.document.text(), with_pressure("\"8 MPa\""));
  EXPECT_FALSE(edited.document.undo_stack().canUndo());
}

TEST(FunctionEdit, WhatStandsInSectionsOfItsOwnIsForTheText) {
  const QByteArray begin = block_case(1, "10 us") + "[[stage.pressure]]\nsurface = \"block.x1\"\n";
  EXPECT_FALSE(Edited(begin + "[stage.pressure.value]\nlinear = 1\n").edit().is_readable());
  EXPECT_TRUE(Edited(begin + "value = { linear = 1 }\n").edit().is_readable());
  const Edited axes(block_case(1, "10 us") +
                    "[[stage.constraint]]\ngroup = \"block\"\n[stage.constraint.velocity]\nx = 1\n");
  FunctionEdit edit = axes.edit("stage[0].constraint[0].velocity");
  ASSERT_TRUE(edit.is_readable());
  edit.choose(2, "constant");
  EXPECT_TRUE(text_of(edit).endsWith("[stage.constraint.velocity]\nx = 1\nz = 0\n")) << edit.text();
}

TEST(FunctionEdit, KnowsTheEndsOfTheStages) {
  const Edited edited(with_pressure("0") + "[[stage]]\nend = \"30 us\"\n[[stage.pressure]]\nvalue = 1\n");
  EXPECT_EQ(edited.edit().stage_ends(), (std::vector<double>{10e-6, 30e-6}));
  EXPECT_EQ(edited.edit().stage(), 0);
  EXPECT_EQ(edited.edit("stage[1].pressure[0].value").stage(), 1);
}

}  // namespace
}  // namespace breccia::gui::test::function_edit_test
