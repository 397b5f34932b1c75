#pragma once

#include <array>

namespace breccia::material {

/// Components xx yy zz xy yz xz of a symmetric tensor.
using Symmetric = std::array<double, 6>;

/// Eigenvalues of a symmetric tensor and their axes: orthonormal to round-off.
struct Principal {
  std::array<double, 3> value{};
  std::array<std::array<double, 3>, 3> axis{};  ///< axis[i] belongs to value[i]
};

/// By cyclic Jacobi rotations: every eigenvalue to round-off of the largest entry, also where two or three of them
/// coincide; a diagonal tensor keeps its values, bits and order. Always the same operations for the same input.
/// Source: [Golub 2013, section 8.5].
[[nodiscard]] Principal principal_of(const Symmetric& tensor);

}  // namespace breccia::material
