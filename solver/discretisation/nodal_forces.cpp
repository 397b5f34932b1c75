#include "discretisation/nodal_forces.hpp"

#include <algorithm>

namespace breccia {

void NodalForces::clear() {
  // A block keeps its slot: what was touched once (a surface, a crack) tends to be touched again.
  std::fill(own_.begin(), own_.end(), 0.0);
  std::fill(shared_.begin(), shared_.end(), 0.0);
}

Vec3 NodalForces::get(Index node) const {
  if (node >= num_own_nodes_) return load_node(shared_.data(), node - num_own_nodes_);
  const double* p = block(node / (4 * kLanes));
  return p == nullptr ? Vec3::Zero() : load_node(p, node % (4 * kLanes));
}

Index NodalForces::take_slot(Index block) {
  const auto slot = static_cast<Index>(used_.size());
  used_.push_back(block);
  own_.resize(own_.size() + 96, 0.0);
  return slot;
}

}  // namespace breccia
