#include "brecciaConnectivity.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace breccia {
namespace {

/// Disjoint sets, each with its first member as its root when all is joined by place.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), vtkIdType{0}); }
  vtkIdType Root(vtkIdType i) {
    auto* p = parent_.data();
    while (p[i] != i) i = p[i] = p[p[i]];
    return i;
  }
  void Join(vtkIdType a, vtkIdType b) {
    a = Root(a);
    b = Root(b);
    if (a != b) parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<vtkIdType> parent_;
};

/// A face between elements of two ranks, sent by the rank of the element of lower id.
struct Edge {
  vtkTypeInt64 low, high, broken;
};

/// An element with neighbours elsewhere, and what its rank calls its part.
struct Label {
  vtkTypeInt64 element, part;
  bool operator<(const Label& other) const { return element < other.element; }
};

std::size_t At(vtkIdType i) { return static_cast<std::size_t>(i); }

class Connector {
 public:
  Connector(const Elements& elements, const Ranks& ranks)
      : elements_(elements), ranks_(ranks), index_(elements.id), sets_(elements.id.size()) {
    result_.face.resize(elements.neighbour.size());
    for (std::size_t i = 0; i < result_.face.size(); ++i)
      result_.face[i] = elements.neighbour[i] >= 0 ? Connectivity::held : Connectivity::free_face;
  }

  void Break(const std::vector<vtkTypeInt64>& joints) {
    for (const vtkTypeInt64 joint : joints) {
      const vtkIdType a = index_.Find(joint / 4);
      if (a < 0 || elements_.neighbour[At(4 * a) + static_cast<std::size_t>(joint % 4)] < 0) continue;
      const std::size_t face = At(4 * a) + static_cast<std::size_t>(joint % 4);
      result_.face[face] = Connectivity::cracked;
      CrackOtherSide(elements_.neighbour[face], joint / 4);
    }
  }

  void JoinHere() {
    for (vtkIdType e = 0; e < elements_.Count(); ++e) {
      for (std::size_t f = At(4 * e); f < At(4 * e) + 4; ++f) {
        if (result_.face[f] == Connectivity::free_face) continue;
        const vtkIdType other = index_.Find(elements_.neighbour[f]);
        if (other < 0) {
          AddBorder(e, f);
        } else if (result_.face[f] == Connectivity::held) {
          sets_.Join(e, other);
        }
      }
    }
  }

  Connectivity Finish() {
    NamePartsHere();
    if (ranks_.Count() > 1) {
      JoinRanks();
    } else {
      for (const std::size_t face : outside_) result_.face[face] = Connectivity::free_face;
    }
    return std::move(result_);
  }

 private:
  void CrackOtherSide(vtkTypeInt64 element, vtkTypeInt64 seen_from) {
    const vtkIdType b = index_.Find(element);
    if (b < 0) return;
    for (std::size_t f = At(4 * b); f < At(4 * b) + 4; ++f) {
      if (elements_.neighbour[f] == seen_from) result_.face[f] = Connectivity::cracked;
    }
  }

  void AddBorder(vtkIdType element, std::size_t face) {
    outside_.push_back(face);
    border_.push_back(element);
    const vtkTypeInt64 here = elements_.id[At(element)], there = elements_.neighbour[face];
    if (here < there) edges_.push_back({here, there, result_.face[face] == Connectivity::cracked ? 1 : 0});
  }

  void NamePartsHere() {
    const std::size_t n = elements_.id.size();
    result_.fragment.resize(n);
    std::vector<vtkTypeInt64> lowest(elements_.id);
    for (std::size_t e = 0; e < n; ++e) {
      const std::size_t root = At(sets_.Root(static_cast<vtkIdType>(e)));
      lowest[root] = std::min(lowest[root], elements_.id[e]);
    }
    for (std::size_t e = 0; e < n; ++e) result_.fragment[e] = lowest[At(sets_.Root(static_cast<vtkIdType>(e)))];
  }

  void JoinRanks() {
    std::vector<Label> mine;
    for (const vtkIdType e : border_) mine.push_back({elements_.id[At(e)], result_.fragment[At(e)]});
    std::vector<Label> labels = ranks_.Gather(mine);
    std::sort(labels.begin(), labels.end());
    const std::vector<Edge> edges = ranks_.Gather(edges_);
    std::map<vtkTypeInt64, vtkTypeInt64> parent;
    const auto lowest = [&](vtkTypeInt64 part) {
      for (auto up = parent.find(part); up != parent.end(); up = parent.find(part)) part = up->second;
      return part;
    };
    for (const Edge& edge : edges) {
      const Label *low = FindLabel(labels, edge.low), *high = FindLabel(labels, edge.high);
      if (low == nullptr || high == nullptr || edge.broken != 0) continue;
      const vtkTypeInt64 a = lowest(low->part), b = lowest(high->part);
      if (a != b) parent[std::max(a, b)] = std::min(a, b);
    }
    for (vtkTypeInt64& part : result_.fragment) {
      if (!parent.empty()) part = lowest(part);
    }
    MarkBorders(labels, edges);
  }

  static const Label* FindLabel(const std::vector<Label>& labels, vtkTypeInt64 element) {
    const auto found = std::lower_bound(labels.begin(), labels.end(), Label{element, 0});
    return found != labels.end() && found->element == element ? &*found : nullptr;
  }

  /// Faces towards elements that are nowhere are free; those across which another rank knows of a crack are cracked.
  void MarkBorders(const std::vector<Label>& labels, const std::vector<Edge>& edges) {
    for (const std::size_t face : outside_) {
      if (!FindLabel(labels, elements_.neighbour[face])) result_.face[face] = Connectivity::free_face;
    }
    for (const Edge& edge : edges) {
      if (edge.broken != 0) CrackOtherSide(edge.high, edge.low);
    }
  }

  const Elements& elements_;
  const Ranks& ranks_;
  IdIndex index_;
  Sets sets_;
  Connectivity result_;
  std::vector<std::size_t> outside_;  ///< faces towards elements that are not here
  std::vector<vtkIdType> border_;     ///< their elements
  std::vector<Edge> edges_;
};

}  // namespace

Connectivity Connect(const Elements& elements, const std::vector<vtkTypeInt64>& broken, const Ranks& ranks) {
  Connector connector(elements, ranks);
  connector.Break(ranks.Gather(broken));
  connector.JoinHere();
  return connector.Finish();
}

}  // namespace breccia
