#include "model/time_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/index.hpp"
#include "base/number_text.hpp"

namespace breccia {
namespace {

/// Joints that the sweep does not evaluate, at their stiffest.
std::vector<JointStiffness> other_joints(const Model& model) {
  std::vector<JointStiffness> joints;
  for (const ModelJoint& joint : model.joints) {
    if (starts_intact(model, joint)) continue;
    const JointLawParams& law = model.joint_laws[at(joint.law)];
    joints.push_back({model.local.slot_of_element[at(joint.face.a)], model.local.slot_of_element[at(joint.face.b)],
                      static_cast<std::int8_t>(joint.face.face_a), static_cast<std::int8_t>(joint.face.code),
                      law.points == JointPoints::mid_edge, corner_stiffness(law, joint.face.area)});
  }
  return joints;
}

/// (volume groups) whether anything can touch it.
std::vector<bool> groups_with_contact(const Model& model) {
  const std::size_t groups = model.mesh.volume_groups.size();
  std::vector<bool> touched(groups, model.contact.sphere.has_value());
  for (std::size_t a = 0; a < groups; ++a) {
    for (std::size_t b = 0; b < groups; ++b) {
      touched[a] =
          touched[a] || model.contact.laws[a * groups + b].active() || model.contact.laws[b * groups + a].active();
    }
  }
  return touched;
}

}  // namespace

TimeStep::TimeStep(const Model& model, const RankOperations& ranks)
    : model_(model),
      touched_(groups_with_contact(model)),
      links_(build_links(model)),
      joints_(other_joints(model)),
      memory_(step_model()) {
  if (model.has_contact) mark_faces();
  ratio_ = model.whole.step_ratio;
  if (ratio_ > 0) return;
  memory_.elements.update(step_model(), model.local.reference);
  const double bound = ranks.max(memory_.elements.stiffest(model.local));
  ratio_ = std::max(1.0, std::sqrt(bound / largest_eigenvalue(step_model(), ranks)));
}

StepModel TimeStep::step_model(const MaterialMemory& memory) const {
  return {model_.local, links_, joints_, model_.elastic, model_.density, memory};
}

StableStep TimeStep::bound(const Field<double>& position, const MaterialMemory& memory) const {
  return stable_step(step_model(memory), position);
}

void TimeStep::mark_faces() {
  const LocalMesh& local = model_.local;
  for (auto* bits : {&at_rest_.open, &at_rest_.torn, &at_rest_.pointed}) bits->assign(at(local.num_slots), 0);
  const auto mark = [&](std::vector<std::uint8_t>& bits, Index element, int face) {
    bits[at(local.slot_of_element[at(element)])] |= static_cast<std::uint8_t>(1U << face);
  };
  for (Index e = 0; e < model_.mesh.num_elements(); ++e) {
    if (!touched_[at(model_.mesh.element_group[at(e)])]) continue;
    at_rest_.torn[at(local.slot_of_element[at(e)])] = model_.torn[at(e)];
    for (int f = 0; f < 4; ++f) {
      if (!model_.topology.links[at(e)][at(f)].free()) continue;
      if (model_.plane && on_side(model_.mesh, e, f, model_.plane->axis)) continue;
      mark(at_rest_.open, e, f);
    }
  }
  if (model_.contact_everywhere) {
    std::fill(at_rest_.pointed.begin(), at_rest_.pointed.end(), std::uint8_t{15});
    return;
  }
  for (const Topology::Face& face : model_.contact_faces) {
    mark(at_rest_.pointed, face.element, face.face);
    const FaceLink& link = model_.topology.links[at(face.element)][at(face.face)];
    if (link.inner()) mark(at_rest_.pointed, link.neighbour, link.face());
  }
}

ContactFaces TimeStep::open_faces(const CornerClusters* clusters) const {
  ContactFaces faces = at_rest_;
  if (clusters == nullptr) return faces;
  for (Index e = 0; e < model_.mesh.num_elements(); ++e) {
    if (!touched_[at(model_.mesh.element_group[at(e)])]) continue;
    const std::size_t slot = at(model_.local.slot_of_element[at(e)]);
    for (int f = 0; f < 4; ++f) {
      if (!clusters->broken(e, f)) continue;
      faces.open[slot] |= static_cast<std::uint8_t>(1U << f);
      faces.torn[slot] |= static_cast<std::uint8_t>(1U << f);
    }
  }
  return faces;
}

std::vector<std::uint8_t> TimeStep::held_nodes(const std::vector<NodalConstraint>& constraints) const {
  std::vector<std::uint8_t> axes(at(model_.local.num_nodes), 0);
  for (const NodalConstraint& entry : constraints) {
    unsigned bits = 0;
    for (std::size_t i = 0; i < 3; ++i) bits |= entry.axes[i] ? 1U << i : 0U;
    for (const Index node : entry.nodes) axes[at(node)] |= static_cast<std::uint8_t>(bits);
  }
  // Contact pushes within the plane of a plane model.
  const unsigned across = model_.plane ? 1U << static_cast<unsigned>(model_.plane->axis) : 0U;
  for (std::uint8_t& bits : axes) bits = (bits | across) == 7 ? 1 : 0;
  return axes;
}

std::string limit_text(const StableStep& step) {
  const std::string element = std::to_string(step.element);
  switch (step.limit) {
    case StepLimit::joint:
      return step.neighbour >= 0 ? "the joint between elements " + element + " and " + std::to_string(step.neighbour)
                                 : "the joints of element " + element;
    case StepLimit::contact:
      return "the contact penalty on element " + element;
    case StepLimit::element:
      break;
  }
  return "element " + element;
}

std::string given_step_text(double dt, const StableStep& step) {
  if (!(dt > step.step)) return {};
  const std::string given = "time.step = " + number_text(dt, 3) + " s is ";
  if (dt > step.joint_step) {
    return given + number_text(dt / step.joint_step, 3) +
           " times longer than the stable step of elements and joints, " + number_text(step.joint_step, 3) +
           " s (by iteration): the run will blow up. Leave it to \"auto\".";
  }
  return given + number_text(dt / step.step, 3) + " times longer than what " + limit_text(step) + " allows, " +
         number_text(step.step, 3) +
         " s: bodies in contact there may gain energy. Set it to \"auto\", or lower the penalty.";
}

}  // namespace breccia
