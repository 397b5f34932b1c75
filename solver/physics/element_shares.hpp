#pragma once

#include <array>
#include <vector>

#include "base/field.hpp"
#include "physics/stable_step.hpp"

namespace breccia {

/// StepShare of the elements of a model, evaluated again and again: what does not change is kept, and shares are put
/// together where they are requested.
class ElementShares {
 public:
  /// O(elements + joints)
  explicit ElementShares(const StepModel& model);

  /// At these positions. The same bits for every instruction set. O(elements), allocates nothing after the first call.
  /// @param model  the same but for memory and local damping
  void update(const StepModel& model, const Field<double>& position);

  // At the positions of the last update.
  /// Zeros on padding.
  [[nodiscard]] StepShare of(const StepModel& model, Index slot) const;
  /// Largest omega_e^2 + omega_j^2 of an element, 1/s2: StepShare::largest().
  [[nodiscard]] double largest(const LocalMesh& mesh, Index slot) const;
  /// StepShare::damping, 1/s.
  [[nodiscard]] double damping(const StepModel& model, Index slot) const;
  /// Largest of the originals; 0 without one.
  [[nodiscard]] double stiffest(const LocalMesh& mesh) const;

 private:
  /// Means around a shared node.
  struct Node {
    double joint = 0;                                     ///< omega_j^2
    double mass_sum = 0, stiff_sum = 0, damping_sum = 0;  ///< over its elements
    double element = 0, damping = 0;                      ///< omega_e^2, 1/s
  };
  void average(const StepModel& model);

  std::vector<double> frequency_;             ///< (num_slots) omega_e^2 of elements on their own
  std::vector<std::array<double, 4>> joint_;  ///< (own slots) omega_j^2 by face
  std::vector<double> stiffest_joint_;        ///< (own slots) largest StepShare::joint_at
  std::vector<Node> nodes_;                   ///< (shared nodes)
};

}  // namespace breccia
