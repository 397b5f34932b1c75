#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "advice/advice.hpp"
#include "case/schema.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::rules_test {
namespace {

TEST(Rules, HaveNamesOfTheirOwnAndStandByLevel) {
  std::set<std::string> names;
  for (const Rule& rule : rules()) EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
  EXPECT_TRUE(
      std::is_sorted(rules().begin(), rules().end(), [](const Rule& a, const Rule& b) { return a.level < b.level; }));
}

TEST(Rules, LeadToKeysOfTheCase) {
  for (const Rule& rule : rules()) {
    const auto is_its = [&](const case_::Key& key) { return key.path == rule.key; };
    EXPECT_TRUE(std::any_of(case_::schema().begin(), case_::schema().end(), is_its)) << rule.name << ": " << rule.key;
  }
}

TEST(Advice, StandsInTheOrderOfTheRules) {
  const case_::Case input = case_::read_text(case_::minimal, {"material[0].density=1", "time.step=1 ms"});
  const Model model = build_model(input);
  const std::vector<Advice> advice = advise(Subject(input, model));
  std::vector<std::string> names;
  for (const Advice& one : advice) names.push_back(one.rule->name);
  EXPECT_THAT(names, testing::ElementsAre("step_too_long", "implausible_material"));
}

}  // namespace
}  // namespace breccia::rules_test
