#include "mesh/closed_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <utility>

namespace breccia::closed_surface_test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

constexpr double kSharp = 40 * std::numbers::pi / 180;

/// Adds a box of 12 triangles that face outwards, or inwards.
void add_box(SurfaceTriangles& to, const Vec3& lower, const Vec3& upper, bool inwards = false) {
  constexpr std::array<std::array<Index, 4>, 6> kFaces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  const auto first = static_cast<Index>(to.points.size());
  for (int i = 0; i < 8; ++i)
    to.points.emplace_back((i & 1) != 0 ? upper.x() : lower.x(), (i & 2) != 0 ? upper.y() : lower.y(),
                           (i & 4) != 0 ? upper.z() : lower.z());
  for (const auto& [a, b, c, d] : kFaces)
    for (std::array<Index, 3> t : {std::array{a, b, c}, std::array{a, c, d}}) {
      if (inwards) std::swap(t[1], t[2]);
      to.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
}

SurfaceTriangles box() {
  SurfaceTriangles made;
  add_box(made, Vec3(0, 0, 0), Vec3(3, 1, 1));
  return made;
}

TEST(ClosedSurface, ABoxIsOneSolidWithSixPatches) {
  const ClosedSurfaces parts = take_apart(box(), kSharp);
  EXPECT_EQ(parts.fault, "");
  EXPECT_EQ(parts.num_shells, 1);
  EXPECT_EQ(parts.num_patches, 6);
  EXPECT_EQ(parts.solids, (std::vector<std::vector<Index>>{{0}}));
}

TEST(ClosedSurface, AShellInAnotherIsItsHoleAndOneInTheHoleASolidAgain) {
  SurfaceTriangles nested;
  add_box(nested, Vec3(1.5, 1.5, 1.5), Vec3(2.5, 2.5, 2.5));
  add_box(nested, Vec3(0, 0, 0), Vec3(4, 4, 4));
  add_box(nested, Vec3(1, 1, 1), Vec3(3, 3, 3), true);
  add_box(nested, Vec3(9, 0, 0), Vec3(10, 1, 1));
  const ClosedSurfaces parts = take_apart(nested, kSharp);
  EXPECT_EQ(parts.fault, "");
  EXPECT_EQ(parts.solids, (std::vector<std::vector<Index>>{{0}, {1, 2}, {3}}));
}

TEST(ClosedSurface, AShellThatFacesTheWayOfTheOneAroundItIsASolidThatIsCutOut) {
  SurfaceTriangles nested;
  add_box(nested, Vec3(0, 0, 0), Vec3(4, 4, 4));
  add_box(nested, Vec3(1, 1, 1), Vec3(3, 3, 3));
  const ClosedSurfaces parts = take_apart(nested, kSharp);
  EXPECT_EQ(parts.fault, "");
  EXPECT_EQ(parts.solids, (std::vector<std::vector<Index>>{{0, 1}, {1}}));
  ASSERT_THAT(parts.inclusions, SizeIs(1));
  EXPECT_EQ(parts.inclusions[0].inner, 1);
  EXPECT_EQ(parts.num_holes, 0);
}

TEST(ClosedSurface, AnOpenSurfaceIsRefusedWithAPlace) {
  SurfaceTriangles open = box();
  open.triangles.pop_back();
  EXPECT_THAT(take_apart(open, kSharp).fault, HasSubstr("open: 3 edges belong to one triangle only, the first near ("));
}

TEST(ClosedSurface, ThreeSheetsAtAnEdgeAreRefused) {
  SurfaceTriangles fin = box();
  fin.triangles.push_back({0, 1, 7});
  EXPECT_THAT(take_apart(fin, kSharp).fault, HasSubstr("open"));
  fin.triangles.pop_back();
  fin.triangles.push_back(fin.triangles.front());
  EXPECT_THAT(take_apart(fin, kSharp).fault, HasSubstr("3 edges belong to more than two triangles"));
}

TEST(ClosedSurface, ATriangleThatFacesInwardsIsRefused) {
  SurfaceTriangles turned = box();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_THAT(take_apart(turned, kSharp).fault, HasSubstr("at 3 edges face different ways"));
}

TEST(ClosedSurface, ShellsThatCrossAreRefusedAndThoseThatTouchAreNot) {
  SurfaceTriangles crossing = box();
  add_box(crossing, Vec3(1, 0.5, 0.5), Vec3(2, 2, 0.8));
  EXPECT_THAT(take_apart(crossing, kSharp).fault, HasSubstr("goes through itself, the first near ("));
  SurfaceTriangles touching = box();
  add_box(touching, Vec3(3, 0, 0), Vec3(4, 1, 1));
  EXPECT_EQ(take_apart(touching, kSharp).fault, "");
  EXPECT_THAT(take_apart(touching, kSharp).solids, SizeIs(2));
}

TEST(ClosedSurface, NoTrianglesAndTrianglesWithoutAreaAreRefused) {
  EXPECT_THAT(take_apart({}, kSharp).fault, HasSubstr("no triangle"));
  SurfaceTriangles flat = box();
  flat.triangles.push_back({0, 1, 1});
  EXPECT_THAT(take_apart(flat, kSharp).fault, HasSubstr("1 triangles without area"));
}

}  // namespace
}  // namespace breccia::closed_surface_test
