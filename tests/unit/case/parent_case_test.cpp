#include "case/parent_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case_files.hpp"

namespace breccia::case_::parent_case_test {
namespace {

using testing::HasSubstr;

const std::string kMaterials = R"([[material]]
group = ["a", "b", "c"]
young = "10 GPa"
poisson = 0.2
density = 2400
)";
const std::string kInside = "[[joint]]\ngroup = \"*\"\ntensile_strength = \"1 MPa\"\nenergy_mode_1 = \"10 J/m2\"\n";
const std::string kStage = "[[stage]]\nend = \"1 ms\"\n";

std::string between(const std::string& pair, const std::string& more = "") {
  return "[[joint]]\nbetween = " + pair + "\ntensile_strength = \"2 MPa\"\nenergy_mode_1 = \"10 J/m2\"\n" + more;
}

/// What a case is told that starts from one with a law for any interface; empty: nothing. @param joints  of the case
std::string told(const std::string& joints) {
  const CaseFolder folder;
  const std::string mesh = "[mesh]\nfile = \"" + folder.write("geometry.geo", "").string() + "\"\nglue = true\n";
  const ParentCase parent =
      parent_case(mesh + kMaterials + kInside + between("[\"*\", \"*\"]") + kStage, folder.path() / "parent.toml", {});
  const auto file = folder.write("case.toml", "[start]\nfrom = \"run\"\n" + kMaterials + kInside + joints + kStage);
  try {
    (void)read_started_case(file, {}, parent);
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1u) << error.what();
    return error.what();
  }
  return {};
}

TEST(ParentCase, ALawOfAnyGroupsAndOneOfAPairTakeEachOthersPlaces) {
  EXPECT_EQ(told(between("[\"*\", \"*\"]")), "");
  EXPECT_EQ(told(between("[\"b\", \"*\"]", "friction = 0.3\n") + between("[\"a\", \"c\"]")), "");
}

TEST(ParentCase, ALawOfAPairMayNotBeOfAnotherKindThanTheOneOfAnyGroupsBefore) {
  for (const char* more : {"law = \"independent_peaks\"\n", "rise = \"parabolic\"\n", "points = \"mid_edge\"\n",
                           "weibull_modulus = 5\n"}) {
    const std::string message = told(between("[\"a\", \"c\"]") + between("[\"b\", \"*\"]", more));
    EXPECT_THAT(message, HasSubstr("case.toml:16: joint[2]: cannot change where a run starts from")) << more;
    EXPECT_THAT(message, HasSubstr("of joint[1] of that run")) << more;
  }
}

TEST(ParentCase, WhatIsRefusedIsToldByItsPlaceInTheFile) {
  const std::string message = told(between("[\"*\", \"*\"]", "points = \"mid_edge\"\n"));
  EXPECT_THAT(message, HasSubstr("case.toml:16: joint[1].points: cannot change where a run starts from"));
}

}  // namespace
}  // namespace breccia::case_::parent_case_test
