#include <gtest/gtest.h>
#include <string>

#include "mpi/same_bits.hpp"

namespace breccia::freed_faces_test {
namespace {

/// Boxes that break fly apart, so that elements once joined come to be in pieces far from each other.
const std::string kApart = R"([mesh.raster]
cells = 1
cell_size = "10 mm"
boxes = 2
gap = "0.1 mm"
[[material]]
group = "raster"
young = "100 MPa"
poisson = 0
density = 1000
[[joint]]
group = "raster"
penalty_factor = 10
tensile_strength = "30 kPa"
energy_mode_1 = "1 J/m2"
[[contact]]
between = ["*", "*"]
penalty = "100 MPa"
[[initial_velocity]]
group = "raster"
random = ["5 m/s", "30 m/s"]
seed = 18
strain_rate = [1000, 1000, 1000]
[[stage]]
end = "4 ms"
[domains]
margin = 0.1
)";

TEST(Ranks, KeepFacesFreeWhenWhatWasBehindThemIsFarAway) {
  const test::Scratch scratch;
  test::SameBits boxes(scratch.write("case.toml", kApart));
  EXPECT_GT(boxes.alone().at("fragments"), 20);
  for (const int ranks : {2, 3}) boxes.on(ranks);
}

/// Halves of a body that part along a slit: what made the sides of the slit such is on another rank soon.
const std::string kParted = R"([mesh.raster]
cells = [6, 2, 2]
cell_size = "10 mm"
slit = { lower = ["30 mm", 0, 0], upper = ["30 mm", "20 mm", "20 mm"] }
[joints]
broken = ["raster.slit"]
[[material]]
group = "raster"
young = "100 MPa"
poisson = 0.2
density = 1000
joints = "unbreakable"
[[joint]]
group = "raster"
penalty_factor = 10
[[contact]]
between = ["*", "*"]
penalty = "1 GPa"
[[initial_velocity]]
group = "raster"
strain_rate = [400, 0, 0]
[[stage]]
end = "12 ms"
[domains]
margin = 0.1
)";

TEST(Ranks, KnowTheSidesOfASlitWhenTheyAreFarApart) {
  const test::Scratch scratch;
  test::SameBits halves(scratch.write("case.toml", kParted));
  halves.on(2);
}

/// A body at rest, alone on its rank, from which another one is drawn away and then pushed into it.
const std::string kStruck = R"([mesh]
file = ")" BRECCIA_MESHES R"(/contact_pair/geometry.msh"
[[material]]
group = "left"
young = "26.6 GPa"
poisson = 0.205
density = 2340
joints = "none"
[[material]]
group = "right"
young = "26.6 GPa"
poisson = 0.205
density = 2340
joints = "none"
[[contact]]
between = ["left", "right"]
penalty = "90 MPa"
[[stage]]
end = "1.5 ms"
[[stage.constraint]]
group = "right"
displacement = { x = { table = [[0, 0], ["0.5 ms", "0.5 mm"], ["1.5 ms", "-0.5 mm"]] }, y = 0, z = 0 }
)";

TEST(Ranks, FeelWhatMovesOnAnotherRankOnly) {
  const test::Scratch scratch;
  test::SameBits pair(scratch.write("case.toml", kStruck));
  EXPECT_GT(pair.alone().at("energy").at("kinetic"), 0);
  pair.on(2);
}

/// Contacts that have ended are remembered by the same rule whatever the buffer of the search.
TEST(Ranks, RememberEndedContactsAlikeWithASmallBuffer) {
  const std::string less = "--set detection.buffer=1e-6 --set time.max_steps=3000";
  test::SameBits block("'" BRECCIA_MESHES "/sliding_block/case_smoke.toml' " + less);
  for (const int ranks : {2, 3}) block.on(ranks, less);
}

}  // namespace
}  // namespace breccia::freed_faces_test
