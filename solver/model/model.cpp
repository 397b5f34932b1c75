#include "model/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "model/parameters.hpp"
#include "physics/contact/contact_field.hpp"

namespace breccia {
namespace {

template <class T>
std::size_t index(T i) {
  return static_cast<std::size_t>(i);
}

Index group_named(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Index>(std::find(names.begin(), names.end(), name) - names.begin());
}

void take_materials(const case_::Case& input, Model& model) {
  const std::size_t groups = model.mesh.volume_groups.size();
  model.elastic.resize(groups);
  model.density.resize(groups);
  model.discretisation.resize(groups);
  model.breakable.resize(groups);
  for (const case_::Material& material : input.materials) {
    const std::size_t g = index(group_named(model.mesh.volume_groups, material.group));
    model.elastic[g] = elastic_params(material);
    model.density[g] = material.density;
    model.discretisation[g] =
        material.joints == case_::JointPlacement::none ? Discretisation::shared_nodes : Discretisation::own_nodes;
    model.breakable[g] = material.joints == case_::JointPlacement::breakable;
  }
}

/// Faces of the surfaces whose joints are broken from the start, both sides, ascending.
std::vector<std::pair<Index, int>> broken_faces(const case_::Case& input, const Model& model) {
  std::vector<std::pair<Index, int>> faces;
  for (const std::string& name : input.broken_surfaces) {
    for (const Topology::Face& f : model.topology.surface_groups[index(group_named(model.mesh.surface_groups, name))]) {
      faces.emplace_back(f.element, f.face);
      const FaceLink& link = model.topology.links[index(f.element)][index(f.face)];
      if (!link.free()) faces.emplace_back(link.neighbour, link.face());
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// Cuts the links of broken faces. Elements that share nodes cannot be parted: refused.
void break_initial(const case_::Case& input, Model& model) {
  for (const auto& [element, face] : broken_faces(input, model)) {
    FaceLink& link = model.topology.links[index(element)][index(face)];
    if (link.free()) continue;
    const Index group = model.mesh.element_group[index(element)];
    const Index other = model.mesh.element_group[index(link.neighbour)];
    if (model.discretisation[index(group)] == Discretisation::shared_nodes &&
        model.discretisation[index(other)] == Discretisation::shared_nodes) {
      throw InputError(Problem{input.file.string(), input.broken_origin.line, "joints.broken",
                               "a surface cuts through \"" + model.mesh.volume_groups[index(group)] +
                                   "\", whose elements share nodes: there are no joints to break",
                               "surfaces inside groups with joints = \"breakable\" or \"unbreakable\"", ""});
    }
    link = FaceLink{};
  }
}

/// Joint law of every pair of groups that has joints, found on first use.
class LawTable {
 public:
  LawTable(const case_::Case& input, Model& model) : input_(input), model_(model) {
    for (const WholeModel::JointGroups& groups : model.whole.joint_groups) (void)law_of(groups.a, groups.b);
  }

  /// Index of the law between two groups; -1 and a problem when the case names none.
  Index law_of(Index a, Index b) {
    const auto key = std::minmax(a, b);
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    const Index law = find(key.first, key.second);
    known_.emplace(key, law);
    return law;
  }

  /// The case entry of a law.
  [[nodiscard]] const case_::Joint& entry(Index law) const { return *entries_[index(law)]; }
  [[nodiscard]] std::pair<Index, Index> groups(Index law) const { return groups_[index(law)]; }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  std::vector<Problem> problems;

 private:
  Index find(Index a, Index b) {
    const std::string& first = model_.mesh.volume_groups[index(a)];
    const std::string& second = model_.mesh.volume_groups[index(b)];
    for (const case_::Joint& joint : input_.joints) {
      const bool fits = (joint.groups[0] == first && joint.groups[1] == second) ||
                        (joint.groups[0] == second && joint.groups[1] == first);
      if (!fits) continue;
      entries_.push_back(&joint);
      groups_.emplace_back(a, b);
      model_.joint_law_names.push_back(first == second ? first : first + "-" + second);
      return static_cast<Index>(entries_.size()) - 1;
    }
    problems.push_back({input_.file.string(), input_.mesh.origin.line, "joint",
                        "the meshes of \"" + first + "\" and \"" + second + "\" are glued, but no joint law says how",
                        "a [[joint]] with between = [\"" + first + "\", \"" + second + "\"], or mesh.glue = false",
                        ""});
    return -1;
  }

  const case_::Case& input_;
  Model& model_;
  std::map<std::pair<Index, Index>, Index> known_;
  std::vector<const case_::Joint*> entries_;
  std::vector<std::pair<Index, Index>> groups_;
};

bool has_joint(const Model& model, const JointFace& face) {
  const Index a = model.mesh.element_group[index(face.a)], b = model.mesh.element_group[index(face.b)];
  return model.discretisation[index(a)] == Discretisation::own_nodes ||
         model.discretisation[index(b)] == Discretisation::own_nodes;
}

/// Mean edge length of the joints of each law: the h of k = p/h unless the case gives one.
std::vector<double> mean_sizes(const Model& model, std::size_t laws) {
  std::vector<double> sum(laws, 0.0), count(laws, 0.0);
  for (const ModelJoint& joint : model.joints) {
    sum[index(joint.law)] += joint.face.size;
    count[index(joint.law)] += 1.0;
  }
  for (std::size_t l = 0; l < laws; ++l) sum[l] = count[l] > 0 ? sum[l] / count[l] : 1.0;
  return sum;
}

void take_joints(const case_::Case& input, Model& model) {
  LawTable table(input, model);
  for (const JointFace& face : find_joints(model.mesh, model.topology)) {
    if (!has_joint(model, face)) continue;
    const Index law = table.law_of(model.mesh.element_group[index(face.a)], model.mesh.element_group[index(face.b)]);
    if (law >= 0) model.joints.push_back({face, law});
  }
  if (model.whole.joint_groups.empty()) {
    const std::vector<double> sizes = mean_sizes(model, table.size());
    for (std::size_t l = 0; l < table.size(); ++l) {
      const auto [a, b] = table.groups(static_cast<Index>(l));
      model.whole.joint_groups.push_back({a, b, sizes[l]});
    }
  }
  for (std::size_t l = 0; l < table.size(); ++l) {
    const case_::Joint& entry = table.entry(static_cast<Index>(l));
    const auto [a, b] = table.groups(static_cast<Index>(l));
    const bool unbreakable = !model.breakable[index(a)] && !model.breakable[index(b)];
    model.joint_sizes.push_back(entry.size > 0 ? entry.size : model.whole.joint_groups[l].size);
    JointLawParams params = joint_law_params(entry, model.joint_sizes.back(), unbreakable);
    if (const std::string problem = prepare(params); !problem.empty()) {
      table.problems.push_back({input.file.string(), entry.origin.line, entry.origin.key, problem, "", ""});
    }
    model.joint_laws.push_back(std::move(params));
  }
  if (!table.problems.empty()) throw InputError(std::move(table.problems));
}

void take_contact(const case_::Case& input, Model& model) {
  model.contact = contact_params(input, model.mesh.volume_groups);
  model.has_contact =
      model.contact.sphere.has_value() || std::any_of(model.contact.laws.begin(), model.contact.laws.end(),
                                                      [](const ContactLaw& law) { return law.active(); });
  model.contact_everywhere = input.contact_points.everywhere;
  for (const std::string& name : input.contact_points.surfaces) {
    const auto& faces = model.topology.surface_groups[index(group_named(model.mesh.surface_groups, name))];
    model.contact_faces.insert(model.contact_faces.end(), faces.begin(), faces.end());
  }
}

/// Every element corner that lies on a physical surface.
std::vector<CornerTag> tag_corners(const Mesh& mesh) {
  std::vector<CornerTag> tags;
  std::vector<bool> on_surface;
  for (std::size_t g = 0; g < mesh.surface_groups.size(); ++g) {
    on_surface.assign(mesh.nodes.size(), false);
    for (const Mesh::SurfaceFace& face : mesh.surface_faces) {
      if (index(face.group) != g) continue;
      for (const Index node : face.nodes) on_surface[index(node)] = true;
    }
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      std::uint8_t corners = 0;
      for (std::size_t c = 0; c < 4; ++c) {
        if (on_surface[index(mesh.elements[index(e)][c])]) corners |= static_cast<std::uint8_t>(1U << c);
      }
      if (corners != 0) tags.push_back({mesh.element_id(e), static_cast<Index>(g), corners});
    }
  }
  std::sort(tags.begin(), tags.end(), [](const CornerTag& p, const CornerTag& q) {
    return std::pair(p.element, p.group) < std::pair(q.element, q.group);
  });
  return tags;
}

double longest_edge(const Mesh& mesh) {
  double square = 0;
  for (const auto& corners : mesh.elements) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        square = std::max(square, (mesh.nodes[index(corners[i])] - mesh.nodes[index(corners[j])]).squaredNorm());
      }
    }
  }
  return std::sqrt(square);
}

/// The rest of WholeModel, from the finished model.
void summarise(Model& model) {
  const LocalMesh& local = model.local;
  WholeModel& whole = model.whole;
  whole.source = model.mesh.source;
  whole.volume_groups = model.mesh.volume_groups;
  whole.surface_groups = model.mesh.surface_groups;
  whole.num_elements = model.mesh.num_elements();
  whole.num_joints = static_cast<std::int64_t>(model.joints.size());
  whole.body_length = mean_inradii(local);
  for (Index s = 0; s < local.num_slots; ++s) {
    if (local.element_of_slot[index(s)] < 0) continue;
    const std::size_t group = index(local.block_group[index(s / kLanes)]);
    // Strains below 1e-10 are round-off of positions: energies of that size are no measure for a residual.
    const ElasticParams& p = model.elastic[group];
    whole.energy_floor += 1e-20 * local.volume[index(s)] * (p.lambda + 2 * p.mu);
  }
}

}  // namespace

