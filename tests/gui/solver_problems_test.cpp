#include "core/solver_problems.hpp"

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

namespace breccia::gui::solver_problems_test {
namespace {

const Problem kProblem{"case.toml", 4, "stage[0].end", "the mesh cannot be held so long", "", ""};

/// A case of a stage with an end at line 4.
void open_case(Document& document, const QTemporaryDir& scratch) {
  QFile out(scratch.filePath("case.toml"));
  ASSERT_TRUE(out.open(QIODevice::WriteOnly));
  out.write("title = \"a\"\n\n[[stage]]\nend = 1\n");
  out.close();
  ASSERT_EQ(document.open(out.fileName()), "");
}

TEST(SolverProblems, AProblemHoldsUntilWhatItIsAboutIsEdited) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  open_case(document, scratch);
  SolverProblems told;
  told.take(document.text(), {kProblem, kProblem});
  ASSERT_EQ(told.beside({}, document).size(), 1U) << "told once";
  EXPECT_FALSE(told.are_of_another_text(document));
  EXPECT_TRUE(told.beside({kProblem}, document).empty()) << "the reader says the same";
  document.set_value("mesh.file", "\"a.geo\"");
  document.set_text("# new\n" + document.text());
  ASSERT_EQ(told.beside({}, document).size(), 1U);
  EXPECT_EQ(told.beside({}, document)[0].line, document.places().find("stage[0].end")->line) << "where it stands now";
  EXPECT_TRUE(told.are_of_another_text(document)) << "the solver is to be asked anew";
  document.set_value("stage[0].end", "2");
  EXPECT_TRUE(told.beside({}, document).empty());
  EXPECT_TRUE(told.empty()) << "an undo does not bring it back unasked";
}

TEST(SolverProblems, AnAnswerAboutATextThatHasBeenEditedMeanwhileSaysNothingOfTheNewOne) {
  const QTemporaryDir scratch;
  Document document(scratch.filePath("state"));
  open_case(document, scratch);
  const QByteArray asked = document.text();
  document.set_value("stage[0].end", "2");
  SolverProblems told;
  told.take(asked, {kProblem});
  EXPECT_TRUE(told.beside({}, document).empty());
}

}  // namespace
}  // namespace breccia::gui::solver_problems_test
