#include "domains/global_step.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace breccia {
namespace {

/// Cells grow where there are more open faces than this, so that the patches of all ranks stay few.
constexpr double kMostFaces = 200'000;

/// Who may touch whom at present.
class ContactLook {
 public:
  /// Collective. @param state  outlives this object
  ContactLook(const Communicator& communicator, const TimeStep& time_step, const StepState& state)
      : faces_(time_step.open_faces(state.clusters)),
        held_(time_step.held_nodes(state.constraints != nullptr ? *state.constraints : std::vector<NodalConstraint>{})),
        model_{time_step.model().contact,
               time_step.model().local,
               time_step.model().whole.body_length,
               faces_,
               held_,
               state.contact,
               &time_step.contact_elements()} {
    std::int64_t open = 0;
    for (Index s = 0; s < model_.mesh.num_slots; ++s) {
      if (model_.mesh.is_original(s)) open += std::popcount(faces_.open[static_cast<std::size_t>(s)]);
    }
    coarsening_ = std::max(1.0, std::cbrt(static_cast<double>(communicator.sum(open)) / kMostFaces));
    patches_ = contact_patches(model_, state.position, state.velocity, coarsening_);
    if (communicator.size() == 1) return;
    std::vector<ContactPatch> of_all;
    for (const auto& some : communicator.all_gather(std::span<const ContactPatch>(patches_.list)))
      of_all.insert(of_all.end(), some.begin(), some.end());
    patches_.merge(std::move(of_all));
  }
  ContactLook(const ContactLook&) = delete;
  ContactLook& operator=(const ContactLook&) = delete;

  /// What contact within `time`, s, adds to all originals.
  [[nodiscard]] std::vector<ContactShare> all(double time) const { return contact_shares(model_, patches_, time); }
  /// To requested originals.
  [[nodiscard]] ContactShares one_by_one(double time) const { return {model_, patches_, time}; }
  [[nodiscard]] const std::vector<std::uint8_t>& open() const { return faces_.open; }

 private:
  ContactFaces faces_;
  std::vector<std::uint8_t> held_;
  ContactStepModel model_;
  double coarsening_ = 1;
  ContactPatches patches_;
};

/// Without those of contact.
StepParts elastic_parts(const Communicator& communicator, const TimeStep& time_step, const StepState& state) {
  const StepModel model = step_model(time_step, state);
  StepParts parts{step_shares(model, state.position), 0.0, {}, {}};
  parts.most = communicator.max(stiffest(model, parts.shares)) / (time_step.ratio() * time_step.ratio());
  return parts;
}

/// s that `steps` of the true limit without contact take.
double duration(const StepParts& parts, double steps) { return steps * 2.0 / std::sqrt(parts.most); }

}  // namespace

StepModel step_model(const TimeStep& time_step, const StepState& state) {
  StepModel model = time_step.step_model(state.memory);
  model.local_damping = state.local_damping;
  return model;
}

StepParts step_parts(const Communicator& communicator, const TimeStep& time_step, const StepState& state,
                     double steps) {
  StepParts parts = elastic_parts(communicator, time_step, state);
  if (!time_step.model().has_contact) return parts;
  const ContactLook look(communicator, time_step, state);
  parts.contacts = look.all(duration(parts, steps));
  parts.open = look.open();
  return parts;
}

double global_step_length(const Communicator& communicator, const TimeStep& time_step, const StepState& state,
                          double steps) {
  const StepParts parts = elastic_parts(communicator, time_step, state);
  if (!time_step.model().has_contact) {
    const StableStep result = stable_step(step_model(time_step, state), parts.shares, parts.most);
    return communicator.min(result.step);
  }
  const ContactLook look(communicator, time_step, state);
  ContactShares contacts = look.one_by_one(duration(parts, steps));
  const ElementSteps element_steps(step_model(time_step, state), parts.most);
  double shortest = std::numeric_limits<double>::infinity();
  const LocalMesh& mesh = time_step.model().local;
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (!mesh.is_original(s)) continue;
    const auto i = static_cast<std::size_t>(s);
    const auto step_with = [&](const ContactShare& contact) {
      return element_steps.of(parts.shares[i], contact, look.open()[i]);
    };
    ContactShare most;
    most.omega_squared.fill(contacts.at_most(s));
    if (step_with(most) < shortest) shortest = std::min(shortest, step_with(contacts.of(s)));
  }
  return communicator.min(shortest);
}

StableStep global_stable_step(const Communicator& communicator, const TimeStep& time_step, const StepState& state,
                              double steps) {
  const StepParts parts = step_parts(communicator, time_step, state, steps);
  StableStep result = stable_step(step_model(time_step, state), parts.shares, parts.most, parts.contacts, parts.open);
  result.element_step = communicator.min(result.element_step);
  result.joint_step = communicator.min(result.joint_step);
  struct Limiter {
    double step;
    GlobalId element, neighbour;
    StepLimit limit;
    int face;
  };
  Limiter limiter{result.step, result.element, result.neighbour, result.limit, result.face};
  for (const auto& of_rank : communicator.all_gather(std::span<const Limiter>(&limiter, 1))) {
    const Limiter& other = of_rank.front();
    if (other.step < limiter.step || (other.step == limiter.step && other.element < limiter.element)) limiter = other;
  }
  result.step = limiter.step;
  result.element = limiter.element;
  result.neighbour = limiter.neighbour;
  result.limit = limiter.limit;
  result.face = limiter.face;
  return result;
}

}  // namespace breccia
