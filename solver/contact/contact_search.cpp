#include "contact/contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "physics/contact/couples.hpp"

namespace breccia {

namespace {}  // namespace

ContactSearch::ContactSearch(const ContactSearchParams& search, const ContactModel& model, ContactState& contact)
    : verify_(search.verify),
      contact_(contact),
      surface_(search, model, contact),
      search_(search, surface_, contact, surface_.choose_contactors(search)),
      kept_(contact),
      release_(surface_, search_, contact) {
  contact_.near = search_.always_found();
  contact_.travel = 0;
  surface_.add_free_points();
  sort_points(contact_);
}

/// Rounded up, so that after a long way the shortest steps count as well.
void ContactSearch::count_travel(double length) {
  contact_.travel = std::nextafter(contact_.travel + length, std::numeric_limits<double>::infinity());
}

void ContactSearch::search(const NodalState& nodes, double step_length, std::span<const std::uint8_t> current) {
  search_.search(nodes, step_length, current, contact_.couples);
  kept_.replaced();
}

Extent ContactSearch::extent(const Field<double>& position) const {
  const LocalMesh& local = surface_.model().local;
  Extent extent;
  for (Index s = 0; s < local.num_slots; ++s) {
    if (contact_.evaluated(s)) extent.add(extent_of(load_corners(local, position.data(), s)));
  }
  return extent;
}

void ContactSearch::restrict_to(std::vector<std::uint8_t> relevant) {
  DEMAND(!search_.searched(), "couples are there already");
  contact_.relevant = std::move(relevant);
  search_.expect_late_speeds();
}

void ContactSearch::mark_coupled(std::vector<std::uint8_t>& marks) const {
  const auto mark = [&](const auto& couple) {
    marks[at(contact_.points[at(couple.point)].slot)] = 1;
    marks[at(contact_.contactors[at(couple.contactor)])] = 1;
  };
  for (const ContactCouple& couple : contact_.couples) mark(couple);
  // Histories without a couple any more: what is left of them ends with forces.
  for (const TouchingCouple& couple : contact_.touching) mark(couple);
}

void ContactSearch::verify(const NodalState& nodes) const {
  if (!verify_) return;
  const LocalMesh& local = surface_.model().local;
  const FaceRule& rule = face_rule(surface_.model().params.points_per_face);
  for (std::size_t c = 0; c < contact_.contactors.size(); ++c) {
    const Index slot = contact_.contactors[c];
    const auto contactor = static_cast<Index>(c);
    const PreparedTetra tetra = prepare(load_corners(local, nodes.position.data(), slot), local.volume[at(slot)]);
    for (const Index p : contact_.order) {
      if (!inside(barycentric(tetra, at_point(rule, contact_.points[at(p)], nodes.position.data())))) continue;
      if (!surface_.may_touch(p, contactor)) continue;
      if (!contact_.evaluated(contact_.points[at(p)].slot) && !contact_.evaluated(slot)) continue;
      const ContactCouple couple{p, contactor};
      const auto found =
          std::lower_bound(contact_.couples.begin(), contact_.couples.end(), couple,
                           [&](const ContactCouple& a, const ContactCouple& b) { return contact_.before(a, b); });
      const auto what = [&] {
        return "contact point " + std::to_string(contact_.id(p)) + " of element " +
               std::to_string(contact_.id(p) / 24) + " touches element " +
               std::to_string(local.element_of_slot[at(slot)]);
      };
      DEMAND(found != contact_.couples.end() && *found == couple, what() + " but they are no couple");
      DEMAND(!(contact_.travel < found->apart_until), what() + " but their couple is marked as separated");
    }
  }
}

}  // namespace breccia
