#pragma once

#include <optional>
#include <vector>

#include "case/case.hpp"
#include "domains/domain.hpp"
#include "domains/global_step.hpp"
#include "model/model.hpp"
#include "model/time_step.hpp"

namespace breccia {

/// The stable time step of a model before its first step, with what it is made of. Works on a scratch copy of the
/// state, on one rank.
class StepAtStart {
 public:
  /// @param model  stays, as `input` does; of the whole mesh, not a bare one
  StepAtStart(const case_::Case& input, const Model& model);

  [[nodiscard]] const StableStep& now() const { return now_; }
  [[nodiscard]] const StepParts& parts() const { return parts_; }
  [[nodiscard]] StepModel model_now() const;
  /// s, of the first steps of a run: what the case gives, or the stable one times time.safety.
  [[nodiscard]] double dt() const;

  /// Contact as it is once bodies have met that come to meet until the end, at the speeds they have or gravity gives
  /// them.
  [[nodiscard]] const std::vector<ContactShare>& met() const;

  [[nodiscard]] StableStep step_with(const std::vector<ContactShare>& contacts) const;

  /// s, as it is now but for the viscosity.
  [[nodiscard]] double step_without_viscosity() const;

  /// With all joints of breakable groups broken and their faces in contact.
  [[nodiscard]] StableStep broken() const;

 private:
  [[nodiscard]] Field<double> velocity_with_gravity() const;
  [[nodiscard]] StepState state(const Field<double>& velocity) const;

  const case_::Case& input_;
  const Model& model_;
  TimeStep time_step_;
  Domain domain_;
  StageLoads loads_;  ///< of the first stage
  StepParts parts_;
  StableStep now_;
  mutable std::optional<std::vector<ContactShare>> met_;
};

}  // namespace breccia
