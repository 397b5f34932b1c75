#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace breccia {

/// Shape of one tetrahedron.
struct ElementQuality {
  double volume = 0;        ///< m3, signed
  double min_height = 0;    ///< m, over the four faces
  double max_height = 0;    ///< m
  double inradius = 0;      ///< m, 3 V / total face area
  double mean_edge = 0;     ///< m, mean of the six edges
  double min_dihedral = 0;  ///< rad, over the six edges; 1.231 for the regular tetrahedron
  double max_dihedral = 0;  ///< rad
  double radius_ratio = 0;  ///< 3 r_in / r_circumscribed: 1 for the regular tetrahedron, 0 for a flat one
};

/// @param corners  m, positively oriented, no two coinciding. O(1), throws nothing.
[[nodiscard]] ElementQuality element_quality(const std::array<Vec3, 4>& corners);

/// Distribution of one figure over the elements; the q-quantile is the smallest value that at least q of them do not
/// exceed.
struct Distribution {
  double min = 0, p01 = 0, p05 = 0, median = 0, p95 = 0, p99 = 0, max = 0, mean = 0;
};

/// Mean size of the elements of one group or body.
struct ElementSizes {
  std::string name;  ///< group; empty for a body
  Index elements = 0;
  double volume = 0;     ///< m3, of all
  double mean_edge = 0;  ///< m, mean over the elements of ElementQuality::mean_edge
};

struct QualityReport {
  Distribution volume, min_height, max_height, inradius, mean_edge, min_dihedral, max_dihedral, radius_ratio;
  std::array<std::int64_t, 10> ratio_bins{};  ///< elements by radius_ratio: bin i counts those from i/10 to (i+1)/10

  struct Worst {
    Index element;
    ElementQuality quality;
  };
  std::vector<Worst> worst;          ///< up to 20 elements of smallest radius_ratio, worst first, ties by index
  std::vector<ElementSizes> groups;  ///< by volume group
  std::vector<ElementSizes> bodies;  ///< by body
};

/// O(n log n) in the elements, throws nothing. @pre mesh is finished.
[[nodiscard]] QualityReport assess_quality(const Mesh& mesh);

/// Mean inradius of the elements of every body, m; the elements in their order.
[[nodiscard]] std::vector<double> mean_inradii(const Mesh& mesh);
/// Diagonal of the box around every body, m.
[[nodiscard]] std::vector<double> body_extents(const Mesh& mesh);

}  // namespace breccia
