#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/raster_case.hpp"
#include "unit/advice/advice_of.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::bending_rules_test {
namespace {

using test::as_list;
using testing::AllOf;
using testing::HasSubstr;

/// A bar of 200 mm along x.
std::string advice_on(const std::array<int, 3>& cells, double size, const std::string& held = "bar.x0") {
  const std::string text = test::raster_case({.group = "bar", .cells = cells, .cell_size = size}) +
                           "[[stage.constraint]]\ngroup = \"" + held + "\"\nfixed = \"xyz\"\n";
  const case_::Case input = case_::read_text(text, {});
  return as_list(stiff_bending(input, build_bare_model(input)));
}

TEST(Bending, OfABeamOrAPlateOneCellThickIsTooLittle) {
  EXPECT_THAT(advice_on({20, 1, 1}, 0.01),
              AllOf(HasSubstr("bar is slender and about 1.4 elements thick"), HasSubstr("its deflection is about 49 %"),
                    HasSubstr("a 4th of its thickness (2.4")));
  EXPECT_THAT(advice_on({20, 20, 1}, 0.01), HasSubstr("its deflection is about"));
}

TEST(Bending, IsNoMatterWhereItIsResolvedOrNothingBends) {
  EXPECT_EQ(advice_on({40, 4, 4}, 5e-3), "");
  EXPECT_EQ(advice_on({4, 4, 4}, 50e-3), "") << "a cube is not slender";
  EXPECT_EQ(advice_on({20, 1, 1}, 0.01, "bar"), "") << "all of it is held";
}

TEST(Bending, IsNoMatterOfASingleTetrahedron) {
  const case_::Case input =
      case_::read_text(test::raster_case({.group = "grain",
                                          .boxes = {2, 2, 2},
                                          .gap = 5e-3,
                                          .mesh = "kind = \"tetrahedra\"\nrandom_orientation = true\n"}));
  EXPECT_EQ(as_list(stiff_bending(input, build_bare_model(input))), "");
}

}  // namespace
}  // namespace breccia::bending_rules_test