Model build_bare_model(const case_::Case& input) {
  Model model;
  FinishedMesh made = build_mesh(input);
  model.mesh = std::move(made.mesh);
  model.mesh_report = std::move(made.report);
  model.topology = build_topology(model.mesh);
  model.whole.longest_edge = longest_edge(model.mesh);
  take_materials(input, model);
  take_contact(input, model);
  break_initial(input, model);
  return model;
}

Model build_model(const case_::Case& input) {
  Model model = build_bare_model(input);
  model.corner_tags = tag_corners(model.mesh);
  take_joints(input, model);
  model.local = build_local_mesh(model.mesh, model.discretisation, model.density);
  summarise(model);
  return model;
}

Model build_piece(const case_::Case& input, WholeModel whole, Mesh mesh, Topology topology,
                  const std::vector<std::uint8_t>& original, std::vector<CornerTag> corner_tags) {
  Model model;
  model.mesh = std::move(mesh);
  model.topology = std::move(topology);
  model.whole = std::move(whole);
  model.corner_tags = std::move(corner_tags);
  take_materials(input, model);
  take_joints(input, model);
  take_contact(input, model);
  model.local = build_local_mesh(model.mesh, model.discretisation, model.density, original);
  return model;
}

bool starts_intact(const Model& model, const ModelJoint& joint) {
  const LocalMesh& local = model.local;
  return model.joint_laws[index(joint.law)].screen_limit() > 0 &&
         local.slot_of_element[index(joint.face.a)] < local.num_own_slots &&
         local.slot_of_element[index(joint.face.b)] < local.num_own_slots;
}

JointLinks build_links(const Model& model) {
  const LocalMesh& local = model.local;
  JointLinks links;
  links.reset(local.num_own_slots);
  for (const ModelJoint& joint : model.joints) {
    if (!starts_intact(model, joint)) continue;
    const JointLawParams& law = model.joint_laws[index(joint.law)];
    const Index a = local.slot_of_element[index(joint.face.a)], b = local.slot_of_element[index(joint.face.b)];
    const int face_b = joint.face.code / 3;
    links.attach(a, joint.face.face_a, b, joint.face.code);
    const double stiffness = corner_stiffness(law, joint.face.area);
    links.stiffness[JointLinks::at(a, joint.face.face_a)] = stiffness;
    links.stiffness[JointLinks::at(b, face_b)] = stiffness;
    for (const Index slot : {a, b}) {
      double& limit = links.limit[index(slot)];
      limit = std::min(limit, law.screen_limit());
    }
  }
  return links;
}

}  // namespace breccia
