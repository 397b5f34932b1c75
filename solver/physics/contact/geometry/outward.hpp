#pragma once

#include "discretisation/local_mesh.hpp"
#include "mesh/tetrahedron.hpp"
#include "physics/contact/geometry/overlap.hpp"
#include "physics/contact/geometry/point.hpp"
#include "physics/contact/state.hpp"

namespace breccia {

/// Corner of a point's element that the point is at; -1: it is at none.
[[nodiscard]] int corner_of(const FaceRule& rule, const ContactPoint& point);

/// Mean normal of the surface at a corner, inwards, of any length, where its element is now.
/// @param normal  at rest, outwards;  @param x  corners now
[[nodiscard]] Vec3 turned_inwards(const Vec3& normal, const LocalMesh& local, Index slot, const std::array<Vec3, 4>& x);

/// Directions of the surface at a point. At a corner of its face that is also an edge or a corner of the body, what is
/// beside the face counts too: such a point touches with all faces that meet there.
/// @param place  of a node, m
template <class Place>
[[nodiscard]] Outward outward_at(const FaceRule& rule, const LocalMesh& local, const ContactState& contact,
                                 const ContactPoint& point, Place&& place) {
  Outward outward{outward_normal(point, place), Vec3::Zero()};
  const int corner = corner_of(rule, point);
  const Index own = corner < 0 ? -1 : contact.contactor_of_slot[static_cast<std::size_t>(point.slot)];
  if (own < 0) return outward;
  const std::array<double, 3>& n =
      contact.field[static_cast<std::size_t>(own)].normal[static_cast<std::size_t>(corner)];
  std::array<Vec3, 4> x;
  for (int a = 0; a < 4; ++a) x[static_cast<std::size_t>(a)] = place(local.corner_node(point.slot, a));
  outward.corner = -turned_inwards(Vec3(n[0], n[1], n[2]), local, point.slot, x);
  return outward;
}

/// How sharp the surface is: 0 where it is flat, nearly 1 at edges and corners, where it has come from inside, and
/// where its triangles are tilted by more than a few degrees. Of corners in between, by interpolation.
[[nodiscard]] double sharpness(const FaceRule& rule, const ContactPoint& point, const FieldValues& values);
/// @param lambda  of a place near the surface
[[nodiscard]] double sharpness(const FieldValues& values, const std::array<double, 4>& lambda);

/// Share of its weight with which a point presses on a contactor whose points press on the point's body as well. The
/// sharper surface presses on the flatter one, whose normal is then the direction of all forces: the normals of the
/// triangles of a curved surface are not those of the surface. At one place the shares of both add up to 2; > 0.
[[nodiscard]] inline double share_of_weight(double sharpness_of_point, double sharpness_of_contactor) {
  return 1 + sharpness_of_point - sharpness_of_contactor;
}

}  // namespace breccia
