#include "physics/contact/step/bound.hpp"

#include <algorithm>

namespace breccia {

namespace {

using Linear = ContactBound::Linear;

/// Of the points of one patch that press on another, a rate for each of their shares of the weight.
/// @param stiffness  Pa/m or Pa s/m;  @param of_p  the points are those of p
Linear bound_of_points(const ContactPatch& p, const ContactPatch& q, double factor, bool of_p) {
  const double weight_of_p = of_p ? p.largest[ContactPatch::weight] : 0.0;
  const double weight_of_q = of_p ? 0.0 : q.largest[ContactPatch::weight];
  return {.by_area = factor,
          .by_per_mass = factor * weight_of_q,
          .rest = factor * (q.largest[ContactPatch::area_over_mass] + weight_of_p * q.largest[ContactPatch::per_mass])};
}

/// Where both directions press their shares add up to two (geometry/outward.hpp): twice the larger bound.
Linear both(const Linear& a, const Linear& b) {
  return {2 * std::max(a.by_area, b.by_area), 2 * std::max(a.by_per_mass, b.by_per_mass),
          2 * std::max(a.rest, b.rest)};
}

}  // namespace

ContactBound contact_bound(const ContactParams& params, const ContactPatch& p, const ContactPatch& q) {
  ContactBound m;
  m.against = static_cast<Index>(q.group);
  const auto add = [&](const ContactPatch& points, const ContactPatch& entered, bool of_p) {
    const ContactLaw& law = params.law(static_cast<Index>(points.group), static_cast<Index>(entered.group));
    if (!(points.largest[ContactPatch::weight] > 0) || !law.active()) return;
    const double steepness = entered.largest[ContactPatch::steepness];
    const double factor = stiffest_slope(law) * entered.largest[ContactPatch::per_length] * steepness;
    const bool is_second = m.sum.by_area > 0;
    const Linear sum = bound_of_points(p, q, factor, of_p), decay = bound_of_points(p, q, law.damping * steepness, of_p);
    m.sum = is_second ? both(m.sum, sum) : sum;
    m.decay = is_second ? both(m.decay, decay) : decay;
  };
  add(p, q, true);
  add(q, p, false);
  return m;
}

bool dominated(const ContactBound& bound, const std::vector<ContactBound>& bounds) {
  return std::any_of(bounds.begin(), bounds.end(), [&](const ContactBound& m) { return m.dominates(bound); });
}

void add_bound(const ContactBound& made, std::vector<ContactBound>& bounds) {
  if (dominated(made, bounds)) return;
  std::erase_if(bounds, [&](const ContactBound& m) { return made.dominates(m); });
  bounds.push_back(made);
}

}  // namespace breccia
