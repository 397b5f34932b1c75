#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace breccia {

/// Clusters of element corners still bonded around a mesh vertex.
///
/// Corner c of element e has the id 4 e + c. Two corners at the same node are bonded when their elements share a face
/// at that node that is not broken; a cluster is a set of corners connected so, and its id the smallest corner id in
/// it. It depends only on which faces are broken, not on the order in which they broke.
///
/// Memory: 16 B an element for the clusters, 1 B for the broken faces, 20 B for the corners by node.
class CornerClusters {
 public:
  /// All faces between two elements bonded. O(num_elements).
  /// @pre mesh and topology outlive this object and do not change.
  CornerClusters(const Mesh& mesh, const Topology& topology);

  /// Breaks a face between two elements; breaking it again or breaking a free face changes nothing.
  /// @param changed  out: ids of the corners whose cluster id changed, ascending; old content is dropped
  /// O(corners around the face's three nodes).
  void break_face(Index element, int face, std::vector<Index>& changed);

  /// The same for many faces at once; both sides of a face may be listed.
  void break_faces(std::span<const Topology::Face> faces, std::vector<Index>& changed);

  /// Cluster id of a corner.
  [[nodiscard]] Index cluster(Index element, int corner) const {
    return cluster_[static_cast<std::size_t>(element)][static_cast<std::size_t>(corner)];
  }

  /// True when two elements have a cluster in common; an element is bonded to itself.
  [[nodiscard]] bool bonded(Index element_a, Index element_b) const;

  /// Ids of the corners at a node, ascending, bonded or not.
  [[nodiscard]] std::span<const Index> corners_at(Index node) const;

  /// True when the face was broken by this object; free faces count as not broken.
  [[nodiscard]] bool broken(Index element, int face) const {
    return ((broken_[static_cast<std::size_t>(element)] >> face) & 1) != 0;
  }

 private:
  void cluster_corners_at(Index node, std::vector<Index>& changed);

  const Mesh* mesh_;
  const Topology* topology_;
  std::vector<std::array<Index, 4>> cluster_;  // (num_elements)
  std::vector<std::uint8_t> broken_;           // (num_elements) a bit a face
  std::vector<Index> first_corner_;            // (num_nodes + 1)
  std::vector<Index> corners_;                 // (4 num_elements) by node
  DisjointSets places_;                        // of corners at a node: work space
  std::vector<Index> nodes_;                   // work space
};

}  // namespace breccia
