#include <gtest/gtest.h>
#include <string>

#include "mpi/same_bits.hpp"

namespace breccia::bond_test {
namespace {

/// Two bars of ordinary finite elements, bonded face to face but for a notch, are peeled off each other.
const std::string kPeel = R"([mesh]
file = "bars.geo"
glue = true
[[material]]
group = "lower"
young = "10 GPa"
poisson = 0.2
density = 1200
joints = "none"
[[material]]
group = "upper"
young = "10 GPa"
poisson = 0.2
density = 1200
joints = "none"
[[joint]]
between = ["lower", "upper"]
penalty_factor = 20
tensile_strength = "5 MPa"
energy_mode_1 = "10 J/m2"
[[contact]]
between = ["*", "*"]
penalty = "10 GPa"
[joints]
broken = ["notch"]
[[stage]]
end = "0.6 ms"
[[stage.constraint]]
group = "end_upper"
velocity = { y = { ramp = { to = "1 m/s", end = "0.2 ms" } } }
[[stage.constraint]]
group = "end_lower"
velocity = { y = { ramp = { to = "-1 m/s", end = "0.2 ms" } } }
[output]
history_interval = "20 us"
)";

const std::string kBars = R"(SetFactory("OpenCASCADE");
Box(1) = {0, -0.003, 0, 0.006, 0.003, 0.003};
Box(2) = {0.006, -0.003, 0, 0.018, 0.003, 0.003};
Box(3) = {0, 0, 0, 0.006, 0.003, 0.003};
Box(4) = {0.006, 0, 0, 0.018, 0.003, 0.003};
BooleanFragments{ Volume{1:4}; Delete; }{}
MeshSize{:} = 0.0015;
Physical Volume("lower") = {1, 2};
Physical Volume("upper") = {3, 4};
e = 1e-5;
Physical Surface("notch") = Surface In BoundingBox {-e, -e, -e, 0.006 + e, e, 0.003 + e};
Physical Surface("end_lower") = Surface In BoundingBox {-e, -0.003 - e, -e, e, e, 0.003 + e};
Physical Surface("end_upper") = Surface In BoundingBox {-e, -e, -e, e, 0.003 + e, 0.003 + e};
)";

TEST(Ranks, GiveTheSameBitsWhileABondOfBodiesWithoutJointsIsPeeled) {
  const test::Scratch scratch;
  scratch.write("bars.geo", kBars);
  test::SameBits bars(scratch.write("case.toml", kPeel));
  EXPECT_EQ(bars.alone().at("broken_joints"), bars.alone().at("joints"));
  EXPECT_EQ(bars.alone().at("fragments"), 2);
  const nlohmann::json& energy = bars.alone().at("energy");
  const double needed = 0.018 * 0.003 * 10;  // J: bonded area times fracture energy, in any mix of modes
  constexpr double kSteps = 1e-4;            // the law is exact, but for steps of finite length: 5e-6 was found
  EXPECT_NEAR(energy.at("joint_mode_1").get<double>() + energy.at("joint_mode_2").get<double>(), needed,
              kSteps * needed);
  for (const int ranks : {2, 3}) bars.on(ranks);
  bars.on(4, "--set domains.kind=grid --set domains.n=[2,2,1] --set domains.margin=0.2");
}

}  // namespace
}  // namespace breccia::bond_test
