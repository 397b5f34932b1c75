#pragma once

#include <array>

#include "base/types.hpp"
#include "discretisation/local_mesh.hpp"
#include "physics/elasticity.hpp"
#include "physics/material/bulk_law.hpp"

namespace breccia {

/// Cauchy stress of an element, Pa, tension positive, with its elastic and viscous part: T = P F^T / J, with max(J,
/// j_min) for an element crushed further than the law goes.
/// @param memory    of all elements, which stays as it is
/// @param position  nodal field, m;  @param velocity  nodal field, m/s, or nullptr: elastic part alone
[[nodiscard]] Mat3 cauchy_stress(const LocalMesh& mesh, const ElasticParams& params, Index slot, const double* position,
                                 const double* velocity, const MaterialMemory& memory = {});

/// sqrt(3 J2), Pa.
[[nodiscard]] double von_mises(const Mat3& stress);

/// Principal stresses, descending, Pa: closed form, accurate to round-off of the largest entry also where two or three
/// of them nearly coincide. The one standing apart comes from the trigonometric formula, where that is well
/// conditioned; the other two from the 2 x 2 problem orthogonal to its direction.
/// Source: Scherzinger, Dohrmann, Comput. Methods Appl. Mech. Eng. 197 (2008) 4007.
/// @pre stress is symmetric
[[nodiscard]] Vec3 principal_stresses(const Mat3& stress);

/// xx yy zz xy yz xz.
[[nodiscard]] inline std::array<double, 6> components(const Mat3& t) {
  return {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2)};
}

}  // namespace breccia
