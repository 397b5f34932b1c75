#include "physics/contact/step/bound.hpp"

#include <algorithm>

namespace breccia {

namespace {

/// Of the points of one of the patches on the other, for a whole weight.
/// @param of_p  the points are those of p
ContactBound bound_of_points(const ContactParams& params, const ContactPatch& p, const ContactPatch& q, bool of_p) {
  const ContactPatch &points = of_p ? p : q, &entered = of_p ? q : p;
  ContactBound m;
  m.against = static_cast<Index>(q.group);
  const ContactLaw& law = params.law(static_cast<Index>(points.group), static_cast<Index>(entered.group));
  const double weight = points.largest[ContactPatch::weight];
  if (!(weight > 0)) return m;
  const auto linear = [&](double factor) {
    const double far =
        q.largest[ContactPatch::area_over_mass] + (of_p ? weight * q.largest[ContactPatch::per_mass] : 0);
    return ContactBound::Linear{factor, of_p ? 0.0 : factor * weight, factor * far};
  };
  const double steepness = entered.largest[ContactPatch::steepness];
  m.sum = linear(stiffest_slope(law) * entered.largest[ContactPatch::per_length] * steepness);
  m.decay = linear(law.damping * steepness);
  return m;
}

}  // namespace

std::array<ContactBound, 2> contact_bounds(const ContactParams& params, const ContactPatch& p, const ContactPatch& q) {
  std::array<ContactBound, 2> bounds{bound_of_points(params, p, q, true), bound_of_points(params, p, q, false)};
  const auto presses = [](const ContactBound& m) { return m.sum.by_area > 0; };
  if (presses(bounds[0]) && presses(bounds[1])) {
    for (ContactBound& m : bounds) m *= 2;
  }
  return bounds;
}

bool dominated(const ContactBound& bound, const std::vector<ContactBound>& bounds) {
  return std::any_of(bounds.begin(), bounds.end(), [&](const ContactBound& m) { return m.dominates(bound); });
}

bool dominated(const std::array<ContactBound, 2>& both, const std::vector<ContactBound>& bounds) {
  return dominated(both[0], bounds) && dominated(both[1], bounds);
}

void add_bounds(const std::array<ContactBound, 2>& made, std::vector<ContactBound>& bounds) {
  for (const ContactBound& m : made) add_bound(m, bounds);
}

void add_bound(const ContactBound& made, std::vector<ContactBound>& bounds) {
  if (dominated(made, bounds)) return;
  std::erase_if(bounds, [&](const ContactBound& m) { return made.dominates(m); });
  bounds.push_back(made);
}

}  // namespace breccia
