#include "observe/corner_values.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "domains/balance.hpp"
#include "observe/fragment_labels.hpp"
#include "observe/frames.hpp"
#include "physics/cauchy_stress.hpp"
#include "simulation/step.hpp"
#include "unit/observe/two_cubes.hpp"

namespace breccia::corner_values_test {
namespace {

using test::kCubeEdge;

constexpr double kSame = 1e-12;  // of the edge or of the largest stress: round-off of sums in another order
constexpr double kNear = 1e-3;   // of the edge: the corners of a vertex lie closer together, others farther apart

class CornerValues : public testing::Test, protected test::CubesDomain {
 protected:
  [[nodiscard]] Frame picture() const {
    const FrameParts parts{
        .elements = true, .joints = false, .contacts = false, .surface = true, .domain = false, .at_points = true};
    return make_frame(domain, 0, parts, {find_fragments(domain), surface_faces(domain), Balance().weights(domain)});
  }
  /// Every element pulled and sheared differently, by its place.
  void deform() {
    double* x = domain.state.nodes.position.data();
    const LocalMesh& local = model.local;
    for (Index slot = 0; slot < local.num_slots; ++slot) {
      if (local.element_of_slot[static_cast<std::size_t>(slot)] < 0) continue;
      for (int c = 0; c < 4; ++c) {
        const Index node = local.corner_node(slot, c);
        const Vec3 place = load_node(local.reference.data(), node) / kCubeEdge;
        store_node(x, node, kCubeEdge * (place + 1e-4 * Vec3(place[0] * place[0], place[1] * place[2], place[0])));
      }
    }
  }
};

std::size_t count(const Frame& frame) { return frame.elements.id.size(); }

/// The mean stress at a corner by its definition: over all corners at the same place, those alone that `counts` takes.
template <class Counts>
std::array<double, 6> mean_stress(const Frame& frame, std::size_t corner, Counts&& counts) {
  const Frame::Elements& e = frame.elements;
  const Vec3 here(&e.points[3 * corner]);
  std::array<double, 6> mean{};
  double mass = 0;
  for (std::size_t other = 0; other < 4 * count(frame); ++other) {
    if ((Vec3(&e.points[3 * other]) - here).norm() > kNear * kCubeEdge || !counts(other / 4)) continue;
    mass += e.mass[other / 4];
    for (std::size_t k = 0; k < 6; ++k) mean[k] += e.mass[other / 4] * e.stress[6 * (other / 4) + k];
  }
  for (double& value : mean) value /= mass;
  return mean;
}

TEST_F(CornerValues, OfStressAreMeansWeightedByMassOverAllThatMeetsThere) {
  deform();
  const Frame frame = picture();
  const double most = *std::max_element(frame.elements.stress.begin(), frame.elements.stress.end());
  ASSERT_GT(most, 1e4);
  ASSERT_EQ(frame.elements.at_points.stress.size(), 6 * 4 * count(frame));
  for (std::size_t corner = 0; corner < 4 * count(frame); ++corner) {
    const auto expected = mean_stress(frame, corner, [](std::size_t) { return true; });
    for (std::size_t k = 0; k < 6; ++k)
      ASSERT_NEAR(frame.elements.at_points.stress[6 * corner + k], expected[k], kSame * most) << corner << " " << k;
  }
}

TEST_F(CornerValues, OnTheTwoSidesOfABrokenJointAreThoseOfEitherSide) {
  break_joints(domain, faces_of_surface(model, "box.slit"));
  step(domain);
  deform();
  const Frame frame = picture();
  const Frame::Elements& e = frame.elements;
  const auto is_left = [&](std::size_t element) {
    double sum = 0;
    for (std::size_t c = 0; c < 4; ++c) sum += e.points[3 * (4 * element + c)];
    return sum < 4 * kCubeEdge;
  };
  const double most = *std::max_element(e.stress.begin(), e.stress.end());
  int apart = 0;
  for (std::size_t corner = 0; corner < 4 * count(frame); ++corner) {
    const bool left = is_left(corner / 4);
    const auto expected = mean_stress(frame, corner, [&](std::size_t other) { return is_left(other) == left; });
    const auto smeared = mean_stress(frame, corner, [](std::size_t) { return true; });
    for (std::size_t k = 0; k < 6; ++k) ASSERT_NEAR(e.at_points.stress[6 * corner + k], expected[k], kSame * most);
    apart += std::abs(expected[0] - smeared[0]) > 1e3 * kSame * most ? 1 : 0;
  }
  EXPECT_GT(apart, 0);
}

TEST_F(CornerValues, OfMotionAreThoseOfTheElementsOwnNodes) {
  deform();
  const Frame frame = picture();
  const Frame::AtPoints& at_points = frame.elements.at_points;
  ASSERT_EQ(at_points.velocity.size(), 3 * 4 * count(frame));
  for (std::size_t element = 0; element < count(frame); ++element) {
    Vec3 mean = Vec3::Zero();
    for (std::size_t c = 0; c < 4; ++c) mean += 0.25 * Vec3(&at_points.displacement[3 * (4 * element + c)]);
    EXPECT_LT((mean - Vec3(&frame.elements.displacement[3 * element])).norm(), kSame * kCubeEdge);
  }
}

TEST_F(CornerValues, OfAStressFollowFromThatStress) {
  deform();
  const Frame::AtPoints values = corner_values(domain);
  for (std::size_t corner = 0; corner < values.von_mises.size(); ++corner) {
    const double* t = &values.stress[6 * corner];
    const Mat3 stress{{t[0], t[3], t[5]}, {t[3], t[1], t[4]}, {t[5], t[4], t[2]}};
    EXPECT_EQ(values.von_mises[corner], von_mises(stress));
    EXPECT_EQ(Vec3(&values.principal[3 * corner]), principal_stresses(stress));
  }
}

TEST_F(CornerValues, OfTheSurfaceAreThoseOfItsElements) {
  deform();
  const Frame frame = picture();
  const Frame::Elements &all = frame.elements, &skin = frame.surface.cells;
  ASSERT_EQ(skin.at_points.von_mises.size(), 3 * frame.surface.face.size());
  for (std::size_t point = 0; point < 3 * frame.surface.face.size(); ++point) {
    const auto e =
        static_cast<std::size_t>(std::find(all.id.begin(), all.id.end(), skin.id[point / 3]) - all.id.begin());
    bool found = false;
    for (std::size_t c = 4 * e; c < 4 * e + 4; ++c)
      found = found || (Vec3(&all.points[3 * c]) == Vec3(&skin.points[3 * point]) &&
                        all.at_points.von_mises[c] == skin.at_points.von_mises[point]);
    EXPECT_TRUE(found) << point;
  }
}

TEST_F(CornerValues, AreMadeWhereTheyAreAskedForAlone) {
  const FrameParts parts{.elements = true, .joints = false, .contacts = false, .surface = true, .domain = false};
  const Frame frame =
      make_frame(domain, 0, parts, {find_fragments(domain), surface_faces(domain), Balance().weights(domain)});
  EXPECT_TRUE(frame.elements.at_points.displacement.empty());
  EXPECT_TRUE(frame.surface.cells.at_points.displacement.empty());
}

}  // namespace
}  // namespace breccia::corner_values_test
