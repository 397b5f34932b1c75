#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "end_to_end/program.hpp"

/// Blocks that stand on each other.
namespace breccia::test::block_test {
namespace {

enum class Joints { none, breakable };

std::string material(const std::string& group, Joints joints) {
  std::string text = "[[material]]\ngroup = \"" + group + "\"\nyoung = \"2 GPa\"\npoisson = 0\ndensity = 2000\n";
  if (joints == Joints::none) return text + "joints = \"none\"\n";
  return text + "joints = \"breakable\"\n[[joint]]\ngroup = \"" + group + R"("
penalty_factor = 20
tensile_strength = "3 MPa"
shear_strength = "6 MPa"
energy_mode_1 = "300 J/m2"
energy_mode_2 = "900 J/m2"
)";
}

/// m, furthest sideways motion of a block whose centre of mass lies 80 mm beside the middle of its base, which is
/// 200 mm wide and one face across. @param beside  by which the block below is not quite under it
double motion_of_overhanging_block(const Scratch& scratch, const std::string& beside, int ranks,
                                   Joints joints = Joints::none) {
  scratch.write("blocks.geo", R"(SetFactory("OpenCASCADE");
DefineConstant[ dx = 0 ];
Rectangle(1) = {-0.1, -0.4, 0, 0.2, 0.4};
Point(100) = {-0.1 + dx, 0, 0}; Point(101) = {0.1 + dx, 0, 0}; Point(102) = {0.1 + dx, 0.2, 0};
Point(103) = {0.3338 + dx, 0.2, 0}; Point(104) = {0.3338 + dx, 0.4, 0}; Point(105) = {-0.1 + dx, 0.4, 0};
Line(100) = {100, 101}; Line(101) = {101, 102}; Line(102) = {102, 103};
Line(103) = {103, 104}; Line(104) = {104, 105}; Line(105) = {105, 100};
Curve Loop(100) = {100:105};
Plane Surface(2) = {100};
Extrude {0, 0, 0.05} { Surface{1, 2}; Layers{1}; }
Physical Volume("lower") = {1};
Physical Volume("upper") = {2};
MeshSize{:} = 0.2;
Mesh.Algorithm = 5;
)");
  const std::string file = scratch.write(
      "blocks.toml", "title = \"blocks\"\n[mesh]\nfile = \"blocks.geo\"\nparameters = { dx = \"" + beside +
                         "\" }\n[plane]\nkind = \"strain\"\n" + material("lower", joints) + material("upper", joints) +
                         R"([[contact]]
between = ["*", "*"]
penalty = "50 MPa"
friction = 0.8
damping_ratio = 0.2
[contact_points]
per_face = 4
[[stage]]
end = "0.3 s"
gravity = [0, { ramp = { to = -9.81, end = "0.1 s" } }, 0]
[[stage.constraint]]
group = "lower"
fixed = "xyz"
[output]
gauges = ["upper"]
)");
  const std::string folder = scratch.path("run").string();
  const std::string command = "run " + file + " -f --progress none -o '" + folder + "'";
  const Outcome outcome = ranks == 1 ? call(command) : call_ranks(ranks, command);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(energy_fault(folder + "/history.csv"), "");
  double furthest = 0;
  for (const double motion : history_column(folder + "/history.csv", "upper max displacement x [m]"))
    furthest = std::max(furthest, std::abs(motion));
  return furthest;
}

TEST(Block, StandsOnAnEdgeRightAboveThatOfTheBlockBelow) {
  const Scratch scratch;
  constexpr double kStands = 0.5e-3;  // m; without a force at the edge it turns by a tenth of its width
  const double aligned = motion_of_overhanging_block(scratch, "0 mm", 1);
  EXPECT_LT(aligned, kStands);
  EXPECT_EQ(motion_of_overhanging_block(scratch, "0 mm", 2), aligned);
  EXPECT_LT(motion_of_overhanging_block(scratch, "2 mm", 1), kStands);
  EXPECT_LT(motion_of_overhanging_block(scratch, "-2 mm", 1), kStands);
}

TEST(Block, ThatCanBreakStandsThereToo) {
  const Scratch scratch;
  constexpr double kStands = 1e-3;  // m; joints make it softer
  const double aligned = motion_of_overhanging_block(scratch, "0 mm", 1, Joints::breakable);
  EXPECT_LT(aligned, kStands);
  EXPECT_EQ(motion_of_overhanging_block(scratch, "0 mm", 2, Joints::breakable), aligned);
  EXPECT_LT(motion_of_overhanging_block(scratch, "2 mm", 1, Joints::breakable), kStands);
}

}  // namespace
}  // namespace breccia::test::block_test
