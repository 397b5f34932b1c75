#include "base/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/printable.hpp"

namespace breccia::error_test {
namespace {

using ::testing::HasSubstr;

TEST(Problem, NamesFileLineKeyWhatIsWrongWhatIsAllowedAndWhatWasGiven) {
  const Problem p{"case.toml", 12, "material[0].density", "not a density", "a number in kg/m3", "\"heavy\""};
  EXPECT_EQ(p.text(), "case.toml:12: material[0].density: not a density; allowed: a number in kg/m3; given: \"heavy\"");
}

TEST(Problem, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ((Problem{"", 0, "", "something is wrong", "", ""}.text()), "something is wrong");
  EXPECT_EQ((Problem{"plate.msh", 0, "element 17", "has no volume", "", ""}.text()),
            "plate.msh: element 17: has no volume");
  EXPECT_EQ((Problem{"a.toml", 3, "", "unreadable", "", "x"}.text()), "a.toml:3: unreadable; given: x");
}

TEST(Problem, DoesNotPrintALineNumberWithoutAFile) {
  EXPECT_EQ((Problem{"", 7, "time.safety", "too large", "0..1", ""}.text()), "time.safety: too large; allowed: 0..1");
}

TEST(Problem, WritesControlCharactersOfTheInputSoThatATerminalDoesNotObeyThem) {
  const Problem p{"a\tb.toml", 1, "ti\nme\x1b[31m", "unknown", "", std::string("1 GPa\0", 6) + "\xc2\x9b" + "\u00b5"};
  EXPECT_EQ(p.text(), "a\\tb.toml:1: ti\\nme\\x1b[31m: unknown; given: 1 GPa\\x00\\x9b\u00b5");
}

TEST(Printable, KeepsTheLinesOfATextAndWritesAllOtherControlCharacters) {
  EXPECT_EQ(printable_lines("a\tb\nc\x1b[2J\r\xc2\x9b\x7f\u00b5"), "a\tb\nc\\x1b[2J\\x0d\\x9b\\x7f\u00b5");
  EXPECT_EQ(printable("a\tb\nc"), "a\\tb\\nc");
}

TEST(InputError, TellsTheFirstFiftyProblemsAndHowManyMoreThereAre) {
  const std::vector<Problem> many(5000, Problem{"a", 1, "k", "wrong", "", ""});
  const InputError e(many);
  const std::string text = e.what();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 50);
  EXPECT_TRUE(text.ends_with("\nand 4950 more")) << text;
  EXPECT_EQ(e.problems().size(), many.size());
}

TEST(InputError, TellsEveryProblemOnItsOwnLineInOrder) {
  const InputError e({{"a", 1, "k", "first", "", ""}, {"a", 2, "k", "second", "", ""}});
  EXPECT_STREQ(e.what(), "a:1: k: first\na:2: k: second");
  ASSERT_EQ(e.problems().size(), 2U);
  EXPECT_EQ(e.problems()[1].line, 2);
}

TEST(InputError, OfOneProblemReadsAsThatProblem) {
  const Problem p{"a", 1, "k", "what", "", ""};
  EXPECT_EQ(InputError(p).what(), p.text());
}

TEST(OutputError, IsCaughtAsAnInputError) {
  EXPECT_THROW(throw OutputError(Problem{"runs/x", 0, "", "disk full", "", ""}), InputError);
}

TEST(Demand, ThrowsTheConditionThePlaceAndTheValuesWhenItDoesNotHold) {
  const int links = 5;
  try {
    DEMAND(links <= 4, "links = " + std::to_string(links));
    FAIL() << "DEMAND let a false condition pass";
  } catch (const InternalError& e) {
    EXPECT_THAT(e.what(), HasSubstr("links <= 4"));
    EXPECT_THAT(e.what(), HasSubstr("links = 5"));
    EXPECT_THAT(e.what(), HasSubstr("error_test.cpp:"));
  }
}

TEST(Demand, DoesNotBuildItsDetailWhenTheConditionHolds) {
  bool built = false;
  const auto detail = [&built] {
    built = true;
    return std::string("built");
  };
  EXPECT_NO_THROW(DEMAND(1 + 1 == 2, detail()));
  EXPECT_FALSE(built);
}

}  // namespace
}  // namespace breccia::error_test
