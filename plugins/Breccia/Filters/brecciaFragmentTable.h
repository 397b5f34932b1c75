#ifndef brecciaFragmentTable_h
#define brecciaFragmentTable_h

#include <array>
#include <vector>

#include "brecciaConnectivity.h"
#include "brecciaData.h"

namespace breccia {

/// What is known of a fragment.
struct Fragment {
  vtkTypeInt64 id = 0;  ///< smallest id of its elements
  vtkTypeInt64 elements = 0;
  vtkTypeInt64 cracked = 0;                      ///< faces that a failed joint has laid bare
  double mass = 0;                               ///< kg
  double volume = 0;                             ///< m3, deformed
  double area = 0;                               ///< m2, of its surface, both sides of cracks inside included
  std::array<double, 3> centroid{}, velocity{};  ///< of the mass; of elements' centroids, mass-weighted
  std::array<double, 3>
      spin{};  ///< 1/s: I^-1 L of the elements' centroids; along axes about which these have no inertia, 0
  /// Ellipsoid of the same second moments of volume (semi-axes sqrt(5 eigenvalue / volume), longest first), and what
  /// its semi-axes must be multiplied with to hold all corners.
  std::array<double, 3> semi_axes{};
  std::array<std::array<double, 3>, 3> axes{};
  double bounding_factor = 1;

  double Diameter() const;    ///< m, of the sphere of the same volume
  double SieveSize() const;   ///< m, middle diameter of the ellipsoid of the same moments: what passes a square mesh
  double Sphericity() const;  ///< surface of that sphere over the own
  double Elongation() const { return semi_axes[0] > 0 ? semi_axes[1] / semi_axes[0] : 0; }
  double Flatness() const { return semi_axes[1] > 0 ? semi_axes[2] / semi_axes[1] : 0; }
};

/// All fragments of the model, ascending by id: the same on all ranks, and bitwise the same for any number of ranks.
/// Sums are made in integers of 2^-90 of the largest term of each kind, 128 bits wide, so that their order does not
/// matter. What is not finite makes the numbers of its fragment that depend on it no numbers (NaN).
/// The elements need the arrays mass, kg, and velocity (3) of their centroids, m/s: throws BadInput on all ranks where
/// they lack. Collective. O(elements + fragments of all ranks).
std::vector<Fragment> Tabulate(const Elements& elements, const Connectivity& connectivity, const Ranks& ranks);

}  // namespace breccia

#endif
