#include "parallel/domain_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/extent.hpp"
#include "base/index.hpp"
#include "base/types.hpp"
#include "parallel/exchange_schedule.hpp"

namespace breccia {
namespace {

Extent box_of(const Mesh& mesh, std::size_t element) {
  Extent box;
  for (const Index node : mesh.elements[element]) box.add(mesh.nodes[at(node)]);
  return box;
}

/// Domains whose boxes may be within a distance of an element, by cell of a grid.
class NearDomains {
 public:
  NearDomains(const std::vector<Extent>& boxes, const Extent& all, double distance) : lower_(all.lower) {
    const double cells = std::clamp(std::cbrt(8.0 * static_cast<double>(boxes.size())), 1.0, 64.0);
    for (std::size_t i = 0; i < 3; ++i) {
      n_[i] = static_cast<int>(cells);
      const double edge = all.upper[static_cast<int>(i)] - all.lower[static_cast<int>(i)];
      inverse_[static_cast<int>(i)] = edge > 0 ? n_[i] / edge : 0.0;
    }
    domains_.resize(at(n_[0]) * at(n_[1]) * at(n_[2]));
    for (std::size_t d = 0; d < boxes.size(); ++d) {
      if (boxes[d].empty()) continue;
      const auto first = cell(boxes[d].lower - Vec3::Constant(distance)),
                 last = cell(boxes[d].upper + Vec3::Constant(distance));
      for (int z = first[2]; z <= last[2]; ++z) {
        for (int y = first[1]; y <= last[1]; ++y) {
          for (int x = first[0]; x <= last[0]; ++x) domains_[place({x, y, z})].push_back(static_cast<int>(d));
        }
      }
    }
  }

  [[nodiscard]] const std::vector<int>& of(const Vec3& x) const { return domains_[place(cell(x))]; }

 private:
  using Cell = std::array<int, 3>;

  [[nodiscard]] Cell cell(const Vec3& x) const {
    Cell c{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = (x[static_cast<int>(i)] - lower_[static_cast<int>(i)]) * inverse_[static_cast<int>(i)];
      c[i] = static_cast<int>(std::clamp(share, 0.0, n_[i] - 1.0));
    }
    return c;
  }
  [[nodiscard]] std::size_t place(const Cell& c) const {
    return (at(c[2]) * at(n_[1]) + at(c[1])) * at(n_[0]) + at(c[0]);
  }

  std::array<int, 3> n_{};
  Vec3 lower_, inverse_;
  std::vector<std::vector<int>> domains_;
};

class Counter {
 public:
  Counter(const Mesh& mesh, const Topology& topology, std::span<const Index> node_sets, std::span<const int> owner,
          int parts)
      : mesh_(mesh), topology_(topology), node_sets_(node_sets), owner_(owner), from_(at(parts)) {
    report_.domains.resize(at(parts));
  }

  DomainReport run(std::span<const double> reach) {
    find_sharers();
    for (std::size_t e = 0; e < owner_.size(); ++e) count_element(e);
    count_held(reach);
    predict();
    return std::move(report_);
  }

 private:
  [[nodiscard]] Index node_set(std::size_t e) const { return node_sets_[at(mesh_.element_group[e])]; }
  [[nodiscard]] bool has_own_nodes(std::size_t e) const { return node_set(e) < 0; }
  [[nodiscard]] bool share_nodes(std::size_t e, std::size_t other) const {
    return !has_own_nodes(e) && node_set(e) == node_set(other);
  }

  /// Place of an element's node in first_.
  [[nodiscard]] std::size_t shared_node(std::size_t e, Index node) const {
    return at(node_set(e)) * mesh_.nodes.size() + at(node);
  }

  /// Domains whose bodies without joints meet at a node.
  void find_sharers() {
    const auto last = std::max_element(node_sets_.begin(), node_sets_.end());
    if (last == node_sets_.end() || *last < 0) return;
    first_.assign(mesh_.nodes.size() * at(*last + 1), -1);
    for (std::size_t e = 0; e < owner_.size(); ++e) {
      if (has_own_nodes(e)) continue;
      for (const Index node : mesh_.elements[e]) {
        int& first = first_[shared_node(e, node)];
        if (first < 0) first = owner_[e];
        if (first == owner_[e]) continue;
        std::vector<int>& others = others_[shared_node(e, node)];
        if (std::find(others.begin(), others.end(), owner_[e]) == others.end()) others.push_back(owner_[e]);
      }
    }
  }

