#include "case/nearest.hpp"

#include <gtest/gtest.h>

namespace breccia::case_ {
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

TEST(Nearest, AWordFarFromAllCandidatesIsNotGuessed) {
  EXPECT_EQ(likely_meant("aple", fruit), "apple");
  EXPECT_EQ(likely_meant("zucchini", fruit), "");
  EXPECT_EQ(likely_meant("apple", {}), "");
}

}  // namespace
}  // namespace breccia::case_
