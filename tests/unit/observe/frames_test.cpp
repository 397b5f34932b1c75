#include "observe/frames.hpp"
#include "contact/search_params.hpp"
#include "simulation/step.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <set>

#include "domains/balance.hpp"
#include "model/model.hpp"
#include "model/parameters.hpp"
#include "observe/fragment_labels.hpp"
#include "unit/case/case_files.hpp"

namespace breccia {
namespace {

constexpr double kEdge = 0.01;  // m, of a cube
constexpr double kStep = 1e-8;  // s

/// A box of two cubes, each of 24 elements, with a slit of four faces between them that holds until somebody breaks it.
case_::Case two_cubes() {
  return case_::read_text(R"([mesh.raster]
cells = [2, 1, 1]
cell_size = "10 mm"
group = "box"
slit = { lower = ["10 mm", 0, 0], upper = ["10 mm", "10 mm", "10 mm"] }
[[material]]
group = "box"
young = "1 GPa"
poisson = 0.2
density = 2000
joints = "breakable"
[[joint]]
group = "box"
penalty_factor = 10
tensile_strength = "1 MPa"
energy_mode_1 = "10 J/m2"
[[stage]]
name = "rest"
end = "1 ms"
)");
}

class TwoCubes : public testing::Test {
 protected:
  TwoCubes() { begin_stage(domain_, stage_loads(input_.stages[0], model_), kStep); }
  [[nodiscard]] Frame picture() const {
    const FrameParts parts{.elements = true, .joints = true, .contacts = true, .surface = true, .domain = true};
    return make_frame(domain_, 0, parts, {find_fragments(domain_), Balance().weights(domain_)});
  }
  const case_::Case input_ = two_cubes();
  const Model model_ = build_model(input_);
  Domain domain_{model_, search_params(input_, model_)};
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

TEST_F(TwoCubes, have_the_surface_of_their_box) {
  const Frame frame = picture();
  EXPECT_EQ(frame.surface.face.size(), 10u * 4);
  EXPECT_EQ(cracks(frame.surface), 0);
  constexpr double kRounding = 1e-15;  // m2
  EXPECT_NEAR(area(frame.surface), 10 * kEdge * kEdge, kRounding);
}

TEST_F(TwoCubes, show_both_sides_of_a_joint_that_fails) {
  break_joints(domain_, faces_of_surface(model_, "box.slit"));
  EXPECT_EQ(cracks(picture().surface), 0);  // they fail when they are evaluated next
  step(domain_);
  const Frame frame = picture();
  EXPECT_EQ(cracks(frame.surface), 2 * 4);
  EXPECT_EQ(frame.surface.face.size(), 10u * 4 + 2 * 4);
  EXPECT_EQ(frame.joints.id.size(), 4u);
}

TEST_F(TwoCubes, are_two_fragments_once_their_joints_have_failed) {
  FragmentWatch watch;
  EXPECT_EQ(watch.look(domain_, 1).count, 1);
  break_joints(domain_, faces_of_surface(model_, "box.slit"));
  EXPECT_EQ(watch.look(domain_, 1).count, 1);
  step(domain_);
  const Fragments& now = watch.look(domain_, 1);
  EXPECT_EQ(now.count, 2);
  EXPECT_EQ(now.of_slot, find_fragments(domain_).of_slot);
}

TEST_F(TwoCubes, have_the_fields_of_the_elements_on_their_surface) {
  step(domain_);
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

TEST_F(TwoCubes, are_a_domain_with_a_box_around_it) {
  const Frame::Domain domain = picture().domain;
  ASSERT_EQ(domain.rank.size(), 1u);
  EXPECT_EQ(domain.elements[0], 48);
  const Vec3 lowest(domain.points.data()), opposite(domain.points.data() + 3 * 6);
  EXPECT_EQ(lowest, Vec3(0, 0, 0));
  EXPECT_EQ(opposite, Vec3(2 * kEdge, kEdge, kEdge));
}

}  // namespace
}  // namespace breccia
