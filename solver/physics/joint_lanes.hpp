#pragma once

// Arithmetic of the joint kernel, for T = double and for T = std::experimental::simd<double, ...>, lane by lane: the
// same operations in the same order for every T, hence the same bits. No function here is compiled for a plain type in
// a unit of a wider instruction set (reason: sweep_kernel.hpp): all are templates over T.

#include <array>
#include <cmath>
#include <cstddef>

#include "physics/elasticity.hpp"
#include "physics/lanes.hpp"

namespace breccia::joint_point {

using elasticity::greater;
using elasticity::lesser;
using elasticity::select;
using elasticity::Vector;
using lanes::all;
using lanes::any;
using lanes::Mask;

template <class T>
[[nodiscard]] inline T root(const T& x) {
  using std::sqrt;
  return sqrt(x);
}
template <class T>
[[nodiscard]] inline T dot(const Vector<T>& a, const Vector<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
[[nodiscard]] inline Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
[[nodiscard]] inline Vector<T> plus(const Vector<T>& a, const Vector<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
[[nodiscard]] inline Vector<T> minus(const Vector<T>& a, const Vector<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
[[nodiscard]] inline Vector<T> times(const T& factor, const Vector<T>& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
template <class T>
[[nodiscard]] inline Vector<T> select3(const Mask<T>& mask, const Vector<T>& a, const Vector<T>& b) {
  return {select(mask, a[0], b[0]), select(mask, a[1], b[1]), select(mask, a[2], b[2])};
}

}  // namespace breccia::joint_point
