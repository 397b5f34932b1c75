#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "domains/domain.hpp"

namespace breccia {

/// Watches how evenly the ranks are loaded, and what elements, joints and couples cost.
class Balance {
 public:
  /// Steps between two evaluations.
  static constexpr std::int64_t kInterval = 100;

  /// Seconds that ranks have waited for the slowest since the model was divided: what its work took beyond the mean,
  /// all steps taken together, so that what slows now one, now another, as others on the machine come and go, does not
  /// count. Collective; to be called every kInterval steps.
  [[nodiscard]] double look(const Domain& domain);
  /// Largest over mean working time of the ranks at the last evaluation; 1: none yet.
  [[nodiscard]] double imbalance() const { return told_; }
  /// This rank's working time over the mean at the last evaluation; 1: none yet.
  [[nodiscard]] double load() const { return load_; }

  /// Cost of this rank's originals, ascending by id, relative to an element with its own nodes without joints: measured
  /// per element, joint and couple over all ranks, or estimated before the first evaluation; larger if the rank is
  /// slower than others at the same work.
  [[nodiscard]] std::vector<double> weights(const Domain& domain) const;

  /// The same of elements at rest. @param discretisation  (volume groups)
  [[nodiscard]] static std::vector<double> weights_at_rest(const Records& records,
                                                           const std::vector<Discretisation>& discretisation);

  /// The model has been divided again, and the domain replaced by one that continues with its timer.
  void restart(const Domain& domain) {
    seen_ = work(domain);
    busy_.clear();
  }

 private:
  /// Seconds in the sweep, joints and contact.
  using Work = std::array<double, 3>;
  [[nodiscard]] static Work work(const Domain& domain);

  Work seen_{};
  Work unit_{1.0, 2.0, 2.0};  ///< cost of an element that owns its nodes, an active joint, a couple
  std::vector<double> busy_;  ///< (ranks) s, since the model was divided
  double slowness_ = 1;       ///< of this rank: time of its work over the time of the same work on average, over the
                              ///< evaluations
  double told_ = 1, load_ = 1;
};

}  // namespace breccia
