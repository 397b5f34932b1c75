#pragma once

#include <cmath>
#include <cstddef>

namespace breccia {

/// Vectors of several points side by side: T holds a component of each. Reads as Vec3 does and does the same operations
/// in the same order in every lane, so that formulas written for both give the same bits.
template <class T>
struct LaneVector {
  using Scalar = T;
  T component[3];

  [[nodiscard]] T& operator[](std::size_t axis) { return component[axis]; }
  [[nodiscard]] const T& operator[](std::size_t axis) const { return component[axis]; }

  LaneVector& operator+=(const LaneVector& other) { return *this = *this + other; }
  LaneVector& operator-=(const LaneVector& other) { return *this = *this - other; }
  LaneVector& operator*=(const T& factor) { return *this = factor * *this; }
  friend LaneVector operator+(const LaneVector& a, const LaneVector& b) {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
  }
  friend LaneVector operator-(const LaneVector& a, const LaneVector& b) {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
  }
  friend LaneVector operator-(const LaneVector& a) { return {{-a[0], -a[1], -a[2]}}; }
  friend LaneVector operator*(const T& factor, const LaneVector& a) {
    return {{factor * a[0], factor * a[1], factor * a[2]}};
  }
  friend LaneVector operator/(const LaneVector& a, const T& divisor) {
    return {{a[0] / divisor, a[1] / divisor, a[2] / divisor}};
  }

  [[nodiscard]] T dot(const LaneVector& b) const {
    return component[0] * b[0] + component[1] * b[1] + component[2] * b[2];
  }
  [[nodiscard]] T squaredNorm() const { return dot(*this); }
  [[nodiscard]] T norm() const {
    using std::sqrt;
    return sqrt(squaredNorm());
  }
  [[nodiscard]] LaneVector cross(const LaneVector& b) const {
    const LaneVector& a = *this;
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }
};

/// Vectors over a number type: LaneVector, of doubles Vec3 (number_vector.hpp, which units of wider instruction sets
/// cannot include: Eigen demands FMA there, which changes the bits).
template <class T>
struct VectorOver {
  using Type = LaneVector<T>;
};
template <>
struct VectorOver<double>;
template <class T>
using VectorOf = typename VectorOver<T>::Type;

}  // namespace breccia
