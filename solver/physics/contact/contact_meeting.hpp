#pragma once

#include <cmath>
#include <vector>

#include "physics/contact/contact_step.hpp"

namespace breccia {

/// What a node of one patch has of meeting another, by its A_i/m_i and 1/m_i: a sum of stiffnesses, 1/s2, and of
/// decays, 1/s, each linear in these.
struct Meeting {
  struct Linear {
    double by_area = 0, by_per_mass = 0, rest = 0;
    [[nodiscard]] double operator()(double area_over_mass, double per_mass) const {
      return by_area * area_over_mass + by_per_mass * per_mass + rest;
    }
    [[nodiscard]] bool covers(const Linear& other) const {
      return by_area >= other.by_area && by_per_mass >= other.by_per_mass && rest >= other.rest;
    }
  };
  Linear sum, decay;
  Index against = 0;  ///< group

  /// Whether no node has more of the other one.
  [[nodiscard]] bool covers(const Meeting& other) const { return sum.covers(other.sum) && decay.covers(other.decay); }

  /// omega_c^2. With damping the node's rate of decay gamma is made of the same terms as omega_c^2; a step that begins
  /// with the speed before it is stable up to 2/omega' with omega'/2 = gamma/4 + sqrt(gamma^2/16 + omega^2/4). Twice
  /// the gamma covers that the elements' own omega^2 adds up.
  [[nodiscard]] double share(double area_over_mass, double per_mass) const {
    const double stiff = sum(area_over_mass, per_mass), damped = decay(area_over_mass, per_mass);
    if (!(damped > 0)) return stiff;
    const double root = damped + std::sqrt(damped * damped + stiff);
    return root * root;
  }
};

/// Of the nodes of patch p with patch q.
[[nodiscard]] Meeting meeting(const ContactParams& params, const ContactPatch& p, const ContactPatch& q);

/// Adds to those of a patch what none of them covers, and takes out what it covers: what is left has the largest share
/// of any node. O(meetings)
void add_meeting(const Meeting& made, std::vector<Meeting>& meetings);

}  // namespace breccia
