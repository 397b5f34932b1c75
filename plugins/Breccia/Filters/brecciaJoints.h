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
/// The jump is the opening along the normal; see SetJump. Collective.
std::vector<FailedJoint> AllFailed(const Cracks& cracks, bool with_energy, const Ranks& ranks);

/// J dissipated in joints that are damaged and hold; alike on any number of ranks. Collective.
double EnergyOfDamage(const Cracks& cracks, const Ranks& ranks);

/// Where the two faces of a joint are.
struct FacePair {
  bool found = false;            ///< both elements are there
  std::array<double, 9> near{};  ///< m, corners of that of the element of lower id, outward sense
  Vector far{};                  ///< m, centroid of the other
};
/// The faces of joints in the elements, one after the other as in the list: alike on all ranks. Collective.
std::vector<FacePair> FacesOf(const Elements& elements, const Ranks& ranks, const std::vector<FailedJoint>& joints);

/// At `share` (0..1) of the way from one pair to the other; the one that is there where one is missing.
FacePair Between(const FacePair& from, const FacePair& to, double share);

/// The jump between the centroids of the faces; joints whose faces were not found stay.
void SetJump(const FacePair& faces, FailedJoint& joint);
/// The jump, and centre (halfway between the faces), normal and area as well.
void SetPlace(const FacePair& faces, FailedJoint& joint);

inline double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector Difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double Length(const Vector& a);

/// Eigenvalues, largest first, and unit eigenvectors of the symmetric matrix xx yy zz xy yz xz.
void EigenSystem(const std::array<double, 6>& m, Vector& values, std::array<Vector, 3>& vectors);

/// Area and area vector / 2 of a triangle given by nine numbers.
Vector AreaVector(const double* corners);

}  // namespace breccia

#endif
