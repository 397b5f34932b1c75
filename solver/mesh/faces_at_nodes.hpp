#pragma once

#include <span>
#include <vector>

#include "base/index.hpp"
#include "mesh/free_faces.hpp"
#include "mesh/mesh.hpp"

namespace breccia {

/// Free faces around every node of a mesh, as rows of one array.
class FacesAtNodes {
 public:
  /// O(nodes + faces)
  FacesAtNodes(const Mesh& mesh, std::span<const FreeFace> faces) : first_(mesh.nodes.size() + 1, 0) {
    for (const FreeFace& face : faces) {
      for (const Index node : face) ++first_[at(node) + 1];
    }
    for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    faces_.resize(at(first_.back()));
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (const Index node : faces[f]) faces_[at(next[at(node)]++)] = static_cast<Index>(f);
    }
  }
  /// Ascending.
  [[nodiscard]] std::span<const Index> at_node(Index node) const {
    return std::span(faces_).subspan(at(first_[at(node)]), at(first_[at(node) + 1] - first_[at(node)]));
  }

 private:
  std::vector<Index> first_, faces_;
};

}  // namespace breccia
