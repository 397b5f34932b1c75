#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"
#include "physics/stable_step.hpp"

namespace breccia {

/// The stable step of a model, as far as the discretisation decides it.
///
/// The bound by element is cheap and follows the deformation; at rest the true limit of the linear system is larger by
/// a ratio that is found once by iteration and kept: fracture makes nothing stiffer.
class TimeStep {
 public:
  /// @pre model outlives this object; it is whole, or its WholeModel holds the ratio. O(elements) times some dozens to
  /// find the ratio.
  explicit TimeStep(const Model& model);

  /// Largest stable step of the originals at these positions, s, with what limits it.
  [[nodiscard]] StableStep at(const Field<double>& position, const MaterialMemory& memory = {}) const;
  /// As `at`, times the ratio of the true limit to the bound at rest.
  [[nodiscard]] double limit(const Field<double>& position, const MaterialMemory& memory = {}) const {
    return ratio_ * at(position, memory).step;
  }
  [[nodiscard]] double ratio() const { return ratio_; }

 private:
  [[nodiscard]] StepModel step_model(const MaterialMemory& memory) const;

  const Model& model_;
  JointLinks links_;
  std::vector<ContactStiffness> contacts_;
  double ratio_ = 1.0;
};

/// "0.12 us, limited by the joint between elements 17 and 43".
[[nodiscard]] std::string limit_text(const StableStep& step);

}  // namespace breccia
