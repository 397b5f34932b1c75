#include "parallel/whole_fragments.hpp"

#include <cstdint>

#include "base/extent.hpp"
#include "base/index.hpp"
#include "mesh/topology.hpp"

namespace breccia {
namespace {

/// Of a domain's elements: a cut misses its best place by half a fragment at most, 3 % of a domain.
constexpr double kSmall = 1.0 / 16;

}  // namespace

std::vector<Vec3> places_of_fragments(std::span<const Vec3> centroid, std::span<const std::array<Index, 4>> neighbours,
                                      double fair_share, double reach) {
  std::vector<Vec3> place(centroid.begin(), centroid.end());
  std::vector<std::uint8_t> seen(centroid.size(), 0);
  std::vector<Index> fragment;
  for (std::size_t first = 0; first < centroid.size(); ++first) {
    if (seen[first] != 0) continue;
    fragment.assign(1, static_cast<Index>(first));
    seen[first] = 1;
    bool here = true;
    Vec3 sum = Vec3::Zero();
    Extent extent;
    for (std::size_t k = 0; k < fragment.size(); ++k) {
      const std::size_t element = at(fragment[k]);
      sum += centroid[element];
      extent.add(centroid[element]);
      for (const Index neighbour : neighbours[element]) {
        here = here && neighbour != FaceLink::kBeyond;
        if (neighbour < 0 || seen[at(neighbour)] != 0) continue;
        seen[at(neighbour)] = 1;
        fragment.push_back(neighbour);
      }
    }
    const auto size = static_cast<double>(fragment.size());
    if (!here || size > kSmall * fair_share || (extent.upper - extent.lower).maxCoeff() > reach) continue;
    for (const Index element : fragment) place[at(element)] = sum / size;
  }
  return place;
}

}  // namespace breccia
