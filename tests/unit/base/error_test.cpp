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

TEST(Problem, names_file_line_key_what_is_wrong_what_is_allowed_and_what_was_given) {
  const Problem p{"case.toml", 12, "material[0].density", "not a density", "a number in kg/m3", "\"heavy\""};
  EXPECT_EQ(p.text(), "case.toml:12: material[0].density: not a density; allowed: a number in kg/m3; given: \"heavy\"");
}

TEST(Problem, leaves_out_what_is_not_known) {
  EXPECT_EQ((Problem{"", 0, "", "something is wrong", "", ""}.text()), "something is wrong");
  EXPECT_EQ((Problem{"plate.msh", 0, "element 17", "has no volume", "", ""}.text()),
            "plate.msh: element 17: has no volume");
  EXPECT_EQ((Problem{"a.toml", 3, "", "unreadable", "", "x"}.text()), "a.toml:3: unreadable; given: x");
}

TEST(Problem, does_not_print_a_line_number_without_a_file) {
  EXPECT_EQ((Problem{"", 7, "time.safety", "too large", "0..1", ""}.text()), "time.safety: too large; allowed: 0..1");
}

TEST(Problem, writes_control_characters_of_the_input_so_that_a_terminal_does_not_obey_them) {
  const Problem p{"a\tb.toml", 1, "ti\nme\x1b[31m", "unknown", "", std::string("1 GPa\0", 6) + "\xc2\x9b" + "\u00b5"};
  EXPECT_EQ(p.text(), "a\\tb.toml:1: ti\\nme\\x1b[31m: unknown; given: 1 GPa\\x00\\x9b\u00b5");
}

TEST(Printable, keeps_the_lines_of_a_text_and_writes_all_other_control_characters) {
  EXPECT_EQ(printable_lines("a\tb\nc\x1b[2J\r\xc2\x9b\x7f\u00b5"), "a\tb\nc\\x1b[2J\\x0d\\x9b\\x7f\u00b5");
  EXPECT_EQ(printable("a\tb\nc"), "a\\tb\\nc");
}

TEST(InputError, tells_the_first_fifty_problems_and_how_many_more_there_are) {
  const std::vector<Problem> many(5000, Problem{"a", 1, "k", "wrong", "", ""});
  const InputError e(many);
  const std::string text = e.what();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 50);
  EXPECT_TRUE(text.ends_with("\nand 4950 more")) << text;
  EXPECT_EQ(e.problems().size(), many.size());
}

TEST(InputError, tells_every_problem_on_its_own_line_in_order) {
  const InputError e({{"a", 1, "k", "first", "", ""}, {"a", 2, "k", "second", "", ""}});
  EXPECT_STREQ(e.what(), "a:1: k: first\na:2: k: second");
  ASSERT_EQ(e.problems().size(), 2U);
  EXPECT_EQ(e.problems()[1].line, 2);
}

TEST(InputError, of_one_problem_reads_as_that_problem) {
  const Problem p{"a", 1, "k", "what", "", ""};
  EXPECT_EQ(InputError(p).what(), p.text());
}

TEST(OutputError, is_caught_as_an_input_error) {
  EXPECT_THROW(throw OutputError(Problem{"runs/x", 0, "", "disk full", "", ""}), InputError);
}

TEST(Demand, throws_the_condition_the_place_and_the_values_when_it_does_not_hold) {
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

TEST(Demand, does_not_build_its_detail_when_the_condition_holds) {
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
