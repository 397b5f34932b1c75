#include "model/torn_faces.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "mesh/raster.hpp"

namespace breccia::torn_faces_test {
namespace {

int number_of(const std::vector<std::uint8_t>& faces) {
  int number = 0;
  for (const std::uint8_t bits : faces) number += std::popcount(bits);
  return number;
}

TEST(TornFaces, AreBothSidesOfASlit) {
  Mesh mesh = make_raster({.cells = {2, 1, 1}}).mesh;
  Topology topology = build_topology(mesh);
  EXPECT_EQ(number_of(torn_faces(mesh, topology)), 0) << "a whole block";
  int cut = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    for (std::size_t f = 0; f < 4; ++f) {
      double across = 0;
      for (const int corner : kFaceCorners[f])
        across +=
            std::abs(mesh.nodes[static_cast<std::size_t>(mesh.elements[e][static_cast<std::size_t>(corner)])][0] - 1);
      if (across > 1e-9 || topology.links[e][f].free()) continue;
      topology.links[e][f] = FaceLink{};
      ++cut;
    }
  }
  ASSERT_EQ(cut, 8);
  const std::vector<std::uint8_t> torn = torn_faces(mesh, topology);
  EXPECT_EQ(number_of(torn), cut);
  for (std::size_t e = 0; e < torn.size(); ++e) {
    for (std::size_t f = 0; f < 4; ++f) {
      if ((torn[e] >> f & 1) != 0) {
        EXPECT_TRUE(topology.links[e][f].free()) << e;
      }
    }
  }
}

TEST(TornFaces, AreNotThoseOfBodiesThatLieAgainstEachOther) {
  const Mesh mesh = make_raster({.boxes = {2, 1, 1}}).mesh;
  EXPECT_EQ(mesh.num_bodies, 2);
  EXPECT_EQ(number_of(torn_faces(mesh, build_topology(mesh))), 0);
}

}  // namespace
}  // namespace breccia::torn_faces_test
