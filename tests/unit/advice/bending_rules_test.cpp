#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/advice/told_by.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::bending_rules_test {
namespace {

using test::as_list;
using testing::AllOf;
using testing::HasSubstr;

/// A bar of 200 mm along x.
std::string advice_on(const std::string& cells, const std::string& size, const std::string& held = "bar.x0") {
  const std::string text = "[mesh.raster]\ncells = " + cells + "\ncell_size = \"" + size + R"("
group = "bar"
[[material]]
group = "bar"
young = "1 GPa"
poisson = 0.2
density = 1000
joints = "none"
[[stage]]
end = "1 ms"
[[stage.constraint]]
group = ")" + held + "\"\nfixed = \"xyz\"\n";
  const case_::Case input = case_::read_text(text, {});
  return as_list(stiff_bending(input, build_bare_model(input)));
}

TEST(Bending, OfABeamOrAPlateOneCellThickIsTooLittle) {
  EXPECT_THAT(advice_on("[20, 1, 1]", "10 mm"),
              AllOf(HasSubstr("bar is slender and about 1.4 elements thick"), HasSubstr("it bends by about 49 %"),
                    HasSubstr("a 4th of its thickness (2.4")));
  EXPECT_THAT(advice_on("[20, 20, 1]", "10 mm"), HasSubstr("it bends by about"));
}

TEST(Bending, IsNoMatterWhereItIsResolvedOrNothingBends) {
  EXPECT_EQ(advice_on("[40, 4, 4]", "5 mm"), "");
  EXPECT_EQ(advice_on("[4, 4, 4]", "50 mm"), "") << "a cube is not slender";
  EXPECT_EQ(advice_on("[20, 1, 1]", "10 mm", "bar"), "") << "all of it is held";
}

TEST(Bending, IsNoMatterOfASingleTetrahedron) {
  const case_::Case input = case_::read_text(R"([mesh.raster]
kind = "tetrahedra"
boxes = [2, 2, 2]
cell_size = "10 mm"
gap = "5 mm"
random_orientation = true
group = "grain"
[[material]]
group = "grain"
young = "1 GPa"
poisson = 0.2
density = 1000
joints = "none"
[[stage]]
end = "1 ms"
)",
                                             {});
  EXPECT_EQ(as_list(stiff_bending(input, build_bare_model(input))), "");
}

}  // namespace
}  // namespace breccia::bending_rules_test
