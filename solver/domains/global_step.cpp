#include "domains/global_step.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace breccia {
namespace {

/// Cells grow where there are more open faces than this, so that the patches of all ranks stay few.
constexpr double kMostFaces = 200'000;

std::vector<ContactShare> shares_of_contact(const Communicator& communicator, const TimeStep& time_step,
                                            const StepState& state, const ContactFaces& faces, double time) {
  const Model& model = time_step.model();
  const std::vector<std::uint8_t> held =
      time_step.held_nodes(state.constraints != nullptr ? *state.constraints : std::vector<NodalConstraint>{});
  const ContactStepModel contact{model.contact, model.local, model.whole.body_length, faces, held, state.contact};
  std::int64_t open = 0;
  for (Index s = 0; s < model.local.num_slots; ++s) {
    if (model.local.is_original(s)) open += std::popcount(faces.open[static_cast<std::size_t>(s)]);
  }
  const double coarsening = std::max(1.0, std::cbrt(static_cast<double>(communicator.sum(open)) / kMostFaces));
  std::vector<ContactPatch> patches = contact_patches(contact, state.position, state.velocity, coarsening);
  if (communicator.size() > 1) {
    const auto of_ranks = communicator.all_gather(std::span<const ContactPatch>(patches));
    patches.clear();
    for (const std::vector<ContactPatch>& some : of_ranks) patches.insert(patches.end(), some.begin(), some.end());
    merge(patches);
  }
  return contact_shares(contact, state.position, coarsening, patches, time);
}

}  // namespace

StepParts step_parts(const Communicator& communicator, const TimeStep& time_step, const StepState& state,
                     double steps) {
  const StepModel model = time_step.step_model(state.memory);
  StepParts parts{step_shares(model, state.position), 0.0, {}, {}};
  parts.most = communicator.max(stiffest(model, parts.shares)) / (time_step.ratio() * time_step.ratio());
  if (!time_step.model().has_contact) return parts;
  ContactFaces faces = time_step.open_faces(state.clusters);
  parts.contacts = shares_of_contact(communicator, time_step, state, faces, steps * 2.0 / std::sqrt(parts.most));
  parts.open = std::move(faces.open);
  return parts;
}

StableStep global_stable_step(const Communicator& communicator, const TimeStep& time_step, const StepState& state,
                              double steps) {
  const StepParts parts = step_parts(communicator, time_step, state, steps);
  StableStep result = stable_step(time_step.step_model(), parts.shares, parts.most, parts.contacts, parts.open);
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
