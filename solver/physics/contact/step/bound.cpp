#include "physics/contact/step/bound.hpp"

#include <algorithm>

namespace breccia {

ContactBound contact_bound(const ContactParams& params, const ContactPatch& p, const ContactPatch& q) {
  ContactBound m;
  m.against = static_cast<Index>(q.group);
  const auto add = [&](ContactBound::Linear& to, double factor, double weight_of_p, double weight_of_q) {
    to.by_area += factor;
    to.by_per_mass += factor * weight_of_q;
    to.rest += factor * (q.largest[ContactPatch::area_over_mass] + weight_of_p * q.largest[ContactPatch::per_mass]);
  };
  const auto enter = [&](const ContactPatch& points, const ContactPatch& entered, double weight_of_p,
                         double weight_of_q) {
    if (!(points.largest[ContactPatch::weight] > 0)) return;
    const ContactLaw& law = params.law(static_cast<Index>(points.group), static_cast<Index>(entered.group));
    const double steepness = entered.largest[ContactPatch::steepness];
    add(m.sum, stiffest_slope(law) * entered.largest[ContactPatch::per_length] * steepness, weight_of_p, weight_of_q);
    add(m.decay, law.damping * steepness, weight_of_p, weight_of_q);
  };
  enter(p, q, p.largest[ContactPatch::weight], 0);
  enter(q, p, 0, q.largest[ContactPatch::weight]);
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
