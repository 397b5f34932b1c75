#pragma once

#include <cstdint>

#include "base/index.hpp"
#include "state/blocks.hpp"

namespace breccia {

/// A number of each of eight joints: one cache line.
using JointRow = double[kLanes];

/// JointPointHistory of one point of each of eight joints.
struct JointPointRows {
  JointRow damage, level, left;
  JointRow memory;  ///< joint_point::kFresh .. kGone
  JointRow opening[3], traction[3];
  JointRow normal_opening, normal_traction, stored_normal, stored_shear;
  JointRow slip[2], friction_weight, friction_traction[2], stored_friction;  ///< with friction only
  JointRow secant_normal, secant_shear;                                      ///< independent_peaks only
};

/// What the last evaluation said of a joint, beside forces.
enum JointNews : std::uint8_t {
  kElastic = 1,   ///< without damage, and well within the elastic range
  kFailing = 2,   ///< has failed in this step
  kReleased = 4,  ///< failed and open everywhere: no forces
  kTurning = 8    ///< a closed joint that has slid: turning holds its forces
};

/// Eight active joints of one law side by side, everything that the kernel reads and writes in rows: AoSoA. What an
/// empty place holds is computed along and forgotten.
struct alignas(64) JointBlock {
  Index node[6][kLanes];  ///< corners of the face of a, then the matching ones of b
  JointRow area, mode_1, mode_2, friction;
  JointRow tilt[3], normal[3], turned;
  JointRow failed;  ///< 0 or 1
  JointPointRows points[3];
  // Of the last evaluation.
  JointRow force[3][3], turning[3][3];  ///< N: force + turning on the corners of a, turning - force on those of b
  std::uint8_t news[kLanes];            ///< JointNews
  bool computed;                        ///< in this step
};

}  // namespace breccia
