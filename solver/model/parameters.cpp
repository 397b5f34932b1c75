#include "model/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "case/groups.hpp"
#include "model/model.hpp"
#include "model/nodal_loads.hpp"

namespace breccia {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SofteningShape shape_of(case_::Softening softening) {
  switch (softening) {
    case case_::Softening::linear:
      return SofteningShape::linear;
    case case_::Softening::exponential:
      return SofteningShape::exponential;
    case case_::Softening::z_curve:
      break;
  }
  return SofteningShape::z_curve;
}

BulkLaw bulk_law_of(case_::BulkLaw law) {
  switch (law) {
    case case_::BulkLaw::neo_hookean:
      break;
    case case_::BulkLaw::green_st_venant:
      return BulkLaw::green_st_venant;
    case case_::BulkLaw::drucker_prager:
      return BulkLaw::drucker_prager;
  }
  return BulkLaw::neo_hookean;
}

DruckerPragerParams drucker_prager_of(const case_::DruckerPrager& entry) {
  DruckerPragerParams p = make_drucker_prager(entry.friction_angle, entry.dilation_angle, entry.cohesion);
  p.hardening = entry.hardening;
  if (entry.tension_cutoff > 0) p.tension_cutoff = entry.tension_cutoff;
  if (entry.cap_pressure > 0) p.cap_pressure = entry.cap_pressure;
  p.cap_hardening = entry.cap_hardening;
  return p;
}

JointLaw joint_law_of(case_::JointLaw law) {
  switch (law) {
    case case_::JointLaw::mixed_mode:
      break;
    case case_::JointLaw::independent_peaks:
      return JointLaw::independent_peaks;
  }
  return JointLaw::mixed_mode;
}

JointRise rise_of(case_::JointRise rise) {
  switch (rise) {
    case case_::JointRise::linear:
      break;
    case case_::JointRise::parabolic:
      return JointRise::parabolic;
  }
  return JointRise::linear;
}

JointPoints points_of(case_::JointPoints points) {
  switch (points) {
    case case_::JointPoints::nodal:
      break;
    case case_::JointPoints::mid_edge:
      return JointPoints::mid_edge;
  }
  return JointPoints::nodal;
}

/// A fixed node has velocity zero.
PrescribedMotion motion_of(case_::ConstraintKind kind) {
  switch (kind) {
    case case_::ConstraintKind::fixed:
    case case_::ConstraintKind::velocity:
      break;
    case case_::ConstraintKind::displacement:
      return PrescribedMotion::displacement;
  }
  return PrescribedMotion::velocity;
}

OverlapField field_of(case_::OverlapField field) {
  switch (field) {
    case case_::OverlapField::tet_potential:
      return OverlapField::tet_potential;
    case case_::OverlapField::tet_distance:
      return OverlapField::tet_distance;
    case case_::OverlapField::body:
      break;
  }
  return OverlapField::body;
}

InitialOverlap initial_overlap_of(case_::InitialOverlap overlap) {
  switch (overlap) {
    case case_::InitialOverlap::relax:
      return InitialOverlap::relax;
    case case_::InitialOverlap::accept:
      return InitialOverlap::accept;
    case case_::InitialOverlap::refuse:
      break;
  }
  return InitialOverlap::refuse;
}

/// What two groups are like together.
struct SharedMaterial {
  double density = 0;  ///< kg/m3, reduced; 0: not known
  double young = 0;    ///< Pa, of the softer one
};
SharedMaterial shared_material(const case_::Case& input, const std::string& group, const std::string& other) {
  const case_::Material *a = case_::material_of(input, group), *b = case_::material_of(input, other);
  if (a == nullptr || b == nullptr || !(a->density > 0 && b->density > 0)) return {};
  return {a->density * b->density / (a->density + b->density), std::min(a->young, b->young)};
}

/// Whether points of a group are felt by the other.
bool carries_points(const case_::Contact& entry, const std::string& group, const std::string& other) {
  return entry.points_on == case_::PointsOn::both ||
         (case_::fits(entry.groups[0], group) && case_::fits(entry.groups[1], other));
}

ContactLaw contact_law(const case_::Contact& entry, const SharedMaterial& pair) {
  ContactLaw law;
  law.plateau = entry.plateau > 0 ? entry.plateau : kInfinity;
  law.exponent = entry.unloading_exponent;
  const double penalty = entry.penalty_factor > 0 ? entry.penalty_factor * pair.young : entry.penalty;
  law.penalty = std::min(penalty, largest_penalty(law.plateau, law.exponent));
  law.friction = entry.friction;
  law.tangential_ratio = entry.tangential_ratio;
  law.damping = 2 * entry.damping_ratio * std::sqrt(law.penalty * pair.density);
  if (pair.density > 0)
    law.friction_delay = entry.friction_delay * std::sqrt(pair.density / std::min(law.penalty, pair.young));
  return law;
}

void sort_unique(std::vector<Index>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

}  // namespace

const case_::Material& material_in(const case_::Case& input, const std::string& group) {
  const case_::Material* material = case_::material_of(input, group);
  DEMAND(material != nullptr, group);
  return *material;
}

ElasticParams elastic_params(const case_::Material& material) {
  ElasticParams params =
      make_elastic_params(bulk_law_of(material.law), material.young, material.poisson, material.viscosity);
  params.drucker_prager = drucker_prager_of(material.plasticity);
  return params;
}

JointLawParams joint_law_params(const case_::Joint& joint, double size, bool unbreakable) {
  JointLawParams law;
  law.law = unbreakable ? JointLaw::mixed_mode : joint_law_of(joint.law);
  law.rise = unbreakable ? JointRise::linear : rise_of(joint.rise);
  law.points = points_of(joint.points);
  law.stiffness = joint.penalty / size;
  law.tensile_strength = unbreakable ? kInfinity : joint.tensile_strength;
  law.cohesion = unbreakable ? kInfinity : joint.shear_strength;
  law.friction = joint.friction;
  law.energy_mode_1 = joint.energy_mode_1;
  law.energy_mode_2 = joint.energy_mode_2;
  law.energy_of_whole_curve = joint.energy_of_whole_curve;
  law.softening = {shape_of(joint.softening), joint.a, joint.b, joint.c, joint.exponent};
  law.points_to_fail = joint.points_to_fail;
  return law;
}

TiedContacts tied_contact_entries(const case_::Case& input, const std::string& group, const std::string& other) {
  TiedContacts found;
  for (const case_::Contact& entry : input.contacts) {
    const int named = case_::num_named(entry.groups);
    const int before = found.ruling != nullptr ? case_::num_named(found.ruling->groups) : -1;
    if (!case_::fits(entry.groups, group, other) || named < before) continue;
    found = {.ruling = &entry, .overruled = named == before ? found.ruling : nullptr};
  }
  return found;
}

const case_::Contact* contact_entry(const case_::Case& input, const std::string& group, const std::string& other) {
  return tied_contact_entries(input, group, other).ruling;
}

ContactParams contact_params(const case_::Case& input, const std::vector<std::string>& groups) {
  ContactParams params;
  params.points_per_face = input.contact_points.per_face;
  params.points_everywhere = input.contact_points.everywhere;
  params.field = field_of(input.contact_points.field);
  params.num_groups = static_cast<Index>(groups.size());
  params.laws.resize(groups.size() * groups.size());
  params.initial_overlaps.resize(params.laws.size(), InitialOverlap::accept);
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = 0; b < groups.size(); ++b) {
      const case_::Contact* entry = contact_entry(input, groups[a], groups[b]);
      if (entry == nullptr || entry->interaction == case_::Interaction::none) continue;
      if (carries_points(*entry, groups[a], groups[b]))
        params.laws[a * groups.size() + b] = contact_law(*entry, shared_material(input, groups[a], groups[b]));
      params.initial_overlaps[a * groups.size() + b] = initial_overlap_of(entry->initial_overlap);
    }
  }
  if (input.sphere)
    params.sphere = SphericalBoundary{input.sphere->centre, input.sphere->radius, input.sphere->penalty};
  return params;
}

