#include "mesh/corner_clusters.hpp"

#include <algorithm>

#include "base/index.hpp"

namespace breccia {
namespace {}  // namespace

CornerClusters::CornerClusters(const Mesh& mesh, const Topology& topology)
    : mesh_(&mesh),
      topology_(&topology),
      cluster_(mesh.elements.size()),
      broken_(mesh.elements.size(), 0),
      first_corner_(mesh.nodes.size() + 1, 0),
      corners_(4 * mesh.elements.size()) {
  for (const auto& corners : mesh.elements) {
    for (const Index node : corners) ++first_corner_[at(node) + 1];
  }
  for (std::size_t n = 1; n < first_corner_.size(); ++n) first_corner_[n] += first_corner_[n - 1];
  std::vector<Index> next(first_corner_.begin(), first_corner_.end() - 1);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (Index c = 0; c < 4; ++c) {
      cluster_[at(e)][at(c)] = 4 * e + c;
      corners_[at(next[at(mesh.elements[at(e)][at(c)])]++)] = 4 * e + c;
    }
  }
  std::vector<Index> changed;
  for (Index node = 0; node < mesh.num_nodes(); ++node) {
    changed.clear();
    cluster_corners_at(node, changed);
  }
}

std::span<const Index> CornerClusters::corners_at(Index node) const {
  const auto first = at(first_corner_[at(node)]), last = at(first_corner_[at(node) + 1]);
  return std::span(corners_).subspan(first, last - first);
}

void CornerClusters::break_face(Index element, int face, std::vector<Index>& changed) {
  const Topology::Face one{element, face};
  break_faces(std::span(&one, 1), changed);
}

void CornerClusters::break_faces(std::span<const Topology::Face> faces, std::vector<Index>& changed) {
  changed.clear();
  nodes_.clear();
  for (const auto& [element, face] : faces) {
    const FaceLink& link = topology_->links[at(element)][at(face)];
    if (link.free() || broken(element, face)) continue;
    broken_[at(element)] |= static_cast<std::uint8_t>(1u << face);
    if (link.inner()) broken_[at(link.neighbour)] |= static_cast<std::uint8_t>(1u << link.face());
    for (const int corner : kFaceCorners[at(face)]) nodes_.push_back(mesh_->elements[at(element)][at(corner)]);
  }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  for (const Index node : nodes_) cluster_corners_at(node, changed);
  std::sort(changed.begin(), changed.end());
}

void CornerClusters::cluster_corners_at(Index node, std::vector<Index>& changed) {
  const auto corners = corners_at(node);
  places_.reset(corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Index element = corners[k] / 4, own_corner = corners[k] % 4;
    for (int face = 0; face < 4; ++face) {
      const FaceLink& link = topology_->links[at(element)][at(face)];
      // The face opposite to the corner does not touch the node; every bond is met from its higher element.
      if (face == own_corner || link.neighbour >= element || !link.inner() || broken(element, face)) continue;
      const auto twin = std::lower_bound(corners.begin(), corners.end(), 4 * link.neighbour);
      places_.join(static_cast<Index>(k), static_cast<Index>(twin - corners.begin()));
    }
  }
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Index id = corners[at(places_.root(static_cast<Index>(k)))];
    Index& stored = cluster_[at(corners[k] / 4)][at(corners[k] % 4)];
    if (stored == id) continue;
    stored = id;
    changed.push_back(corners[k]);
  }
}

bool CornerClusters::bonded(Index element_a, Index element_b) const {
  const auto& a = cluster_[at(element_a)];
  const auto& b = cluster_[at(element_b)];
  bool common = false;  // no branches: most pairs of a search are tested here
  for (const Index id : a) {
    for (const Index other : b) common |= id == other;
  }
  return common;
}

}  // namespace breccia
