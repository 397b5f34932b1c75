#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/index.hpp"
#include "discretisation/blocks.hpp"
#include "physics/joint_history.hpp"

namespace breccia {

/// A number of each of eight joints: one cache line.
struct JointRow {
  double lane[kLanes];

  JointRow(double all = 0.0) { std::fill(lane, lane + kLanes, all); }
  [[nodiscard]] double& operator[](std::size_t l) { return lane[l]; }
  [[nodiscard]] const double& operator[](std::size_t l) const { return lane[l]; }
};

/// Result of the last evaluation of a joint, beside forces.
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
  JointHistory<JointRow> history;
  // Of the last evaluation.
  JointRow force[3][3], turning[3][3];  ///< N: force + turning on the corners of a, turning - force on those of b
  std::uint8_t news[kLanes];            ///< JointNews
  bool computed;                        ///< in this step
};

}  // namespace breccia