std::vector<Discretisation> discretisations(const case_::Case& input, const std::vector<std::string>& groups) {
  std::vector<Discretisation> kinds(groups.size(), Discretisation::own_nodes);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (material_in(input, groups[g]).joints == case_::JointPlacement::none) kinds[g] = Discretisation::shared_nodes;
  }
  return kinds;
}

std::vector<std::uint8_t> slots_of_set(const Model& model, const std::string& name) {
  if (group_index(model.mesh.element_sets, name) < 0) return {};
  const Index group = corner_group(model.mesh, name);
  std::vector<std::uint8_t> slots(static_cast<std::size_t>(model.local.num_slots), 0);
  for (const CornerTag& tag : model.corner_tags) {
    const Index e = tag.group == group ? model.mesh.element_with(tag.element) : -1;
    if (e >= 0) slots[static_cast<std::size_t>(model.local.slot_of_element[static_cast<std::size_t>(e)])] = 1;
  }
  return slots;
}

std::vector<InitialVelocity> initial_velocities(const case_::Case& input, const Model& model) {
  std::vector<InitialVelocity> velocities;
  for (std::size_t i = 0; i < input.initial_velocities.size(); ++i) {
    const case_::InitialVelocity& entry = input.initial_velocities[i];
    velocities.push_back({group_index(model.mesh.volume_groups, entry.group), entry.velocity, entry.random, entry.seed,
                          entry.angular, entry.strain_rate, model.whole.motion_centres[i],
                          slots_of_set(model, entry.group)});
  }
  return velocities;
}