  void count_element(std::size_t e) {
    DomainLoad& own = report_.domains[at(owner_[e])];
    ++own.elements;
    takers_.clear();
    for (const FaceLink& link : topology_.links[e]) {
      if (!link.inner()) continue;
      const std::size_t other = at(link.neighbour);
      const bool joint = !share_nodes(e, other), cut = owner_[other] != owner_[e];
      own.joints += joint && e < other;
      own.shared += joint && cut;
      own.cut_faces += cut;
      if (joint && cut) take(owner_[other]);
    }
    if (!has_own_nodes(e)) {
      for (const Index node : mesh_.elements[e]) {
        const std::size_t shared = shared_node(e, node);
        const auto others = others_.find(shared);
        if (others == others_.end()) continue;
        if (first_[shared] != owner_[e]) take(first_[shared]);
        for (const int domain : others->second) {
          if (domain != owner_[e]) take(domain);
        }
      }
    }
    for (const int domain : takers_) {
      ++report_.domains[at(domain)].gathered;
      std::vector<int>& from = from_[at(domain)];
      if (std::find(from.begin(), from.end(), owner_[e]) == from.end()) from.push_back(owner_[e]);
    }
  }

  /// Notes that a domain gathers the present element, once.
  void take(int domain) {
    if (std::find(takers_.begin(), takers_.end(), domain) == takers_.end()) takers_.push_back(domain);
  }

  void count_held(std::span<const double> reach) {
    std::vector<Extent> boxes(report_.domains.size());
    Extent all;
    double furthest = 0;
    for (std::size_t e = 0; e < owner_.size(); ++e) {
      const Extent box = box_of(mesh_, e);
      boxes[at(owner_[e])].add(box);
      all.add(box);
      furthest = std::max(furthest, reach[e] + (box.upper - box.lower).maxCoeff());
    }
    const NearDomains near(boxes, all, furthest);
    for (std::size_t e = 0; e < owner_.size(); ++e) {
      const Extent box = box_of(mesh_, e);
      for (const int domain : near.of(box.lower)) {
        if (domain != owner_[e] && box.near(boxes[at(domain)], reach[e])) ++report_.domains[at(domain)].held;
      }
    }
  }

  void predict() {
    const double parts = static_cast<double>(report_.domains.size()), mean = static_cast<double>(owner_.size()) / parts;
    double most = 0, slowest = 0;
    std::vector<RankPair> pairs;
    for (std::size_t d = 0; d < report_.domains.size(); ++d) {
      DomainLoad& load = report_.domains[d];
      load.neighbours = static_cast<int>(from_[d].size());
      for (const int other : from_[d])
        pairs.push_back({std::min(other, static_cast<int>(d)), std::max(other, static_cast<int>(d))});
      load.step = kSecondsAnElement * static_cast<double>(load.elements) + kSecondsAMessage * load.neighbours +
                  static_cast<double>(load.bytes()) / kBytesASecond;
      most = std::max(most, static_cast<double>(load.elements));
      slowest = std::max(slowest, load.step);
    }
    report_.exchange_steps = static_cast<int>(exchange_schedule(std::move(pairs)).size());
    report_.imbalance = most / mean;
    report_.efficiency = kSecondsAnElement * mean / slowest;
  }

  const Mesh& mesh_;
  const Topology& topology_;
  std::span<const Index> node_sets_;
  std::span<const int> owner_;
  std::vector<int> first_;                          ///< [set][node] a domain with the shared node, -1: none
  std::map<std::size_t, std::vector<int>> others_;  ///< by place in first_, further ones
  std::vector<std::vector<int>> from_;              ///< (domains) whom it gathers from
  std::vector<int> takers_;                         ///< of the present element
  DomainReport report_;
};

}  // namespace

DomainReport report_domains(const Mesh& mesh, const Topology& topology, std::span<const Index> node_sets,
                            std::span<const int> owner, int parts, std::span<const double> reach) {
  return Counter(mesh, topology, node_sets, owner, parts).run(reach);
}

}  // namespace breccia
