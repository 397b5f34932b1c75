#include "model/time_step.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "physics/contact/contact_point.hpp"

namespace breccia {
namespace {

std::size_t index(Index i) { return static_cast<std::size_t>(i); }

/// Stiffest contact a point of each group can meet, Pa/m: kappa b.
std::vector<double> contact_slopes(const Model& model) {
  const std::vector<double>& length = model.whole.group_length;
  const std::size_t groups = model.mesh.volume_groups.size();
  std::vector<double> slope(groups, 0.0);
  for (std::size_t a = 0; a < groups; ++a) {
    for (std::size_t b = 0; b < groups; ++b) {
      const ContactLaw& law = model.contact.laws[a * groups + b];
      if (law.active()) slope[a] = std::max(slope[a], law.penalty / length[b] * law.exponent);
    }
    if (model.contact.sphere) slope[a] = std::max(slope[a], model.contact.sphere->penalty / length[a]);
  }
  return slope;
}

/// A face's points act together; all together are as stiff as one point that carries the face's whole area.
std::vector<ContactStiffness> contact_stiffness(const Model& model) {
  std::vector<ContactStiffness> contacts;
  if (!model.has_contact) return contacts;
  const std::vector<double> slope = contact_slopes(model);
  const std::array<double, 3> shape = face_rule(model.contact.points_per_face).shape[0];
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    const std::size_t group = index(model.mesh.element_group[index(e)]);
    for (int f = 0; f < 4; ++f) {
      const bool may_be_free = model.topology.links[index(e)][index(f)].free() || model.breakable[group];
      if (!may_be_free || slope[group] <= 0) continue;
      const auto& corner = kFaceCorners[index(f)];
      const auto x = [&](std::size_t i) {
        return model.mesh.nodes[index(model.mesh.elements[index(e)][index(corner[i])])];
      };
      const double area = 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm();
      contacts.push_back({model.local.slot_of_element[index(e)], f, shape, slope[group] * area});
    }
  }
  return contacts;
}

}  // namespace

TimeStep::TimeStep(const Model& model)
    : model_(model), links_(build_links(model)), contacts_(contact_stiffness(model)) {
  ratio_ = model.whole.step_ratio > 0
               ? model.whole.step_ratio
               : std::max(1.0, true_stable_step(step_model({})) / at(model.local.reference).step);
}

StepModel TimeStep::step_model(const MaterialMemory& memory) const {
  return {model_.local, links_, model_.elastic, model_.density, contacts_, model_.whole.lightest_node, memory};
}

StableStep TimeStep::at(const Field<double>& position, const MaterialMemory& memory) const {
  return stable_step(step_model(memory), position);
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

}  // namespace breccia
