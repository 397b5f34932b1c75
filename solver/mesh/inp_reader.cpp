#include "mesh/inp_reader.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/index.hpp"
#include "mesh/inp_lines.hpp"
#include "mesh/inp_parser.hpp"
#include "mesh/set_mesh.hpp"

namespace breccia {
namespace {

constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};  // S1 to S4

/// A part where an instance puts it.
struct Placed {
  std::string name;
  const inp::Part* part = nullptr;
  std::unordered_map<std::int64_t, Index> node_of, element_of;        ///< by label
  std::map<std::string, std::vector<Index>> node_sets, element_sets;  ///< by name in small letters
};

class Assembly {
 public:
  Assembly(inp::Model model, const std::filesystem::path& file) : model_(std::move(model)), file_(file) {}

  SetMesh make() {
    place_all();
    for (Placed& placed : placed_) read_sets(placed);
    if (!problems_.empty()) throw InputError(std::move(problems_));
    made_.higher_order = model_.higher_order;
    made_.notes = model_.notes;
    return std::move(made_);
  }

 private:
  void refuse(int line, const std::string& key, const std::string& what, const std::string& given) {
    if (problems_.size() < kProblemsNamed) problems_.push_back({file_.string(), line, key, what, "", given});
  }

  // --- Instances
  // -------------------------------------------------------------------------------------------------

  void place_all() {
    if (model_.instances.empty())  // parts without an assembly: each is there once
      for (std::size_t p = 1; p < model_.parts.size(); ++p)
        model_.instances.push_back(
            {model_.parts[p].name, model_.parts[p].name, Vec3::Zero(), false, Vec3::Zero(), Vec3::Zero(), 0, 0});
    several_ = model_.instances.size() > 1;
    for (const inp::Instance& instance : model_.instances) {
      const auto part = std::find_if(model_.parts.begin() + 1, model_.parts.end(), [&](const inp::Part& one) {
        return lower_case(one.name) == lower_case(instance.part);
      });
      if (part == model_.parts.end())
        refuse(instance.line, "*INSTANCE", "there is no *PART of this name", instance.part);
      else
        place(*part, instance);
    }
    place(model_.parts.front(), {});
  }

  void place(const inp::Part& part, const inp::Instance& instance) {
    Placed& placed = placed_.emplace_back();
    placed.name = instance.name;
    placed.part = &part;
    Eigen::AngleAxisd turn = Eigen::AngleAxisd::Identity();
    if (instance.turned && (instance.to - instance.from).norm() > 0)
      turn = Eigen::AngleAxisd(instance.degrees * std::numbers::pi / 180, (instance.to - instance.from).normalized());
    for (std::size_t n = 0; n < part.nodes.size(); ++n) {
      Vec3 x = part.nodes[n] + (instance.part.empty() ? Vec3(Vec3::Zero()) : instance.shift);
      if (instance.turned) x = instance.from + turn * (x - instance.from);
      if (!placed.node_of.emplace(part.node_labels[n], static_cast<Index>(made_.nodes.size())).second)
        refuse(0, "*NODE", "two nodes have one label", std::to_string(part.node_labels[n]));
      made_.nodes.push_back(x);
    }
    for (const inp::Element& element : part.elements) place(placed, element);
  }

  void place(Placed& placed, const inp::Element& element) {
    SetMesh::Element made{element.label, element.corners, {}};
    for (std::size_t c = 0; c < static_cast<std::size_t>(element.corners); ++c) {
      const auto found = placed.node_of.find(element.nodes[c]);
      if (found == placed.node_of.end())
        return refuse(element.line, "*ELEMENT",
                      "element " + std::to_string(element.label) + " has a node that the file does not have",
                      std::to_string(element.nodes[c]));
      made.nodes[c] = found->second;
    }
    if (!placed.element_of.emplace(element.label, static_cast<Index>(made_.elements.size())).second)
      refuse(element.line, "*ELEMENT", "two elements have one label", std::to_string(element.label));
    made_.elements.push_back(made);
  }

  // --- Sets
  // -------------------------------------------------------------------------------------------------

  void read_sets(Placed& placed) {
    for (const inp::Set& set : placed.part->sets) {
      SetMesh::Set made;
      made.name = (several_ && !placed.name.empty() ? placed.name + "." : "") + set.name;
      const std::string name = lower_case(set.name);
      for (const inp::Item& item : set.items) add(placed, set, item, made);
      auto& sections = placed.part->sections;
      made.material = set.kind == inp::Set::Kind::elements &&
                      std::any_of(sections.begin(), sections.end(),
                                  [&](const std::string& one) { return lower_case(one) == name; });
      const auto append = [](std::vector<Index>& to, const std::vector<Index>& from) {
        to.insert(to.end(), from.begin(), from.end());
      };
      if (set.kind == inp::Set::Kind::nodes) append(placed.node_sets[name], made.nodes);
      if (set.kind == inp::Set::Kind::elements) append(placed.element_sets[name], made.elements);
      // Names with this mark are those that Abaqus/CAE makes for itself.
      if (!set.name.starts_with('_') || made.material) made_.sets.push_back(std::move(made));
    }
  }

