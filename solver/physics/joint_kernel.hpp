#pragma once

// The kernel of the active joints, included once by each translation unit joint_kernel_<instruction set>.cpp and
// compiled for its set, as the sweep is (sweep_kernel.hpp).

#include "physics/joint_block.hpp"
#include "physics/joint_evaluation.hpp"

namespace breccia {
namespace {

namespace stdx = std::experimental;
namespace jp = joint_point;

using Real = stdx::native_simd<double>;
using Lanes = Real::mask_type;
constexpr std::size_t kWidth = Real::size();
static_assert(kLanes % kWidth == 0);

/// Of the square of the elastic range: half the opening.
constexpr double kElasticShare = 0.25;

inline Real load(const double* p) { return Real(p, stdx::element_aligned); }
inline void store(const Real& value, double* p) { value.copy_to(p, stdx::element_aligned); }

inline jp::Sides<Real> gather(const double* position, const JointBlock& block, std::size_t lane) {
  jp::Sides<Real> sides;
  for (std::size_t corner = 0; corner < 6; ++corner) {
    const double* place[kWidth];
    for (std::size_t l = 0; l < kWidth; ++l) place[l] = position + nodal(block.node[corner][lane + l], 0);
    jp::Vector<Real>& x = corner < 3 ? sides.a[corner] : sides.b[corner - 3];
    for (std::size_t axis = 0; axis < 3; ++axis) x[axis] = Real([&](auto l) { return place[l][axis * kLanes]; });
  }
  return sides;
}

inline bool wanted(const JointLawParams& law, const JointNumber& number) {
  switch (number.use) {
    case JointNumberUse::all:
      return true;
    case JointNumberUse::friction:
      return law.friction > 0;
    case JointNumberUse::peaks:
      return has_secants(law.law);
  }
  __builtin_unreachable();
}

inline void load_points(const JointLawParams& law, const JointBlock& block, std::size_t lane, jp::Joint<Real>& joint) {
  for (std::size_t i = 0; i < 3; ++i) {
    joint.points[i] = {};
    const auto load_number = [&](const JointNumber& number, Real& x, const JointRow& row) {
      if (wanted(law, number)) x = load(&row[lane]);
    };
    for_each_number(load_number, joint.points[i], block.history.points[i]);
  }
}

inline void store_points(const JointLawParams& law, const jp::Joint<Real>& joint, std::size_t lane, JointBlock& block) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto store_number = [&](const JointNumber& number, const Real& x, JointRow& row) {
      if (wanted(law, number)) store(x, &row[lane]);
    };
    for_each_number(store_number, joint.points[i], block.history.points[i]);
  }
}

inline void load_common(const JointBlock& block, std::size_t lane, jp::Joint<Real>& joint) {
  for_each_common_number([&](const JointNumber&, Real& x, const JointRow& row) { x = load(&row[lane]); }, joint,
                         block.history);
}

inline void store_common(const jp::Joint<Real>& joint, std::size_t lane, JointBlock& block) {
  for_each_common_number([&](const JointNumber&, const Real& x, JointRow& row) { store(x, &row[lane]); }, joint,
                         block.history);
}

inline void note(const Lanes& lanes, JointNews news, std::size_t lane, JointBlock& block) {
  if (stdx::none_of(lanes)) return;
  for (std::size_t l = 0; l < kWidth; ++l) {
    if (lanes[l]) block.news[lane + l] = static_cast<std::uint8_t>(block.news[lane + l] | news);
  }
}

/// Joints without damage whose openings are within the surely elastic range: as the sweep would, without their normal.
inline Lanes elastic_lanes(const JointLawParams& law, const jp::Sides<Real>& sides, std::size_t lane,
                           JointBlock& block) {
  if (!(law.screen > 0)) return Lanes(false);
  Lanes elastic = load(&block.history.failed[lane]) == kHolding;
  for (const JointPointHistory<JointRow>& p : block.history.points) elastic = elastic && load(&p.damage[lane]) <= 0.0;
  if (stdx::none_of(elastic)) return elastic;
  const Real largest = jp::largest_opening_squared(sides);
  elastic = elastic && largest <= law.screen;
  note(elastic && largest <= kElasticShare * law.screen, kElastic, lane, block);
  return elastic;
}

