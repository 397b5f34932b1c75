#pragma once

#include <cstdint>

#include "base/types.hpp"
#include "physics/joint_history.hpp"

namespace breccia {

enum class JointState : std::uint8_t {
  holding,  ///< elastic or damaged
  failed    ///< damage 1 at points_to_fail points: a frictional interface until it is open everywhere
};

/// How a joint failed, by the energy it dissipated: a mode alone when it took more than three quarters.
enum class FailureMode : std::uint8_t { none = 0, mode_1 = 1, mode_2 = 2, mixed = 3 };

/// A joint that is evaluated once a step, apart from the sweep: one that has left its elastic range, or whose law
/// the sweep does not know. Side a is the element of lower global id.
struct ActiveJoint {
  GlobalId id = 0;
  Index slot_a = 0, slot_b = 0;
  std::int8_t face_a = 0, code = 0;  ///< as in JointFace
  Index law = 0;
  JointHistory<double> history;
  double time_of_failure = -1;  ///< s, t_n of the step in which the state became failed; -1 before
  bool elastic = false;         ///< without damage, and well within the elastic range at the last evaluation

  [[nodiscard]] JointState state() const { return history.failed > 0 ? JointState::failed : JointState::holding; }
  [[nodiscard]] double damage() const;   ///< largest of the points
  [[nodiscard]] double stored() const;   ///< J
  [[nodiscard]] double opening() const;  ///< m, mean normal opening
  [[nodiscard]] double slip() const;     ///< m, mean length of the shear opening
  [[nodiscard]] FailureMode mode() const;
};

}  // namespace breccia
