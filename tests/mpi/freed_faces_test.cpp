#include <gtest/gtest.h>
#include <string>

#include "mpi/same_bits.hpp"
#include "support/raster_case.hpp"

namespace breccia::freed_faces_test {
namespace {

/// Boxes that break fly apart, so that elements once joined come to be in pieces far from each other.
const std::string kApart = test::raster_case({.boxes = {2, 2, 2},
                                              .gap = 0.1e-3,
                                              .young = 100e6,
                                              .poisson = 0,
                                              .penalty_factor = 10,
                                              .tensile_strength = 30e3,
                                              .energy_mode_1 = 1,
                                              .contact_penalty = 100e6,
                                              .end = 4e-3}) +
                           R"([[initial_velocity]]
group = "raster"
random = ["5 m/s", "30 m/s"]
seed = 18
strain_rate = [1000, 1000, 1000]
[domains]
margin = 0.1
)";

TEST(Ranks, KeepFacesFreeWhenWhatWasBehindThemIsFarAway) {
  const test::Scratch scratch;
  test::SameBits boxes(scratch.write("case.toml", kApart));
  EXPECT_GT(boxes.alone().at("fragments"), 20);
  for (const int ranks : {2, 3}) boxes.on(ranks);
}

/// Halves of a body that part along a slit: what made the sides of the slit such is on another rank soon. Three points
/// a face: in contacts of four steps, as under ten times Young's modulus, four gain up to 1 % for a while.
const std::string kParted = test::raster_case({.cells = {6, 2, 2},
                                               .mesh = "slit = { lower = [0.03, 0, 0], upper = [0.03, 0.02, 0.02] }\n",
                                               .young = 100e6,
                                               .penalty_factor = 10,
                                               .contact_penalty = 1e9,
                                               .end = 12e-3}) +
                            R"([joints]
broken = ["raster.slit"]
[[initial_velocity]]
group = "raster"
strain_rate = [400, 0, 0]
[contact_points]
per_face = 3
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
