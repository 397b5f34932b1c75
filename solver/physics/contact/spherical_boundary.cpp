#include "physics/contact/spherical_boundary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breccia {
namespace {

/// Share of the force on a point, 1 but in the step within which it has come out of the sphere, or is to come back with
/// the motion of the last one. Of a motion D out to a depth d central differences take 1/2 k d D there, and give as
/// much on the way back, where 1/2 k d^2 is stored: with this share, which acts in two steps, they take and give that.
/// Without it a body that returns slower, since it spins or vibrates, would lose unaccounted energy.
/// @param beyond  d, m;  @param moved  m, outwards, in the last step
double balanced_share(double beyond, double moved) {
  const double way = std::abs(moved);
  return beyond < way ? 0.5 * (1.0 + beyond / way) : 1.0;
}

}  // namespace

void spherical_boundary(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt,
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
    const double moved = r - (from_centre - dt * at_point(rule, point, state.velocity.data())).norm();
    const Vec3 force = (-balanced_share(beyond, moved) * stiffness * beyond / r) * from_centre;
    const std::array<double, 3>& shape = rule.shape[static_cast<std::size_t>(point.k)];
    for (std::size_t i = 0; i < 3; ++i) forces.add(point.nodes[i], shape[i] * force);
    if (local.is_original(point.slot)) stored.add(0.5 * stiffness * beyond * beyond);
    contact.boundary.push_back({index, force});
  }
}

}  // namespace breccia