std::vector<Index> nodes_of_group(const Model& model, const std::string& group) {
  const LocalMesh& local = model.local;
  std::vector<Index> nodes;
  const auto take = [&](Index slot, int corner) { nodes.push_back(local.corner_node(slot, corner)); };
  if (const Index volume = group_index(model.mesh.volume_groups, group); volume >= 0) {
    for (Index s = 0; s < local.num_slots; ++s) {
      if (local.element_of_slot[static_cast<std::size_t>(s)] < 0 ||
          local.block_group[static_cast<std::size_t>(s / kLanes)] != volume)
        continue;
      for (int c = 0; c < 4; ++c) take(s, c);
    }
  } else if (const Index of_corners = corner_group(model.mesh, group); of_corners >= 0) {
    auto tag = model.corner_tags.begin();
    for (Index e = 0; e < model.mesh.num_elements(); ++e) {
      for (; tag != model.corner_tags.end() && tag->element == model.mesh.element_id(e); ++tag) {
        if (tag->group != of_corners) continue;
        for (int c = 0; c < 4; ++c) {
          if ((tag->corners >> c & 1) != 0) take(local.slot_of_element[static_cast<std::size_t>(e)], c);
        }
      }
    }
  }
  sort_unique(nodes);
  return nodes;
}

std::vector<Index> counted_nodes_of_group(const Model& model, const std::string& group) {
  std::vector<Index> nodes = nodes_of_group(model, group);
  std::erase_if(nodes, [&](Index node) { return model.local.counted[static_cast<std::size_t>(node)] == 0; });
  return nodes;
}

std::vector<LoadedFace> faces_of_surface(const Model& model, const std::string& surface) {
  std::vector<LoadedFace> faces;
  const Index group = group_index(model.mesh.surface_groups, surface);
  for (const Topology::Face& face : model.topology.surface_groups[static_cast<std::size_t>(group)]) {
    faces.push_back({model.local.slot_of_element[static_cast<std::size_t>(face.element)], face.face});
  }
  return faces;
}

/// The faces of a surface with the impedances of their material, and its nodes.
void add_absorbing(const Model& model, const std::string& surface, AbsorbingSurfaces& absorbing) {
  const std::vector<Index> nodes = nodes_of_group(model, surface);
  absorbing.nodes.insert(absorbing.nodes.end(), nodes.begin(), nodes.end());
  for (const LoadedFace& face : faces_of_surface(model, surface)) {
    const auto group = static_cast<std::size_t>(model.local.block_group[static_cast<std::size_t>(face.slot / kLanes)]);
    const ElasticParams& p = model.elastic[group];
    const double density = model.density[group];
    absorbing.faces.push_back({face, std::sqrt(density * (p.lambda + 2 * p.mu)), std::sqrt(density * p.mu)});
  }
}

StageLoads stage_loads(const case_::Stage& stage, const Model& model) {
  StageLoads loads;
  loads.gravity = stage.gravity;
  loads.mass_damping = stage.mass_damping;
  loads.local_damping = stage.local_damping;
  for (const case_::Pressure& entry : stage.pressures)
    loads.surfaces.emplace_back(faces_of_surface(model, entry.surface), entry.value);
  for (const case_::Traction& entry : stage.tractions)
    loads.surfaces.emplace_back(faces_of_surface(model, entry.surface), entry.value);
  for (const case_::Force& entry : stage.forces) loads.forces.push_back(nodal_load(entry, model));
  for (const std::string& surface : stage.absorbing) add_absorbing(model, surface, loads.absorbing);
  for (const case_::Constraint& entry : stage.constraints) {
    NodalConstraint constraint;
    constraint.nodes = nodes_of_group(model, entry.group);
    constraint.axes = entry.axes;
    constraint.kind = motion_of(entry.kind);
    if (entry.kind != case_::ConstraintKind::fixed) constraint.value = entry.value;
    loads.constraints.push_back(std::move(constraint));
  }
  return loads;
}

}  // namespace breccia