  /// Where a member is to be found: the instance that is named, or the set's own part.
  const Placed* owner(const Placed& placed, const inp::Set& set, const inp::Item& item) {
    if (item.instance.empty()) return &placed;
    for (const Placed& one : placed_)
      if (lower_case(one.name) == lower_case(item.instance)) return &one;
    refuse(set.line, set.name, "there is no *INSTANCE of this name", item.instance);
    return nullptr;
  }

  void add(const Placed& placed, const inp::Set& set, const inp::Item& item, SetMesh::Set& made) {
    const Placed* from = owner(placed, set, item);
    if (from == nullptr) return;
    // Before there were parts, or with a single one, members stand there without their instance.
    if (item.instance.empty() && placed.name.empty() && placed_.size() == 2 && !has(placed, set, item))
      from = &placed_.front();
    const bool of_nodes = set.kind == inp::Set::Kind::nodes || set.kind == inp::Set::Kind::node_surface;
    std::vector<Index> members;
    if (item.name.empty()) {
      const auto& known = of_nodes ? from->node_of : from->element_of;
      const auto found = known.find(item.label);
      if (found == known.end())
        return refuse(set.line, set.name,
                      std::string("has a ") + (of_nodes ? "node" : "tetrahedron, triangle or line") +
                          " that the file does not have",
                      std::to_string(item.label));
      members.push_back(found->second);
    } else if (const auto found = from->node_sets.find(lower_case(item.name));
               of_nodes && found != from->node_sets.end()) {
      members = found->second;
    } else if (const auto of = from->element_sets.find(lower_case(item.name)); of != from->element_sets.end()) {
      members = of->second;
      if (of_nodes) members = nodes_of(members);
    } else {
      return refuse(set.line, set.name, "has a set as a member that the file does not have before it", item.name);
    }
    if (of_nodes)
      made.nodes.insert(made.nodes.end(), members.begin(), members.end());
    else if (set.kind == inp::Set::Kind::elements)
      made.elements.insert(made.elements.end(), members.begin(), members.end());
    else
      for (const Index e : members) add_faces(e, item.face, made);
  }

  static bool has(const Placed& placed, const inp::Set& set, const inp::Item& item) {
    const bool of_nodes = set.kind == inp::Set::Kind::nodes || set.kind == inp::Set::Kind::node_surface;
    if (item.name.empty()) return (of_nodes ? placed.node_of : placed.element_of).count(item.label) != 0;
    return placed.node_sets.count(lower_case(item.name)) != 0 || placed.element_sets.count(lower_case(item.name)) != 0;
  }

  [[nodiscard]] std::vector<Index> nodes_of(const std::vector<Index>& elements) const {
    std::vector<Index> nodes;
    for (const Index e : elements) {
      const SetMesh::Element& element = made_.elements[at(e)];
      nodes.insert(nodes.end(), element.nodes.begin(), element.nodes.begin() + element.corners);
    }
    return nodes;
  }

  static std::array<Index, 3> face_of(const SetMesh::Element& element, std::size_t face) {
    const auto& corners = kFaces[face];
    return {element.nodes[corners[0]], element.nodes[corners[1]], element.nodes[corners[2]]};
  }

  void add_faces(Index e, int face, SetMesh::Set& made) {
    const SetMesh::Element& element = made_.elements[at(e)];
    if (element.corners == 3) made.faces.push_back({element.nodes[0], element.nodes[1], element.nodes[2]});
    if (element.corners != 4) return;
    for (std::size_t f = 0; f < 4; ++f)
      if (face == 0 ? is_free(face_of(element, f)) : static_cast<std::size_t>(face) == f + 1)
        made.faces.push_back(face_of(element, f));
  }

  /// A face of one tetrahedron only.
  bool is_free(std::array<Index, 3> face) {
    if (sides_.empty())
      for (const SetMesh::Element& element : made_.elements)
        for (std::size_t f = 0; f < 4 && element.corners == 4; ++f) {
          std::array<Index, 3> corners = face_of(element, f);
          std::sort(corners.begin(), corners.end());
          ++sides_[corners];
        }
    std::sort(face.begin(), face.end());
    return sides_[face] == 1;
  }

  inp::Model model_;
  std::filesystem::path file_;
  std::vector<Placed> placed_;
  bool several_ = false;
  SetMesh made_;
  std::map<std::array<Index, 3>, int> sides_;  ///< tetrahedra of each face
  std::vector<Problem> problems_;
};

}  // namespace

RawMesh read_inp(const std::filesystem::path& file, double scale) {
  return raw_mesh(Assembly(inp::parse(file), file).make(), file, scale);
}

}  // namespace breccia
