#include "physics/contact/spherical_boundary.hpp"

#include <algorithm>
#include <limits>

namespace breccia {

void spherical_boundary(const ContactParams& params, const LocalMesh& local, const NodalState& state,
                        ContactState& contact, NodalForces& forces, ExactSum& stored) {
  contact.boundary.clear();
  if (!params.sphere) return;
  const SphericalBoundary& sphere = *params.sphere;
  const FaceRule& rule = face_rule(params.points_per_face);
  contact.boundary_offset.resize(contact.points.size(), std::numeric_limits<double>::infinity());
  for (const Index index : contact.order) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(index)];
    if (!contact.evaluated(point.slot)) continue;
    const Vec3 from_centre = at_point(rule, point, state.position.data()) - sphere.centre;
    const double r = from_centre.norm();
    // A point that comes into being outside, on a face freed by fracture, is not thrown back with energy from nowhere.
    double& offset = contact.boundary_offset[static_cast<std::size_t>(index)];
    offset = std::min(offset, std::max(r - sphere.radius, 0.0));
    const double beyond = r - sphere.radius - offset;
    if (!(beyond > 0)) continue;
    const Index body = local.slot_body[static_cast<std::size_t>(point.slot)];
    const double stiffness = point.weight * sphere.penalty / contact.body_length[static_cast<std::size_t>(body)];
    const Vec3 force = (-stiffness * beyond / r) * from_centre;
    const std::array<double, 3>& shape = rule.shape[static_cast<std::size_t>(point.k)];
    for (std::size_t i = 0; i < 3; ++i) forces.add(point.nodes[i], shape[i] * force);
    if (local.is_original(point.slot)) stored.add(0.5 * stiffness * beyond * beyond);
    contact.boundary.push_back({index, force});
  }
}

}  // namespace breccia
