#include "model/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "case/problem_at.hpp"
#include "model/memory_demand.hpp"
#include "model/model_joints.hpp"
#include "model/nodal_loads.hpp"
#include "model/node_sets.hpp"
#include "model/parameters.hpp"
#include "model/surfaces_to_break.hpp"
#include "model/torn_faces.hpp"
#include "system/interruption.hpp"

namespace breccia {
namespace {

void take_materials(const case_::Case& input, Model& model) {
  const std::size_t groups = model.mesh.volume_groups.size();
  model.elastic.resize(groups);
  model.density.resize(groups);
  model.discretisation = discretisations(input, model.mesh.volume_groups);
  model.breakable.resize(groups);
  for (std::size_t g = 0; g < groups; ++g) {
    const case_::Material& material = material_in(input, model.mesh.volume_groups[g]);
    model.elastic[g] = elastic_params(material);
    model.density[g] = material.density;
    model.breakable[g] = material.joints == case_::JointPlacement::breakable;
  }
}

/// Faces of these surfaces, both sides, ascending.
std::vector<std::pair<Index, int>> faces_of(const std::vector<std::string>& surfaces, const Mesh& mesh,
                                            const Topology& topology) {
  std::vector<std::pair<Index, int>> faces;
  for (const std::string& name : surfaces) {
    for (const Topology::Face& f : topology.surface_groups[at(group_index(mesh.surface_groups, name))]) {
      faces.emplace_back(f.element, f.face);
      const FaceLink& link = topology.links[at(f.element)][at(f.face)];
      if (link.inner()) faces.emplace_back(link.neighbour, link.face());
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// Cuts the links of broken faces. Elements that share nodes cannot be parted: refused.
void break_initial(const case_::Case& input, Model& model) {
  for (const auto& [element, face] : faces_of(input.broken_surfaces, model.mesh, model.topology)) {
    FaceLink& link = model.topology.links[at(element)][at(face)];
    if (link.free()) continue;
    const Index group = model.mesh.element_group[at(element)];
    const Index other = model.mesh.element_group[at(link.neighbour)];
    if (share_nodes(model.discretisation, model.whole.node_sets, group, other)) {
      throw InputError(case_::problem_at(input, input.broken_origin, "broken",
                                         "a surface cuts through \"" + model.mesh.volume_groups[at(group)] +
                                             "\", whose elements share nodes: there are no joints to break",
                                         "surfaces inside groups with joints = \"breakable\" or \"unbreakable\"", ""));
    }
    link = FaceLink{};
  }
}

void take_contact(const case_::Case& input, Model& model) {
  model.plane = plane_model(input);
  model.contact = contact_params(input, model.mesh.volume_groups);
  model.has_contact =
      model.contact.sphere.has_value() || std::any_of(model.contact.laws.begin(), model.contact.laws.end(),
                                                      [](const ContactLaw& law) { return law.active(); });
  model.contact_everywhere = input.contact_points.everywhere;
  for (const std::string& name : input.contact_points.surfaces) {
    const auto& faces = model.topology.surface_groups[at(group_index(model.mesh.surface_groups, name))];
    model.contact_faces.insert(model.contact_faces.end(), faces.begin(), faces.end());
  }
}

/// Corners of elements that belong to a surface: those of its faces, and those connected to them around the same node
/// through faces that no stage breaks. What lies across a notch, open from the start or opened by a stage, belongs to
/// it with faces of its own only.
class SurfaceCorners {
 public:
  SurfaceCorners(const std::vector<std::string>& cut, const Mesh& mesh, const Topology& topology)
      : mesh_(mesh), topology_(topology), cut_(mesh.elements.size(), 0), corners_(mesh.elements.size(), 0) {
    for (const auto& [element, face] : faces_of(cut, mesh, topology))
      cut_[at(element)] |= static_cast<std::uint8_t>(1U << face);
  }
  /// Tags of a surface group. O(elements at the surface), however many there are in all.
  void append_tags(Index group, std::vector<CornerTag>& tags) {
    for (const Topology::Face& face : topology_.surface_groups[at(group)]) {
      for (const int corner : kFaceCorners[at(face.face)]) mark(face.element, corner);
    }
    while (!open_.empty()) {
      const auto [element, corner] = open_.back();
      open_.pop_back();
      spread(element, corner);
    }
    for (const Index e : marked_) tags.push_back({mesh_.element_id(e), group, std::exchange(corners_[at(e)], {})});
    marked_.clear();
  }

 private:
  void mark(Index element, int corner) {
    const auto bit = static_cast<std::uint8_t>(1U << corner);
    if ((corners_[at(element)] & bit) != 0) return;
    if (corners_[at(element)] == 0) marked_.push_back(element);
    corners_[at(element)] |= bit;
    open_.emplace_back(element, corner);
  }
  /// To the neighbours through the three faces that meet at the corner.
  void spread(Index element, int corner) {
    const Index node = mesh_.elements[at(element)][at(corner)];
    for (int face = 0; face < 4; ++face) {
      const FaceLink& link = topology_.links[at(element)][at(face)];
      if (face == corner || !link.inner() || (cut_[at(element)] >> face & 1) != 0) continue;
      const auto& nodes = mesh_.elements[at(link.neighbour)];
      mark(link.neighbour, static_cast<int>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin()));
    }
  }

  const Mesh& mesh_;
  const Topology& topology_;
  std::vector<std::uint8_t> cut_;      ///< (elements) a bit a face that a stage breaks
  std::vector<std::uint8_t> corners_;  ///< (elements) a bit a corner, of the present group
  std::vector<Index> marked_;          ///< elements with such a bit
  std::vector<std::pair<Index, int>> open_;
};

/// What is known of the model as a whole before its joints are.
void take_whole(const case_::Case& input, Model& model) {
  std::vector<double> lambda_2mu;
  for (const ElasticParams& p : model.elastic) lambda_2mu.push_back(p.lambda + 2 * p.mu);
  model.whole = whole_of(input, model.mesh, lambda_2mu, model.density);
  model.whole.node_sets = node_sets(input, model.mesh, model.topology, model.discretisation);
}

/// Tags of the node groups, O(elements).
void append_node_tags(const Mesh& mesh, std::vector<CornerTag>& tags) {
  std::unordered_multimap<Index, Index> groups_of;
  for (const Mesh::GroupNode& one : mesh.group_nodes) groups_of.emplace(one.node, one.group);
  if (groups_of.empty()) return;
  std::map<Index, std::uint8_t> corners_by_group;  // of an element
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    corners_by_group.clear();
    for (std::size_t c = 0; c < 4; ++c) {
      const auto [first, last] = groups_of.equal_range(mesh.elements[at(e)][c]);
      for (auto entry = first; entry != last; ++entry)
        corners_by_group[entry->second] |= static_cast<std::uint8_t>(1U << c);
    }
    for (const auto& [group, corners] : corners_by_group)
      tags.push_back({mesh.element_id(e), static_cast<Index>(mesh.surface_groups.size()) + group, corners});
  }
}

}  // namespace

namespace {

/// Tags of the element sets: all corners of their elements.
void append_set_tags(const Mesh& mesh, std::vector<CornerTag>& tags) {
  constexpr std::uint8_t kAll = 15;
  const auto first = static_cast<Index>(mesh.surface_groups.size() + mesh.node_groups.size());
  for (const Mesh::SetElement& one : mesh.set_elements)
    tags.push_back({mesh.element_id(one.element), first + one.group, kAll});
}

}  // namespace

std::vector<CornerTag> tag_corners(const std::vector<std::string>& cut, const Mesh& mesh, const Topology& topology) {
  SurfaceCorners corners(cut, mesh, topology);
  std::vector<CornerTag> tags;
  for (std::size_t g = 0; g < mesh.surface_groups.size(); ++g) corners.append_tags(static_cast<Index>(g), tags);
  append_node_tags(mesh, tags);
  append_set_tags(mesh, tags);
  std::sort(tags.begin(), tags.end(), [](const CornerTag& p, const CornerTag& q) { return p.comes_before(q); });
  return tags;
}

void check_laws(const case_::Case& input, const WholeModel& whole) {
  Model model;
  model.mesh.volume_groups = whole.volume_groups;
  model.whole = whole;
  std::vector<Problem> problems =
      joints_without_effect(input, whole.volume_groups, discretisations(input, whole.volume_groups), whole.node_sets);
  for (const WholeModel::JointGroups& groups : whole.joint_groups) {
    if (auto problem = wrong_joint_law(input, whole.volume_groups, groups)) problems.push_back(std::move(*problem));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  take_materials(input, model);
  take_joint_laws(input, model);
}

Model build_bare_model(const case_::Case& input) {
  Model model;
  FinishedMesh made = build_mesh(input);
  model.mesh = std::move(made.mesh);
  model.mesh_report = std::move(made.report);
  give_up_if_interrupted();
  model.topology = build_topology(model.mesh);
  give_up_if_interrupted();
  check_layer(input, model.mesh, model.topology);
  take_materials(input, model);
  give_up_if_interrupted();
  take_whole(input, model);
  give_up_if_interrupted();
  take_contact(input, model);
  break_initial(input, model);
  model.whole.cut = surfaces_to_break(input);
  model.corner_tags = tag_corners(model.whole.cut, model.mesh, model.topology);
  give_up_if_interrupted();
  model.whole.group_sizes = group_sizes(model);
  model.torn = torn_faces(model.mesh, model.topology);
  give_up_if_interrupted();
  find_joint_groups(input, model);
  give_up_if_interrupted();
  take_joint_laws(input, model);
  return model;
}

Model build_model(const case_::Case& input) {
  Model model = build_bare_model(input);
  demand_memory(input, model.mesh.num_elements(), model_bytes(model));
  give_up_if_interrupted();
  take_joints(input, model);
  give_up_if_interrupted();
  model.local = build_local_mesh(model.mesh, model.discretisation, model.density, {}, model.whole.node_sets);
  return model;
}

Model build_piece(const case_::Case& input, WholeModel whole, Mesh mesh, Topology topology,
                  const std::vector<std::uint8_t>& original, std::vector<CornerTag> corner_tags,
                  std::vector<std::uint8_t> torn) {
  Model model;
  model.mesh = std::move(mesh);
  model.topology = std::move(topology);
  model.whole = std::move(whole);
  model.corner_tags = std::move(corner_tags);
  model.torn = std::move(torn);
  take_materials(input, model);
  take_contact(input, model);
  take_joint_laws(input, model);
  take_joints(input, model);
  model.local = build_local_mesh(model.mesh, model.discretisation, model.density, original, model.whole.node_sets);
  return model;
}

bool starts_intact(const Model& model, const ModelJoint& joint) {
  const LocalMesh& local = model.local;
  return model.joint_laws[at(joint.law)].screen_limit() > 0 &&
         local.slot_of_element[at(joint.face.a)] < local.num_own_slots &&
         local.slot_of_element[at(joint.face.b)] < local.num_own_slots;
}

JointLinks build_links(const Model& model) {
  const LocalMesh& local = model.local;
  JointLinks links;
  links.reset(local.num_own_slots);
  for (const ModelJoint& joint : model.joints) {
    if (!starts_intact(model, joint)) continue;
    const JointLawParams& law = model.joint_laws[at(joint.law)];
    const Index a = local.slot_of_element[at(joint.face.a)], b = local.slot_of_element[at(joint.face.b)];
    const int face_b = joint.face.code / 3;
    links.attach(a, joint.face.face_a, b, joint.face.code);
    const double stiffness = corner_stiffness(law, joint.face.area);
    links.stiffness[JointLinks::at(a, joint.face.face_a)] = stiffness;
    links.stiffness[JointLinks::at(b, face_b)] = stiffness;
    for (const Index slot : {a, b}) {
      double& limit = links.limit[at(slot)];
      limit = std::min(limit, law.screen_limit());
    }
  }
  return links;
}

}  // namespace breccia
