#include "domains/element_sizes.hpp"

#include <algorithm>

#include "base/exact_sum.hpp"
#include "mesh/geometry.hpp"
#include "parallel/totals.hpp"

namespace breccia {
namespace {

struct SizeAt {
  GlobalId vertex;
  double size;  ///< m
};

/// The vertices of all ranks, each kept by one of them in equal ranges of their ids.
class SharedVertices {
 public:
  /// @param vertices  of this rank's elements, ascending, each once
  SharedVertices(const Communicator& communicator, std::span<const GlobalId> vertices)
      : communicator_(communicator), vertices_(vertices) {
    if (communicator.size() == 1) return;
    const GlobalId last = communicator.max(vertices.empty() ? GlobalId{0} : vertices.back());
    range_ = last / communicator.size() + 1;
  }

  /// @param size  (vertices) m, of this rank; becomes the largest of all ranks. Collective.
  void raise(std::vector<double>& size) const {
    if (communicator_.size() == 1) return;
    const std::vector<Communicator::ListOf<SizeAt>> asked = communicator_.exchange(by_keeper(size));
    std::vector<SizeAt> kept;
    for (const auto& of_rank : asked) kept.insert(kept.end(), of_rank.entries.begin(), of_rank.entries.end());
    std::sort(kept.begin(), kept.end(), [](const SizeAt& a, const SizeAt& b) {
      return a.vertex != b.vertex ? a.vertex < b.vertex : a.size > b.size;
    });
    std::vector<Communicator::ListOf<SizeAt>> answers = asked;
    for (auto& of_rank : answers) {
      auto next = kept.cbegin();  // each list ascends
      for (SizeAt& entry : of_rank.entries) {
        next = std::lower_bound(next, kept.cend(), entry.vertex,
                                [](const SizeAt& at, GlobalId vertex) { return at.vertex < vertex; });
        entry.size = next->size;
      }
    }
    std::size_t i = 0;  // keepers of ascending ranges answer in ascending order
    for (const auto& of_rank : communicator_.exchange(answers)) {
      for (const SizeAt& entry : of_rank.entries) size[i++] = entry.size;
    }
  }

 private:
  [[nodiscard]] std::vector<Communicator::ListOf<SizeAt>> by_keeper(const std::vector<double>& size) const {
    std::vector<Communicator::ListOf<SizeAt>> lists;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const auto keeper = static_cast<int>(vertices_[i] / range_);
      if (lists.empty() || lists.back().rank != keeper) lists.push_back({keeper, {}});
      lists.back().entries.push_back({vertices_[i], size[i]});
    }
    return lists;
  }

  const Communicator& communicator_;
  std::span<const GlobalId> vertices_;
  GlobalId range_ = 1;  ///< ids a keeper
};

}  // namespace

std::vector<double> longest_edges(const Records& mine) {
  std::vector<double> lengths;
  lengths.reserve(mine.elements.size());
  for (const ElementRecord& element : mine.elements) {
    std::array<Vec3, 4> x;
    for (std::size_t c = 0; c < 4; ++c) x[c] = Vec3(element.position[c].data());
    lengths.push_back(geometry::longest_edge(x));
  }
  return lengths;
}

Sizes sizes_of_all(const Communicator& communicator, std::span<const double> size) {
  Sizes sizes;
  ExactSum sum;
  for (const double each : size) {
    sizes.largest = std::max(sizes.largest, each);
    sum.add(each);
  }
  sizes.largest = communicator.max(sizes.largest);
  const auto number = communicator.sum(static_cast<std::int64_t>(size.size()));
  if (number > 0) sizes.mean = totals(communicator, std::span(&sum, 1)).front() / static_cast<double>(number);
  return sizes;
}

std::vector<double> sizes_around(const Communicator& communicator, std::span<const std::array<GlobalId, 4>> vertices,
                                 std::vector<double> size, int rings) {
  std::vector<GlobalId> ids;
  for (const auto& corners : vertices) ids.insert(ids.end(), corners.begin(), corners.end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<std::array<std::size_t, 4>> places(vertices.size());
  for (std::size_t e = 0; e < vertices.size(); ++e) {
    for (std::size_t c = 0; c < 4; ++c)
      places[e][c] = static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), vertices[e][c]) - ids.begin());
  }
  const SharedVertices shared(communicator, ids);
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<double> largest(ids.size(), 0.0);
    for (std::size_t e = 0; e < size.size(); ++e) {
      for (const std::size_t place : places[e]) largest[place] = std::max(largest[place], size[e]);
    }
    shared.raise(largest);
    for (std::size_t e = 0; e < size.size(); ++e) {
      for (const std::size_t place : places[e]) size[e] = std::max(size[e], largest[place]);
    }
  }
  return size;
}

}  // namespace breccia
