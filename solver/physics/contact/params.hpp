#pragma once

#include <optional>
#include <vector>

#include "base/types.hpp"
#include "physics/contact/law/normal.hpp"
#include "physics/contact/rules.hpp"

namespace breccia {

/// Overlap g (m) of a point inside a contactor, from its barycentric coordinates lambda.
enum class OverlapField {
  body,           ///< depth below the surface of a whole body, continuous through it (geometry/field.hpp)
  tet_potential,  ///< 4 H min(lambda). Source: [Munjiza 2004]
  tet_distance    ///< distance to the nearest face of the undeformed tetrahedron
};

/// Sphere that keeps all contact points inside: a point outside feels w sigma_p (r - R) / H towards the centre.
struct SphericalBoundary {
  Vec3 centre{0, 0, 0};
  double radius = 0;   ///< m
  double penalty = 0;  ///< Pa, sigma_p
};

/// What is done with bodies that overlap before the first step.
enum class InitialOverlap {
  refuse,  ///< the run ends with an error
  relax,   ///< the overlap becomes an offset without force
  accept   ///< contact pushes them apart at once
};

/// What the contact kernels need to know; the same all through a run.
struct ContactParams {
  int points_per_face = 4;        ///< 1, 3, 4 or 6
  bool points_everywhere = true;  ///< on all free faces, not on some surfaces alone
  OverlapField field = OverlapField::body;
  Index num_groups = 0;          ///< volume groups
  std::vector<ContactLaw> laws;  ///< (num_groups, num_groups): of points of a group against contactors of another
  std::vector<InitialOverlap> initial_overlaps;  ///< likewise
  std::optional<SphericalBoundary> sphere;
  ContactRules rules;

  /// Of the points of a group against the elements of another.
  [[nodiscard]] const ContactLaw& law(Index group, Index other) const {
    return laws[static_cast<std::size_t>(group) * static_cast<std::size_t>(num_groups) +
                static_cast<std::size_t>(other)];
  }
  [[nodiscard]] InitialOverlap initial_overlap(Index group, Index other) const {
    return initial_overlaps[static_cast<std::size_t>(group) * static_cast<std::size_t>(num_groups) +
                            static_cast<std::size_t>(other)];
  }
};

}  // namespace breccia
