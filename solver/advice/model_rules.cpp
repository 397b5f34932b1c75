#include "advice/rule_functions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/extent.hpp"
#include "base/geometry_file.hpp"
#include "base/index.hpp"
#include "base/quantity_text.hpp"
#include "mesh/tetrahedron.hpp"
#include "model/parameters.hpp"

namespace breccia {
namespace {

/// Whether loads or motions of the case act along an axis, fixed nodes excepted.
bool acts_along(const case_::Case& input, const Model& model, std::size_t axis) {
  const auto i = static_cast<Eigen::Index>(axis);
  const auto moves = [&](const case_::InitialVelocity& v) {
    Vec3 turns = v.angular;
    turns[i] = 0;
    return v.velocity[i] != 0 || v.random[1] > 0 || !turns.isZero() || v.strain_rate[i] != 0;
  };
  const auto presses = [&](const case_::Pressure& pressure) {
    for (std::size_t s = 0; s < model.mesh.surface_groups.size(); ++s) {
      if (model.mesh.surface_groups[s] != pressure.surface) continue;
      const auto& faces = model.topology.surface_groups[s];
      return std::any_of(faces.begin(), faces.end(), [&](const Topology::Face& f) {
        return on_side(model.mesh, f.element, f.face, static_cast<int>(axis));
      });
    }
    return false;
  };
  const auto pulls = [&](const auto& load) { return !load.value[axis].is_zero(); };
  const auto drives = [&](const case_::Constraint& c) {
    return c.kind != case_::ConstraintKind::fixed && c.axes[axis] && !c.value[axis].is_zero();
  };
  return std::any_of(input.initial_velocities.begin(), input.initial_velocities.end(), moves) ||
         std::any_of(input.stages.begin(), input.stages.end(), [&](const case_::Stage& stage) {
           return !stage.gravity[axis].is_zero() ||
                  std::any_of(stage.pressures.begin(), stage.pressures.end(), presses) ||
                  std::any_of(stage.tractions.begin(), stage.tractions.end(), pulls) ||
                  std::any_of(stage.forces.begin(), stage.forces.end(), pulls) ||
                  std::any_of(stage.constraints.begin(), stage.constraints.end(), drives);
         });
}

/// Whether a constraint of every stage holds all that is in the model along an axis.
bool held_along(const case_::Case& input, const Model& model, std::size_t axis) {
  const auto& groups = model.mesh.volume_groups;
  return std::all_of(groups.begin(), groups.end(), [&](const std::string& group) {
    return std::all_of(input.stages.begin(), input.stages.end(), [&](const case_::Stage& stage) {
      return std::any_of(stage.constraints.begin(), stage.constraints.end(),
                         [&](const case_::Constraint& c) { return c.group == group && c.axes[axis]; });
    });
  });
}

}  // namespace

/// Fragments go through each other as well.
std::string fragments_without_contact(const case_::Case& input, const Model& model) {
  if (model.has_contact || !bodies_without_contact(input, model).empty()) return {};
  std::string groups;
  std::vector<bool> named(model.joint_law_names.size(), false);
  for (const ModelJoint& joint : model.joints) {
    const std::size_t pair = at(model.groups_of_joint_law[at(joint.law)]);
    if (named[pair] || !model.joint_laws[pair].breakable()) continue;
    named[pair] = true;
    groups += (groups.empty() ? "" : ", ") + model.joint_law_names[pair];
  }
  if (groups.empty()) return {};
  return fmt::format(
      "There is no [[contact]], and {} can break: fragments go through each other, and cracks that close do not press. "
      "Add one, with between = [\"*\", \"*\"] for all groups, unless cracks only open.",
      groups);
}

/// A layer much thicker or thinner than its elements are wide.
std::string slender_layer(const Model& model) {
  constexpr double kMost = 2;
  if (!model.plane) return {};
  const Layer layer = layer_of(model.mesh, model.plane->axis);
  if (layer.thickness <= kMost * layer.edge && layer.edge <= kMost * layer.thickness) return {};
  return fmt::format(
      "The layer of this plane model is {} thick and its elements {} wide: such slender elements make the time step "
      "short and the answer stiff. A thickness of about {} is best; forces and energies grow with it.",
      quantity_text(layer.thickness, "m"), quantity_text(layer.edge, "m"), quantity_text(layer.edge, "m"));
}

/// A slice without [plane], thin beside what it measures along both other axes.
std::string slice_without_plane(const case_::Case& input, const Model& model) {
  constexpr double kThin = 0.2;
  if (model.plane || model.contact.sphere) return {};
  const auto [lower, upper] = extent_of(model.mesh.nodes);
  const Vec3 size = upper - lower;
  Eigen::Index axis = 0;
  const double thickness = size.minCoeff(&axis);
  const Vec3 rest = size + Vec3::Unit(axis) * size.maxCoeff();
  const auto a = static_cast<std::size_t>(axis);
  if (thickness > kThin * rest.minCoeff() || acts_along(input, model, a) || held_along(input, model, a) ||
      !is_layer(model.mesh, model.topology, static_cast<int>(axis)))
    return {};
  return fmt::format(
      "The mesh is one layer of elements across {}, with two free flat sides that carry contact points. For a slice, "
      "[plane] kind = \"stress\"{} excludes them from contact, and kind = \"strain\" also fixes motion along {}, as "
      "inside a long body.",
      "xyz"[axis], axis == 2 ? "" : fmt::format(", axis = \"{}\",", "xyz"[axis]), "xyz"[axis]);
}

/// Bodies that go through each other. Those that a constraint holds in every stage cannot move into others.
std::string bodies_without_contact(const case_::Case& input, const Model& model) {
  if (model.has_contact || model.mesh.num_bodies < 2) return {};
  std::vector<bool> free(at(model.mesh.num_bodies), true);
  for (std::size_t g = 0; g < model.mesh.volume_groups.size(); ++g) {
    const bool held = std::all_of(input.stages.begin(), input.stages.end(), [&](const case_::Stage& stage) {
      return std::any_of(stage.constraints.begin(), stage.constraints.end(), [&](const case_::Constraint& c) {
        return c.group == model.mesh.volume_groups[g] && c.kind == case_::ConstraintKind::fixed &&
               c.axes == std::array{true, true, true};
      });
    });
    for (Index e = 0; held && e < model.mesh.num_elements(); ++e) {
      if (model.mesh.element_group[at(e)] == static_cast<Index>(g)) free[at(model.mesh.element_body[at(e)])] = false;
    }
  }
  if (std::find(free.begin(), free.end(), true) == free.end()) return {};
  return "There is no [[contact]]: bodies that meet go through each other. Add one, with between = [\"*\", \"*\"] "
         "for all groups, unless they never meet.";
}

std::string small_sphere(const Model& model) {
  if (!model.contact.sphere) return {};
  const SphericalBoundary& sphere = *model.contact.sphere;
  double furthest = 0;
  Index outside = 0, worst = -1;
  bool around_something = false;  // else unmeant_advice reports it
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    double distance = 0;
    Vec3 centre = Vec3::Zero();
    for (const Index node : model.mesh.elements[at(e)]) {
      distance = std::max(distance, (model.mesh.nodes[at(node)] - sphere.centre).norm());
      centre += model.mesh.nodes[at(node)] / 4;
    }
    around_something = around_something || (centre - sphere.centre).norm() <= sphere.radius;
    if (distance > sphere.radius) ++outside;
    if (distance > furthest) furthest = distance, worst = e;
  }
  if (outside == 0 || !around_something) return {};
  return fmt::format(
      "The sphere does not enclose the model: {} elements are outside at the start, element {} by {:.3g} m, and "
      "elements outside are not pushed back. Raise sphere.radius from {:.4g} to more than {:.4g} m, or move "
      "sphere.centre.",
      outside, worst, furthest - sphere.radius, sphere.radius, furthest);
}

