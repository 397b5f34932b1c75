#pragma once

#include <array>
#include <span>

namespace breccia {

/// von Mises stress of a symmetric tensor s = (xx yy zz xy yz xz), Pa:
/// sqrt(((xx-yy)^2 + (yy-zz)^2 + (zz-xx)^2) / 2 + 3 (xy^2 + yz^2 + xz^2)).
[[nodiscard]] double von_mises_stress(std::span<const double, 6> s);

/// Principal values of s = (xx yy zz xy yz xz), descending, tension positive. By Jacobi rotations: about twenty times
/// the round-off of the largest entry, also for double and nearly double values, where closed forms lose half the digits.
/// NaN in, NaN out; throws nothing.
[[nodiscard]] std::array<double, 3> principal_stresses(std::span<const double, 6> s);

/// Both for every element: stress (n, 6), von_mises (n), principal (n, 3). @pre sizes agree. O(n), no allocation.
void derive_stress_fields(std::span<const double> stress, std::span<double> von_mises, std::span<double> principal);

}  // namespace breccia
