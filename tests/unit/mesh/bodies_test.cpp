#include "mesh/bodies.hpp"
#include "base/index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "mesh/finish.hpp"
#include "mesh/geometry.hpp"
#include "sample_meshes.hpp"

namespace breccia::bodies_test {
namespace {

/// A bar of cubes along x whose elements belong to a volume each `cubes` long, read but not finished.
Mesh bar_of_volumes(int cubes, int volumes) {
  Mesh mesh = make_raster({.cells = {cubes * volumes, 1, 1}}).mesh;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    double x = 0;
    for (const Vec3& corner : geometry::corners_of(mesh, e)) x += 0.25 * corner.x();
    mesh.element_body[at(e)] = static_cast<Index>(x / cubes);
  }
  mesh.num_bodies = volumes;
  return mesh;
}

/// Marks the faces whose corners fulfil a condition as those of a surface "cut".
template <class On>
void mark_cut(Mesh& mesh, On&& on) {
  const auto group = static_cast<Index>(mesh.surface_groups.size());
  mesh.surface_groups.push_back("cut");
  for (const auto& corners : mesh.elements) {
    for (const auto& face : kFaceCorners) {
      const std::array<Index, 3> nodes{corners[at(face[0])], corners[at(face[1])], corners[at(face[2])]};
      if (std::all_of(nodes.begin(), nodes.end(), [&](Index n) { return on(mesh.nodes[at(n)]); }))
        mesh.surface_faces.push_back({nodes, group});
    }
  }
}

Bodies bodies_cut(const Mesh& mesh, const std::string& surface) {
  const Topology topology = build_topology(mesh);
  const std::array names{surface};
  return find_bodies(mesh, topology, faces_of_surfaces(mesh, topology, names));
}

TEST(Bodies, VolumesThatAreGluedAreOneAndOthersAreTheirOwn) {
  const Mesh glued = finish_mesh(bar_of_volumes(1, 3), {.glue = true}).mesh;
  EXPECT_EQ(glued.num_bodies, 1);
  EXPECT_EQ(std::set<Index>(glued.element_body.begin(), glued.element_body.end()), std::set<Index>{0});
  EXPECT_EQ(std::set<Index>(glued.element_volume.begin(), glued.element_volume.end()), (std::set<Index>{0, 1, 2}));
  const Mesh apart = finish_mesh(bar_of_volumes(1, 3), {.glue = false}).mesh;
  EXPECT_EQ(apart.num_bodies, 3);
  EXPECT_EQ(apart.element_body, apart.element_volume) << "numbers are those of the volumes";
}

TEST(Bodies, CountOnesThatAreGluedByTheirLowestVolume) {
  Mesh mesh = bar_of_volumes(1, 4);
  for (Index& volume : mesh.element_body) volume = std::array<Index, 4>{3, 1, 0, 2}[at(volume)];
  mark_cut(mesh, [](const Vec3& x) { return x.x() == 1 || x.x() == 3; });
  const Mesh finished = finish_mesh(std::move(mesh), {.glue = true}).mesh;
  const Bodies bodies = bodies_cut(finished, "cut");
  ASSERT_EQ(bodies.count, 3);
  for (Index e = 0; e < finished.num_elements(); ++e)  // volume 3 | volumes 1 and 0 | volume 2
    EXPECT_EQ(bodies.of_element[at(e)], (std::array<Index, 4>{0, 0, 1, 2}[at(finished.element_volume[at(e)])]));
}

TEST(Bodies, AVolumeThatIsCutThroughIsTwoAndOneThatIsPartlyCutIsOne) {
  Mesh mesh = bar_of_volumes(2, 1);
  mark_cut(mesh, [](const Vec3& x) { return x.x() == 1; });
  const Mesh through = finish_mesh(std::move(mesh), {}).mesh;
  EXPECT_EQ(through.num_bodies, 1) << "nothing is cut yet";
  EXPECT_EQ(bodies_cut(through, "cut").count, 2);
  EXPECT_EQ(bodies_cut(through, "another").count, 1);
  Mesh notched = bar_of_volumes(2, 1);
  mark_cut(notched, [](const Vec3& x) { return x.x() == 1 && x.y() <= 0.5; });
  EXPECT_EQ(bodies_cut(finish_mesh(std::move(notched), {}).mesh, "cut").count, 1);
}

TEST(Bodies, ThatMeetInAnEdgeOrAPointAreTwo) {
  Mesh mesh;
  mesh.source = "by_hand.msh";
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}};
  mesh.elements = {{0, 1, 2, 3}, {0, 4, 5, 3}};  // the edge 0-3
  mesh.element_group = mesh.element_body = {0, 0};
  mesh.element_source_id = {1, 2};
  mesh.volume_groups = {"all"};
  mesh.num_bodies = 1;
  EXPECT_EQ(finish_mesh(mesh, {.glue = true}).mesh.num_bodies, 2);
}

}  // namespace
}  // namespace breccia::bodies_test
