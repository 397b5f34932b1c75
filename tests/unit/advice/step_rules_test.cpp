#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "case/reader.hpp"
#include "support/raster_case.hpp"
#include "unit/advice/advice_of.hpp"

namespace breccia::step_rules_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Two stacks of cubes 1 um apart that may touch; the upper one falls.
std::string boxes(double penalty, const std::string& more = "") {
  return test::raster_case({.title = "boxes",
                            .group = "box",
                            .cells = {2, 2, 2},
                            .boxes = {1, 1, 2},
                            .gap = 1e-6,
                            .young = 30e9,
                            .density = 2500,
                            .contact_penalty = penalty}) +
         more;
}

struct Checked {
  case_::Case input;
  Model model;
  double limit;  ///< s
  std::string advice;
};

Checked check(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / ("step_report_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << text;
  case_::Case input = case_::read_case(file, {});
  std::filesystem::remove(file);
  Model model = build_model(input);
  const Subject subject(input, model);
  const std::string advice =
      test::advice_of({"step_of_contact", "step_of_viscosity", "step_too_long", "one_bad_element", "slivers"}, subject);
  const double limit = subject.step().now().step;
  return {std::move(input), std::move(model), limit, advice};
}

TEST(StepReport, BlamesAViscosityForTheStepItCostsAndNamesOneThatCostsLittle) {
  const auto with = [](const std::string& viscosity) {
    std::string text = boxes(1e9);
    return check(text.insert(text.find("[[contact]]"), "viscosity = " + viscosity + "\n"));
  };
  const double plain = with("0").limit;
  const Checked much = with("1e6");
  const std::string advice = much.advice;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      advice, found,
      std::regex("Viscosity makes the step ([0-9.e+]+) times shorter \\(material.viscosity of box: 1 MPa s\\); "
                 "([0-9.]+) kPa s would make it 1.2 times shorter")))
      << advice;
  constexpr double kTwoDigits = 0.05;  // as many as are printed
  EXPECT_NEAR(std::stod(found[1]) * much.limit / plain, 1.0, kTwoDigits);
  const Checked little = with(found[2].str() + "e3");
  EXPECT_NEAR(plain / little.limit, 1.2, kTwoDigits);
  EXPECT_THAT(little.advice, Not(HasSubstr("Viscosity")));
}

TEST(StepReport, NamesAPenaltyThatWouldNotCostAnything) {
  const Checked stiff = check(boxes(300e9));
  EXPECT_THAT(stiff.advice, HasSubstr("Contact makes the step"));
  std::smatch found;
  const std::string advice = stiff.advice;
  ASSERT_TRUE(std::regex_search(advice, found, std::regex("a penalty of ([0-9.e+]+) Pa instead of 3e\\+11")));
  const Checked soft = check(boxes(std::stod(found[1])));
  EXPECT_THAT(soft.advice, Not(HasSubstr("Contact")));
  EXPECT_GT(soft.limit, 3 * stiff.limit);
}

TEST(StepReport, BlamesTheDampingOfContactForTheStepItCosts) {
  const auto with = [](const std::string& ratio) {
    std::string text = boxes(1e9);
    return check(text.insert(text.find("penalty"), "damping_ratio = " + ratio + "\n"));
  };
  const Checked much = with("1");
  const std::string advice = much.advice;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(advice, found,
                                std::regex("contact.damping_ratio makes the step ([0-9.]+) times shorter where bodies "
                                           "meet; a tenth of it would make it ([0-9.]+) times")))
      << advice;
  EXPECT_THAT(advice, Not(HasSubstr("a penalty of")));
  constexpr double kTwoDigits = 0.05;  // as many as are printed
  const double plain = with("0").limit;
  EXPECT_NEAR(std::stod(found[1]) * much.limit / plain, 1.0, kTwoDigits);
  EXPECT_NEAR(std::stod(found[2]) * with("0.1").limit / plain, 1.0, kTwoDigits);
  EXPECT_THAT(with("0.01").advice, Not(HasSubstr("damping_ratio")));
}

TEST(StepReport, JudgesAGivenStepByTheTrueLimit) {
  const double free = check(boxes(1)).limit;
  const auto with_step = [&](double step) {
    return check(boxes(1, "[time]\nstep = " + std::to_string(step * 1e9) + "e-9\n"));
  };
  const Checked short_one = with_step(0.98 * free), long_one = with_step(1.1 * free);
  EXPECT_THAT(short_one.advice, Not(HasSubstr("time.step")));
  EXPECT_THAT(long_one.advice, HasSubstr("the run will blow up"));
}

TEST(StepReport, TellsAGivenStepThatOnlyContactForbidsApart) {
  const double stiff = check(boxes(300e9)).limit;
  const Checked given = check(boxes(300e9, "[time]\nstep = " + std::to_string(2e9 * stiff) + "e-9\n"));
  EXPECT_THAT(given.advice, HasSubstr("may gain energy"));
  EXPECT_THAT(given.advice, Not(HasSubstr("will blow up")));
}

TEST(StepReport, BlamesNoSliversWhereThereAreNone) { EXPECT_THAT(check(boxes(1)).advice, Not(HasSubstr("sliver"))); }

}  // namespace
}  // namespace breccia::step_rules_test
