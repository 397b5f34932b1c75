#include "observe/frames.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <set>

#include "domains/balance.hpp"
#include "observe/fragment_labels.hpp"
#include "simulation/step.hpp"
#include "unit/observe/two_cubes.hpp"

namespace breccia::frames_test {
namespace {

using test::kCubeEdge;

class TwoCubes : public testing::Test, protected test::CubesDomain {
 protected:
  [[nodiscard]] Frame picture() const {
    const FrameParts parts{.elements = true, .joints = true, .contacts = true, .surface = true, .domain = true};
    return make_frame(domain, 0, parts, {find_fragments(domain), surface_faces(domain), Balance().weights(domain)});
  }
};

double area(const Frame::Surface& surface) {
  double sum = 0;
  for (std::size_t f = 0; f < surface.face.size(); ++f) {
    const auto corner = [&](std::size_t c) { return Vec3(surface.cells.points.data() + 9 * f + 3 * c); };
    sum += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  return sum;
}

std::ptrdiff_t cracks(const Frame::Surface& surface) {
  return std::count(surface.crack.begin(), surface.crack.end(), 1);
}

TEST_F(TwoCubes, HaveTheSurfaceOfTheirBox) {
  const Frame frame = picture();
  EXPECT_EQ(frame.surface.face.size(), 10u * 4);
  EXPECT_EQ(cracks(frame.surface), 0);
  constexpr double kRounding = 1e-15;  // m2
  EXPECT_NEAR(area(frame.surface), 10 * kCubeEdge * kCubeEdge, kRounding);
}

TEST_F(TwoCubes, ShowBothSidesOfAJointThatFails) {
  break_joints(domain, faces_of_surface(model, "box.slit"));
  EXPECT_EQ(cracks(picture().surface), 0);  // they fail when they are evaluated next
  step(domain);
  const Frame frame = picture();
  EXPECT_EQ(cracks(frame.surface), 2 * 4);
  EXPECT_EQ(frame.surface.face.size(), 10u * 4 + 2 * 4);
  EXPECT_EQ(frame.joints.id.size(), 4u);
}

TEST_F(TwoCubes, NameTheElementsAcrossTheirFacesAlikeFromBothSides) {
  const Frame frame = picture();
  const Frame::Elements& all = frame.elements;
  std::ptrdiff_t pairs = 0;
  for (std::size_t e = 0; e < all.id.size(); ++e) {
    for (std::size_t face = 0; face < 4; ++face) {
      const std::int64_t other = all.neighbour[4 * e + face];
      if (other < 0) continue;
      ++pairs;
      const auto o = static_cast<std::size_t>(std::find(all.id.begin(), all.id.end(), other) - all.id.begin());
      ASSERT_LT(o, all.id.size());
      const auto back = all.neighbour.begin() + static_cast<std::ptrdiff_t>(4 * o);
      EXPECT_EQ(std::count(back, back + 4, all.id[e]), 1);
    }
  }
  EXPECT_EQ(pairs, 48 * 4 - 10 * 4);
}

TEST_F(TwoCubes, HaveTheMassOfTheirVolume) {
  const Frame frame = picture();
  constexpr double kMass = test::kCubeDensity * 2 * kCubeEdge * kCubeEdge * kCubeEdge, kRounding = 1e-15;
  EXPECT_NEAR(std::accumulate(frame.elements.mass.begin(), frame.elements.mass.end(), 0.0), kMass, kRounding);
}

TEST_F(TwoCubes, ShowTheEnergyOfTheirJoints) {
  break_joints(domain, faces_of_surface(model, "box.slit"));
  for (int i = 0; i < 4; ++i) step(domain);
  const Frame frame = picture();
  const double shown = std::accumulate(frame.joints.energy.begin(), frame.joints.energy.end(), 0.0);
  const JointEnergy energy = joint_energy(domain.model.local, domain.state.joints.active, domain.state.work.joints);
  EXPECT_DOUBLE_EQ(shown, energy.mode_1.value() + energy.mode_2.value());
}

TEST_F(TwoCubes, HaveTheFieldsOfTheElementsOnTheirSurface) {
  step(domain);
  const Frame frame = picture();
  const Frame::Elements &all = frame.elements, &skin = frame.surface.cells;
  ASSERT_EQ(all.id.size(), 48u);
  EXPECT_EQ(std::set<std::int64_t>(all.id.begin(), all.id.end()).size(), 48u);
  ASSERT_EQ(skin.id.size(), frame.surface.face.size());
  for (std::size_t f = 0; f < skin.id.size(); ++f) {
    const auto e = static_cast<std::size_t>(std::find(all.id.begin(), all.id.end(), skin.id[f]) - all.id.begin());
    ASSERT_LT(e, all.id.size());
    EXPECT_EQ(skin.cost[f], all.cost[e]);
    EXPECT_EQ(skin.fragment[f], all.fragment[e]);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(skin.stress[6 * f + k], all.stress[6 * e + k]);
  }
}

TEST_F(TwoCubes, AreADomainWithABoxAroundIt) {
  const Frame::Domain box = picture().domain;
  ASSERT_EQ(box.rank.size(), 1u);
  EXPECT_EQ(box.elements[0], 48);
  const Vec3 lowest(box.points.data()), opposite(box.points.data() + 3 * 6);
  EXPECT_EQ(lowest, Vec3(0, 0, 0));
  EXPECT_EQ(opposite, Vec3(2 * kCubeEdge, kCubeEdge, kCubeEdge));
}

class TouchingCubes : public testing::Test, protected test::CubesDomain {
 protected:
  TouchingCubes() : CubesDomain("[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"10 GPa\"\n") {}
};

TEST_F(TouchingCubes, ShowAContactForEachElementThatAPointTouchesWithAnIdOfItsOwn) {
  ContactState& contact = domain.state.contact;
  ASSERT_GE(contact.points.size(), 1U);
  ASSERT_GE(contact.contactors.size(), 2U);
  for (const Index contactor : {0, 1}) {
    TouchingCouple couple{};
    couple.point = 0;
    couple.contactor = contactor;
    couple.history.force = Vec3(1, 0.5, 0);
    couple.history.friction = Vec3(0, 0.5, 0);
    contact.touching.push_back(couple);
  }
  const FrameParts parts{.elements = false, .joints = false, .contacts = true, .surface = false, .domain = false};
  const Frame frame = make_frame(domain, 0, parts, {find_fragments(domain), {}, {}});
  const Frame::Contacts& shown = frame.contacts;
  ASSERT_EQ(shown.id.size(), 2U);
  EXPECT_EQ(shown.point[0], shown.point[1]);
  EXPECT_NE(shown.id[0], shown.id[1]);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(shown.id[i], 48 * shown.point[i] + shown.other_element[i]);
  EXPECT_EQ(shown.normal_force, std::vector<double>({1, 0, 0, 1, 0, 0}));
  EXPECT_EQ(shown.tangential_force, std::vector<double>({0, 0.5, 0, 0, 0.5, 0}));
}

}  // namespace
}  // namespace breccia::frames_test
