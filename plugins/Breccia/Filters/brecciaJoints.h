#ifndef brecciaJoints_h
#define brecciaJoints_h

#include <array>
#include <vector>

#include "brecciaData.h"

namespace breccia {

using Vector = std::array<double, 3>;

/// A failed joint.
struct FailedJoint {
  vtkTypeInt64 id = 0, mode = 0;
  double time = 0;     ///< s
  double area = 0;     ///< m2
  double energy = 0;   ///< J dissipated in modes I and II
  double opening = 0;  ///< m
  Vector centre{};     ///< m
  Vector normal{};     ///< unit, outward of the element of lower id
  Vector jump{};       ///< m, how far the other side has moved against this one
};

/// The failed joints of all ranks, ascending by id: alike on all of them. Needs the array energy where `with_energy`.
/// The jump is the opening along the normal; see SetJumps. Collective.
std::vector<FailedJoint> AllFailed(const Cracks& cracks, bool with_energy, const Ranks& ranks);

/// Sets the jumps to the distance between the centroids of the two faces, in the elements. Those of joints whose
/// elements are not there stay. Collective.
void SetJumps(const Elements& elements, const Ranks& ranks, std::vector<FailedJoint>& joints);

inline double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector Difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double Length(const Vector& a);

/// Eigenvalues, largest first, and unit eigenvectors of the symmetric matrix xx yy zz xy yz xz.
void EigenSystem(const std::array<double, 6>& m, Vector& values, std::array<Vector, 3>& vectors);

/// Area and area vector / 2 of a triangle given by nine numbers.
Vector AreaVector(const double* corners);

}  // namespace breccia

#endif
