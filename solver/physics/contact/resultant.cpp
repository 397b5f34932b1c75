#include "physics/contact/forces.hpp"

namespace breccia {

std::array<ExactSum, 3> contact_force_on(const ContactState& contact, const LocalMesh& local,
                                         const std::function<bool(Index slot)>& holds) {
  std::array<ExactSum, 3> sum;
  const auto add = [&](const Vec3& force) {
    for (std::size_t i = 0; i < 3; ++i) sum[i].add(force[static_cast<Eigen::Index>(i)]);
  };
  const auto slot_of = [&](Index point) { return contact.points[static_cast<std::size_t>(point)].slot; };
  for (const BoundaryForce& b : contact.boundary) {
    const Index slot = slot_of(b.point);
    if (local.is_original(slot) && holds(slot)) add(b.force);
  }
  for (const TouchingCouple& t : contact.touching) {
    const Index slot = slot_of(t.point);
    if (!local.is_original(slot)) continue;
    if (holds(slot)) add(t.history.force);
    if (holds(contact.contactors[static_cast<std::size_t>(t.contactor)])) add(-t.history.force);
  }
  return sum;
}

}  // namespace breccia