/// A file without a unit whose numbers appear to be millimetres.
std::string unit_of_lengths(const case_::Case& input, const Model& model) {
  constexpr double kLarge = 10;  // m; parts that break are drawn in mm or in m
  if (!states_no_unit(geometry_file(input.mesh.file)) || input.mesh.scale != 1) return {};
  const auto [lower, upper] = extent_of(model.mesh.nodes);
  const Vec3 size = upper - lower;
  if (size.maxCoeff() <= kLarge) return {};
  return fmt::format(
      "The file {} states no unit, and the model is {:.4g} x {:.4g} x {:.4g} m large. If its lengths are millimetres, "
      "set mesh.scale = 0.001.",
      input.mesh.file.filename().string(), size.x(), size.y(), size.z());
}

/// Joints all through a raster: that they lie in few planes decides at which load it breaks.
std::string raster_planes(const case_::Case& input, const Model& model) {
  constexpr int kThick = 3;  // cells: fewer are a bar or a layer whose crack has its place
  if (!input.mesh.raster || input.mesh.raster->single_tetrahedra || model.joints.empty()) return {};
  const std::array<int, 3>& cells = input.mesh.raster->cells;
  if (*std::min_element(cells.begin(), cells.end()) < kThick) return {};
  return "The joints of a raster lie in planes of few directions, and its strength depends on how these lie to the "
         "load: pressed prisms of 53 MPa by Mohr-Coulomb broke at 77 MPa as rasters, at 61 MPa with a mesh of gmsh. "
         "Where the strength of a solid or the path of a crack matters, mesh it with gmsh (mesh.file).";
}

}  // namespace breccia
