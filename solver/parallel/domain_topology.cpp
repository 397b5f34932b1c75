#include "parallel/domain_topology.hpp"

#include <algorithm>
#include <limits>

namespace breccia {

std::vector<int> assign_domains(const Communicator& communicator, const DomainSpec&, int parts, std::span<const Vec3> centroid,
                                std::span<const double>) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& x : centroid) {
    low = std::min(low, x[0]);
    high = std::max(high, x[0]);
  }
  low = communicator.min(low);
  high = communicator.max(high);
  std::vector<int> owner;
  for (const Vec3& x : centroid) {
    const double share = (x[0] - low) / std::max(high - low, 1e-300);
    owner.push_back(std::min(parts - 1, static_cast<int>(share * parts)));
  }
  return owner;
}

}  // namespace breccia
