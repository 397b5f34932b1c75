#include "physics/contact/geometry/outward.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene.hpp"

/// What a contact point knows of the surface around it: its directions, and how sharp it is.
namespace breccia::surface_point_test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr ContactLaw kLaw{1e6, kInfinite, 1, 0, 1};

TEST(SurfacePoint, OfASharpBodyOnAFlatOneHasNearlyTheWholeWeightOfBoth) {
  // A cube on its corner, just in the middle of a large wall, off its nodes.
  const Vec3 down(1, 1, 1);
  const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(down, -Vec3::UnitZ()).toRotationMatrix();
  const Mesh cube = test::moved(test::box({1, 1, 1}, 0.5), [&](const Vec3& x) -> Vec3 {
    return Vec3(2.4, 2.3, 0.98) + turn * (x - Vec3::Constant(0.5));
  });
  test::Scene scene(test::joined(test::wall(5, 1.0), cube), kLaw, 4);
  scene.params.points_everywhere = true;
  scene.contact.touching.clear();
  scene.evaluate(1e-3);
  int of_cube = 0;
  for (const TouchingCouple& couple : scene.contact.touching) {
    const bool is_cube = scene.body(scene.contact.points[at(couple.point)].slot) == 1;
    if (is_cube) EXPECT_NEAR(couple.history.share, 2, 0.01);
    of_cube += is_cube ? 1 : 0;
  }
  EXPECT_GT(of_cube, 0);
}

TEST(SurfacePoint, SharesOfBothAddUpToTwoAndAreOneEachWhereBothAreAlike) {
  EXPECT_EQ(share_of_weight(0.3, 0.3), 1);
  EXPECT_EQ(share_of_weight(1, 0), 2);
  EXPECT_EQ(share_of_weight(0.25, 0.75) + share_of_weight(0.75, 0.25), 2);
}

TEST(SurfacePoint, IsSharpAtEdgesAndCornersAndFlatInTheMiddleOfAFace) {
  const test::Scene scene(test::box({1, 1, 1}, 1.0), kLaw, 4);
  const FaceRule& rule = face_rule(4);
  int flat = 0, sharp = 0;
  for (const ContactPoint& point : scene.contact.points) {
    if (corner_of(rule, point) < 0) continue;
    const Vec3 x = at_point(rule, point, scene.local.reference.data());
    const bool in_the_middle = ((x - Vec3::Constant(0.5)).cwiseAbs().array() < 1e-9).count() == 2;
    const FieldValues& values = scene.contact.field[at(scene.contact.contactor_of_slot[at(point.slot)])];
    if (in_the_middle)
      EXPECT_NEAR(sharpness(rule, point, values), 0, 1e-9);
    else
      EXPECT_GT(sharpness(rule, point, values), 0.99);
    ++(in_the_middle ? flat : sharp);
  }
  EXPECT_EQ(flat, 6 * 4);
  EXPECT_EQ(sharp, 6 * 4 * 2);
}

TEST(SurfacePoint, AtTheEdgeOfABlockFacesWhatAnyOfItsFacesThereFaces) {
  const test::Scene scene(test::box({1, 1, 1}, 1.0), kLaw, 4);
  const FaceRule& rule = face_rule(4);
  const Vec3 floor = -Vec3::UnitZ();  // inwards
  const auto place = [&](Index node) { return load_node(scene.state.position.data(), node); };
  int beside = 0;
  for (const ContactPoint& point : scene.contact.points) {
    const Vec3 x = at_point(rule, point, scene.local.reference.data());
    const Outward outward = outward_at(rule, scene.local, scene.contact, point, place);
    const Vec3 normal = outward.face.normalized();
    const bool is_low = x[2] < 1e-9, is_corner = corner_of(rule, point) >= 0;
    const bool is_side = std::abs(normal[2]) < 1e-9, is_base = normal[2] < -0.9;
    if (is_side && is_low && is_corner) {
      EXPECT_EQ(facing(outward.face, floor), Facing::away);
      EXPECT_EQ(facing(outward, floor), Facing::well);
      ++beside;
    } else if (is_base) {
      EXPECT_EQ(facing(outward, floor), Facing::well);
    } else if (!is_low || !is_corner) {
      EXPECT_EQ(facing(outward, floor), Facing::away);
    }
  }
  EXPECT_EQ(beside, 4 * 4);
}

TEST(SurfacePoint, TurnsWithItsBody) {
  test::Scene scene(test::box({1, 1, 1}, 1.0), kLaw, 4);
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const FaceRule& rule = face_rule(4);
  const auto at_rest = [&](Index node) { return load_node(scene.local.reference.data(), node); };
  const auto turned = [&](Index node) -> Vec3 { return turn * at_rest(node); };
  for (const ContactPoint& point : scene.contact.points) {
    if (corner_of(rule, point) < 0) continue;
    const Outward before = outward_at(rule, scene.local, scene.contact, point, at_rest);
    const Outward after = outward_at(rule, scene.local, scene.contact, point, turned);
    EXPECT_NEAR((after.corner - turn * before.corner).norm(), 0, 1e-12);
  }
}

}  // namespace
}  // namespace breccia::surface_point_test