inline void store_forces(const jp::Triple<Real>& force, JointRow (&rows)[3][3], std::size_t lane) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) store(force[i][axis], &rows[i][axis][lane]);
  }
}

/// Nothing holds any more, or nothing that could act as the joint is open.
inline Lanes is_released(const jp::Kinematics<Real>& k, const jp::Joint<Real>& joint) {
  Lanes broken = joint.failed > 0.0;
  for (const jp::Point<Real>& p : joint.points)
    broken = broken && p.damage >= 1.0 && p.viscous_traction == 0.0 && p.balance == 0.0;
  return (broken && jp::open_everywhere(k)) || joint.hold <= 0.0;
}

/// W joints beyond their elastic range, but for those lanes that are `elastic`.
inline void act_beyond(const JointLawParams& law, const jp::Sides<Real>& sides, const Lanes& elastic, std::size_t lane,
                       jp::Joint<Real>& joint, JointBlock& block) {
  load_common(block, lane, joint);
  const jp::Kinematics<Real> k = jp::kinematics(law, sides);
  store_forces(jp::evaluate_points(law, k, joint), block.force, lane);
  const Lanes failing =
      joint.failed <= 0.0 && (jp::enough_points_broken(law, joint) || joint.hold < 1.0 || joint.failed < 0.0);
  joint.failed = jp::select(failing, Real(kFailed), joint.failed);
  note(failing, kFailing, lane, block);
  const Lanes released = is_released(k, joint);
  note(released, kReleased, lane, block);
  store_common(joint, lane, block);
  const Lanes stays = !elastic && !released;
  const Lanes turns = stays && jp::may_tilt(law, joint);
  if (stdx::none_of(turns)) return;
  note(turns, kTurning, lane, block);
  store_forces(jp::tilting_forces(law, k, turns, joint), block.turning, lane);
}

/// W joints that are all elastic: no more is touched than such joints remember.
inline void act_elastic(const JointLawParams& law, const jp::Sides<Real>& sides, std::size_t lane, JointBlock& block) {
  const Real stiffness = law.stiffness * load(&block.history.area[lane]) / 3.0;
  jp::Triple<Real> force;
  for (std::size_t i = 0; i < 3; ++i) {
    const jp::Vector<Real> opening = jp::minus(sides.b[i], sides.a[i]);
    jp::Point<Real> p;
    jp::set_elastic(law, opening, p);
    const auto store_elastic = [&](const JointNumber& number, const Real& x, JointRow& row) {
      if (number.of_elastic) store(x, &row[lane]);
    };
    for_each_number(store_elastic, p, block.history.points[i]);
    force[i] = jp::times(stiffness, opening);
  }
  store_forces(force, block.force, lane);
}

/// W joints of a block.
inline void act(const JointLawParams& law, const double* position, std::size_t lane, JointBlock& block) {
  for (std::size_t l = 0; l < kWidth; ++l) block.news[lane + l] = 0;
  const jp::Sides<Real> sides = gather(position, block, lane);
  const Lanes elastic = elastic_lanes(law, sides, lane, block);
  if (stdx::all_of(elastic)) {
    act_elastic(law, sides, lane, block);
    return;
  }
  jp::Joint<Real> joint;
  load_points(law, block, lane, joint);
  if (stdx::none_of(elastic)) {
    act_beyond(law, sides, elastic, lane, joint, block);
  } else {
    const jp::Point<Real> before[3] = {joint.points[0], joint.points[1], joint.points[2]};
    act_beyond(law, sides, elastic, lane, joint, block);  // gives elastic lanes their forces in the same products
    for (std::size_t i = 0; i < 3; ++i) {
      jp::Point<Real> undamaged = before[i];
      jp::set_elastic(law, jp::minus(sides.b[i], sides.a[i]), undamaged);
      joint.points[i] = jp::select_point(elastic, undamaged, joint.points[i]);
    }
  }
  store_points(law, joint, lane, block);
}

inline void act_block(const JointLawParams& law, const double* position, JointBlock& block) {
  for (std::size_t lane = 0; lane < kLanes; lane += kWidth) act(law, position, lane, block);
}

}  // namespace
}  // namespace breccia
