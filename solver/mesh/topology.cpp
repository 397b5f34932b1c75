#include "mesh/topology.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "mesh/node_parting.hpp"
#include "system/interruption.hpp"

namespace breccia {
namespace {

/// A face under its smallest node: the other two nodes, ascending, and whose face it is.
struct FaceEntry {
  Index middle, largest;
  Index element;
  std::int8_t face;

  [[nodiscard]] bool same_nodes(const FaceEntry& other) const {
    return middle == other.middle && largest == other.largest;
  }
  bool operator<(const FaceEntry& other) const {
    return std::tie(middle, largest, element, face) < std::tie(other.middle, other.largest, other.element, other.face);
  }
};

std::array<Index, 3> face_nodes(const Mesh& mesh, Index element, int face) {
  const auto& corners = mesh.elements[at(element)];
  const auto& f = kFaceCorners[at(face)];
  return {corners[at(f[0])], corners[at(f[1])], corners[at(f[2])]};
}

/// Every face of every element, grouped by its smallest node and sorted within the group.
class FaceTable {
 public:
  explicit FaceTable(const Mesh& mesh) : first_(mesh.nodes.size() + 1, 0), entries_(4 * mesh.elements.size()) {
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      for (int f = 0; f < 4; ++f) ++first_[at(sorted(face_nodes(mesh, e, f))[0]) + 1];
    }
    for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      for (int f = 0; f < 4; ++f) {
        const auto nodes = sorted(face_nodes(mesh, e, f));
        entries_[next[at(nodes[0])]++] = {nodes[1], nodes[2], e, static_cast<std::int8_t>(f)};
      }
    }
    for (std::size_t n = 0; n + 1 < first_.size(); ++n) {
      std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(first_[n]),
                entries_.begin() + static_cast<std::ptrdiff_t>(first_[n + 1]));
    }
  }

  using Iterator = std::vector<FaceEntry>::const_iterator;

  /// Calls visit(first, last) for every run of faces with the same three nodes.
  template <class Visit>
  void for_each_run(Visit visit) const {
    for (std::size_t n = 0; n + 1 < first_.size(); ++n) {
      for (Iterator run = begin(n); run != end(n);) {
        Iterator last = run + 1;
        while (last != end(n) && last->same_nodes(*run)) ++last;
        visit(run, last);
        run = last;
      }
    }
  }

  /// Faces with these nodes, given ascending.
  [[nodiscard]] std::pair<Iterator, Iterator> find(const std::array<Index, 3>& nodes) const {
    const FaceEntry wanted{nodes[1], nodes[2], -1, 0};
    const Iterator begin_of_run = std::lower_bound(begin(at(nodes[0])), end(at(nodes[0])), wanted);
    Iterator end_of_run = begin_of_run;
    while (end_of_run != end(at(nodes[0])) && end_of_run->same_nodes(wanted)) ++end_of_run;
    return {begin_of_run, end_of_run};
  }

 private:
  [[nodiscard]] Iterator begin(std::size_t n) const {
    return entries_.begin() + static_cast<std::ptrdiff_t>(first_[n]);
  }
  [[nodiscard]] Iterator end(std::size_t n) const { return begin(n + 1); }

  std::vector<std::size_t> first_;  // (num_nodes + 1)
  std::vector<FaceEntry> entries_;
};

/// Link from face `from` to face `to` of the same three nodes; code -1 when both list them with the same sense, that
/// is, when the two elements lie on the same side.
FaceLink link_between(const Mesh& mesh, const FaceEntry& from, const FaceEntry& to) {
  const auto own = face_nodes(mesh, from.element, from.face);
  const auto other = face_nodes(mesh, to.element, to.face);
  const auto rotation = static_cast<std::size_t>(std::find(other.begin(), other.end(), own[0]) - other.begin());
  const bool opposite = other[(rotation + 2) % 3] == own[1];
  return {to.element, static_cast<std::int8_t>(opposite ? 3 * to.face + static_cast<int>(rotation) : -1)};
}

std::string element_name(const Mesh& mesh, Index element) {
  return "element " + std::to_string(mesh.element_source_id[at(element)]);
}

std::vector<std::vector<Topology::Face>> find_surfaces(const Mesh& mesh, const FaceTable& table,
                                                       std::vector<Problem>& problems) {
  std::vector<std::vector<Topology::Face>> groups(mesh.surface_groups.size());
  std::vector<Index> strays(mesh.surface_groups.size(), 0);
  for (const auto& surface : mesh.surface_faces) {
    const auto [first, last] = table.find(sorted(surface.nodes));
    if (first == last) ++strays[at(surface.group)];
    for (auto entry = first; entry != last; ++entry) {
      groups[at(surface.group)].push_back({entry->element, entry->face});
    }
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto key = [](const Topology::Face& face) { return std::pair{face.element, face.face}; };
    std::sort(groups[g].begin(), groups[g].end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    groups[g].erase(
        std::unique(groups[g].begin(), groups[g].end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
        groups[g].end());
    if (strays[g] > 0) {
      problems.push_back({mesh.source, 0, "surface group \"" + mesh.surface_groups[g] + "\"", kStrayTriangles,
                          kFacesOfVolumes, std::to_string(strays[g]) + " such triangles"});
    }
  }
  return groups;
}

}  // namespace

Topology build_topology(const Mesh& mesh) {
  Topology topology;
  topology.links.resize(mesh.elements.size());
  const FaceTable table(mesh);
  give_up_if_interrupted();

  std::vector<Problem> problems;
  std::set<std::pair<Index, Index>> reported;  // two elements on the same four nodes share four faces: one line
  const auto report = [&](Index element, const std::string& what, const std::string& allowed, Index other) {
    if (problems.size() < kProblemsNamed && reported.insert(std::minmax(element, other)).second) {
      problems.push_back({mesh.source, 0, element_name(mesh, element), what, allowed, element_name(mesh, other)});
    }
  };
  table.for_each_run([&](FaceTable::Iterator first, FaceTable::Iterator last) {
    const auto sharing = last - first;
    if (sharing > 2) {
      report(first->element, "shares a face with more than one other element", "two elements a face",
             (last - 1)->element);
    } else if (sharing == 2) {
      const FaceEntry &a = *first, &b = *(first + 1);
      const FaceLink to_b = link_between(mesh, a, b), to_a = link_between(mesh, b, a);
      if (to_b.code < 0) {
        report(a.element, "lies on the same side of a shared face as another element", "elements that do not overlap",
               b.element);
        return;
      }
      topology.links[at(a.element)][at(a.face)] = to_b;
      topology.links[at(b.element)][at(b.face)] = to_a;
    }
  });
  topology.surface_groups = find_surfaces(mesh, table, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return topology;
}

GlobalId neighbour_id(const Mesh& mesh, const Topology& topology, Index element, int face) {
  const FaceLink& link = topology.links[at(element)][static_cast<std::size_t>(face)];
  if (link.free()) return -1;
  if (link.inner()) return mesh.element_id(link.neighbour);
  const auto found = std::lower_bound(
      topology.beyond.begin(), topology.beyond.end(), std::pair(element, face),
      [](const Topology::Beyond& b, const auto& key) { return std::pair(b.face.element, b.face.face) < key; });
  DEMAND(found != topology.beyond.end() && found->face.element == element && found->face.face == face,
         "element " + std::to_string(element) + " has no neighbour beyond");
  return found->neighbour;
}

}  // namespace breccia
