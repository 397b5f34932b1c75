#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "physics/contact/step/contact_step.hpp"

namespace breccia {

/// Upper bound of what contact with another patch adds to omega^2 of a node of the first (contact_step.hpp): stiffness
/// over mass, 1/s2, and a rate of decay, 1/s, each linear in the node's A_i/m_i and 1/m_i. For contact_step.cpp only.
struct ContactBound {
  struct Linear {
    double by_area = 0, by_per_mass = 0, rest = 0;
    [[nodiscard]] double operator()(double area_over_mass, double per_mass) const {
      return by_area * area_over_mass + by_per_mass * per_mass + rest;
    }
    Linear& operator*=(double factor) {
      by_area *= factor;
      by_per_mass *= factor;
      rest *= factor;
      return *this;
    }
    [[nodiscard]] bool dominates(const Linear& other) const {
      return by_area >= other.by_area && by_per_mass >= other.by_per_mass && rest >= other.rest;
    }
  };
  Linear sum, decay;
  Index against = 0;  ///< group

  ContactBound& operator*=(double factor) {
    sum *= factor;
    decay *= factor;
    return *this;
  }
  /// Whether this is at least as large as the other for every node.
  [[nodiscard]] bool dominates(const ContactBound& other) const {
    return sum.dominates(other.sum) && decay.dominates(other.decay);
  }

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

/// Of the nodes of patch p in contact with patch q: what the points of p add and what those of q add. Where both press
/// the shares of their weights add up to two (geometry/outward.hpp): each is doubled, and the larger one counts.
[[nodiscard]] std::array<ContactBound, 2> contact_bounds(const ContactParams& params, const ContactPatch& p,
                                                         const ContactPatch& q);

/// Whether any of the list is at least as large as the bound for every node.
[[nodiscard]] bool dominated(const ContactBound& bound, const std::vector<ContactBound>& bounds);
/// Whether this holds for both.
[[nodiscard]] bool dominated(const std::array<ContactBound, 2>& both, const std::vector<ContactBound>& bounds);

/// Keeps a list of bounds that do not dominate each other; for every node its largest share is that of all bounds ever
/// added. Of equal ones the first stays. O(bounds)
void add_bound(const ContactBound& made, std::vector<ContactBound>& bounds);
void add_bounds(const std::array<ContactBound, 2>& made, std::vector<ContactBound>& bounds);

}  // namespace breccia
