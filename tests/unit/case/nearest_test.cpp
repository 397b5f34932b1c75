#include "case/nearest.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace breccia::case_::nearest_test {
namespace {

const std::vector<std::string> fruit{"apple", "pear", "plum", "grape"};

TEST(Nearest, DistanceCountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(edit_distance("density", "density"), 0U);
  EXPECT_EQ(edit_distance("densty", "density"), 1U);
  EXPECT_EQ(edit_distance("densityy", "density"), 1U);
  EXPECT_EQ(edit_distance("denzity", "density"), 1U);
  EXPECT_EQ(edit_distance("desnity", "density"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
}

TEST(Nearest, DistanceIgnoresCase) { EXPECT_EQ(edit_distance("Gpa", "GPa"), 0U); }

TEST(Nearest, CandidatesComeInOrderOfDistance) {
  const std::vector<std::string> candidates{"pear", "plumber", "plum"};  // at distances 4, 3, 1
  EXPECT_EQ(nearest_first("plums", candidates), (std::vector<std::string>{"plum", "plumber", "pear"}));
}

TEST(Nearest, OfEquallyNearOnesTheOneWithTheSameCapitalsIsFirst) {
  EXPECT_EQ(likely_meant("GPpa", std::vector<std::string>{"pPa", "GPa"}), "GPa");
}

TEST(Nearest, OfManyCandidatesADozenAreNamedAndTheOthersCounted) {
  std::vector<std::string> many;
  for (int i = 0; i < 20; ++i) many.push_back("g" + std::to_string(i));
  const std::string all = nearest_words("g1", many);
  EXPECT_EQ(std::count(all.begin(), all.end(), ','), 19);
  for (int i = 20; i < 3000; ++i) many.push_back("g" + std::to_string(i));
  const std::string some = nearest_words("g1", many);
  EXPECT_TRUE(some.starts_with("g1, ")) << some;
  EXPECT_TRUE(some.ends_with(" and 2988 more")) << some;
  EXPECT_EQ(std::count(some.begin(), some.end(), ','), 11);
}

TEST(Nearest, AWordFarFromAllCandidatesIsNotGuessed) {
  EXPECT_EQ(likely_meant("aple", fruit), "apple");
  EXPECT_EQ(likely_meant("zucchini", fruit), "");
  EXPECT_EQ(likely_meant("apple", {}), "");
}

}  // namespace
}  // namespace breccia::case_::nearest_test
