#include "physics/contact/contact_meeting.hpp"

#include <algorithm>

namespace breccia {

Meeting meeting(const ContactParams& params, const ContactPatch& p, const ContactPatch& q) {
  Meeting m;
  m.against = static_cast<Index>(q.group);
  const auto add = [&](Meeting::Linear& to, double factor, double weight_of_p, double weight_of_q) {
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

void add_meeting(const Meeting& made, std::vector<Meeting>& meetings) {
  if (std::any_of(meetings.begin(), meetings.end(), [&](const Meeting& m) { return m.covers(made); })) return;
  std::erase_if(meetings, [&](const Meeting& m) { return made.covers(m); });
  meetings.push_back(made);
}

}  // namespace breccia
