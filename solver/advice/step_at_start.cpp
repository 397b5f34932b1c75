#include "advice/step_at_start.hpp"

#include <algorithm>
#include <cmath>

#include "base/index.hpp"
#include "contact/search_params.hpp"
#include "model/parameters.hpp"

namespace breccia {
namespace {

/// Steps between two evaluations of the limit, as in StageSteps.
constexpr double kStepsAhead = 100;

}  // namespace

StepAtStart::StepAtStart(const case_::Case& input, const Model& model)
    : input_(input), model_(model), time_step_(model), domain_(model, search_params(input, model)) {
  for (const InitialVelocity& initial : initial_velocities(input, model)) add_velocity(domain_, initial);
  if (!input.stages.empty()) loads_ = stage_loads(input.stages.front(), model);
  parts_ = step_parts(Communicator(), time_step_, state(domain_.state.nodes.velocity), kStepsAhead * input.time.safety);
  now_ = step_with(parts_.contacts);
}

StepModel StepAtStart::model_now() const { return step_model(time_step_, state(domain_.state.nodes.velocity)); }

double StepAtStart::dt() const { return input_.time.step > 0 ? input_.time.step : input_.time.safety * now_.step; }

const std::vector<ContactShare>& StepAtStart::met() const {
  if (met_) return *met_;
  const double free_step = 2.0 / std::sqrt(parts_.most);
  const Field<double> velocity = velocity_with_gravity();
  met_ = step_parts(Communicator(), time_step_, state(velocity), input_.stages.back().end / free_step).contacts;
  return *met_;
}

StableStep StepAtStart::step_with(const std::vector<ContactShare>& contacts) const {
  return stable_step(model_now(), parts_.shares, parts_.most, contacts, parts_.open);
}

double StepAtStart::step_without_viscosity() const {
  std::vector<StepShare> shares = parts_.shares;
  for (StepShare& share : shares) share.damping = 0;
  return stable_step(model_now(), shares, parts_.most, parts_.contacts, parts_.open).step;
}

StableStep StepAtStart::broken() const {
  CornerClusters clusters(model_.mesh, model_.topology);
  std::vector<Topology::Face> faces;
  for (const ModelJoint& joint : model_.joints) {
    if (!model_.joint_laws[at(joint.law)].breakable()) continue;
    faces.push_back({joint.face.a, joint.face.face_a});
    faces.push_back({joint.face.b, joint.face.code / 3});
  }
  std::vector<Index> changed;
  clusters.break_faces(faces, changed);
  StepState state = this->state(domain_.state.nodes.velocity);
  state.clusters = &clusters;
  const StepParts parts = step_parts(Communicator(), time_step_, state, kStepsAhead * input_.time.safety);
  return stable_step(model_now(), parts.shares, parts.most, parts.contacts, parts.open);
}

/// Velocities with what gravity adds until the end to nodes that the first stage does not hold, m/s.
Field<double> StepAtStart::velocity_with_gravity() const {
  constexpr int kTimes = 16;  // of a stage
  Vec3 gained = Vec3::Zero();
  double start = 0;
  for (const case_::Stage& stage : input_.stages) {
    const double part = (stage.end - start) / kTimes;
    for (int i = 0; i < kTimes; ++i) {
      for (std::size_t a = 0; a < 3; ++a)
        gained[static_cast<Eigen::Index>(a)] += part * stage.gravity[a](start + (i + 0.5) * part);
    }
    start = stage.end;
  }
  Field<double> velocity = domain_.state.nodes.velocity;
  std::vector<std::array<bool, 3>> held(at(model_.local.num_nodes));
  const Constraints constraints(loads_.constraints, model_.local, domain_.state.nodes);
  for (std::size_t i = 0; i < constraints.nodes().size(); ++i)
    held[at(constraints.nodes()[i])] = constraints.held_axes()[i];
  for (Index node = 0; node < model_.local.num_nodes; ++node) {
    for (int a = 0; a < 3; ++a) {
      if (!held[at(node)][static_cast<std::size_t>(a)]) velocity[nodal(node, a)] += gained[a];
    }
  }
  return velocity;
}

StepState StepAtStart::state(const Field<double>& velocity) const {
  return {domain_.state.nodes.position, velocity,
          domain_.contacts(),           domain_.contact ? &domain_.contact->clusters() : nullptr,
          &loads_.constraints,          {},
          loads_.local_damping};
}

}  // namespace breccia
