#include "domains/global_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/index.hpp"
#include "physics/contact/step/upper_bounds.hpp"

namespace breccia {
namespace {

/// Cells grow where there are more open faces than this, so that the patches of all ranks stay few.
constexpr double kMostFaces = 200'000;

/// Surfaces that may touch each other at present.
class Surfaces {
 public:
  /// Collective. @param state  outlives this object
  Surfaces(const Communicator& communicator, const TimeStep& time_step, const StepState& state)
      : communicator_(communicator),
        state_(state),
        elements_(time_step.memory().contacts),
        faces_(time_step.open_faces(state.clusters)),
        held_(time_step.held_nodes(state.constraints != nullptr ? *state.constraints : std::vector<NodalConstraint>{})),
        model_{time_step.model().contact,
               time_step.model().local,
               time_step.model().whole.body_length,
               faces_,
               held_,
               state.contact} {
    elements_.update(model_);
    std::int64_t open = 0;
    for (Index s = 0; s < model_.mesh.num_slots; ++s) {
      if (model_.mesh.is_original(s)) for_each_face(faces_.open[at(s)], [&](int) { ++open; });
    }
    coarsening_ = std::max(1.0, std::cbrt(static_cast<double>(communicator.sum(open)) / kMostFaces));
  }
  Surfaces(const Surfaces&) = delete;
  Surfaces& operator=(const Surfaces&) = delete;

  /// Patches of the whole model. Collective. O(faces + patches of all ranks)
  [[nodiscard]] ContactPatches patches() const {
    ContactPatches patches = contact_patches(model_, elements_, state_.position, state_.velocity, coarsening_);
    if (communicator_.size() > 1) patches.merge(communicator_.all_gather(std::span<const ContactPatch>(patches.list)));
    return patches;
  }
  /// Of this rank, near an original.
  [[nodiscard]] ContactPatches patches_near(Index slot) const {
    return patches_around(model_, elements_, state_.position, state_.velocity, coarsening_, slot);
  }
  [[nodiscard]] const ContactStepModel& model() const { return model_; }
  [[nodiscard]] const ContactElements& elements() const { return elements_; }
  [[nodiscard]] unsigned open(Index slot) const { return faces_.open[at(slot)]; }

 private:
  const Communicator& communicator_;
  const StepState& state_;
  ContactElements& elements_;
  ContactFaces faces_;
  std::vector<std::uint8_t> held_;
  ContactStepModel model_;
  double coarsening_ = 1;
};

/// Elements and joints, of which a step is found slot by slot.
class Elements {
 public:
  /// Collective.
  Elements(const Communicator& communicator, const TimeStep& time_step, const StepState& state)
      : mesh(time_step.model().local), model_(step_model(time_step, state)), shares_(time_step.memory().elements) {
    shares_.update(model_, state.position);
    most = communicator.max(shares_.stiffest(mesh)) / (time_step.ratio() * time_step.ratio());
    steps_.emplace(model_, most);
  }
  /// s. @param open  bits of faces whose joints are released
  [[nodiscard]] double step(Index slot, const ContactShare& contact, unsigned open) const {
    return steps_->of(shares_.of(model_, slot), contact, open);
  }
  /// s, no more than that of an original to which contact adds no more. @param contact_of  1/s2, of a slot
  template <class F>
  [[nodiscard]] double lower_bound(F&& contact_of) const {
    double omega_squared = 0, damping = 0;
    for_each_original([&](Index s) {
      omega_squared = std::max(omega_squared, std::min(shares_.largest(mesh, s), most) + contact_of(s));
      damping = std::max(damping, shares_.damping(model_, s));
    });
    return steps_->step_of(omega_squared, damping);
  }
  template <class F>
  void for_each_original(F&& f) const {
    for (Index s = 0; s < mesh.num_slots; ++s) {
      if (mesh.is_original(s)) f(s);
    }
  }

  const LocalMesh& mesh;
  double most = 0;  ///< 1/s2, of elements and joints of the whole model: the true limit

 private:
  StepModel model_;
  ElementShares& shares_;
  std::optional<ElementSteps> steps_;
};

/// Without those of contact.
StepParts elastic_parts(const Communicator& communicator, const TimeStep& time_step, const StepState& state) {
  const StepModel model = step_model(time_step, state);
  StepParts parts{step_shares(model, state.position), 0.0, {}, {}};
  parts.most = communicator.max(stiffest(model, parts.shares)) / (time_step.ratio() * time_step.ratio());
  return parts;
}

/// s that `steps` of the true limit without contact take.
double duration(double most, double steps) { return steps * 2.0 / std::sqrt(most); }

/// Whether no step of the elements is shorter than `low`, s, wherever bodies are. Collective.
bool surely_longer(const Communicator& communicator, const Surfaces& surfaces, const Elements& elements, double low) {
  ContactUpperBounds bounds(surfaces.model(), surfaces.elements());
  communicator.max(bounds.numbers());
  bounds.update();
  const auto of_group = [&](Index s) {
    return surfaces.open(s) != 0 ? bounds.of_group(elements.mesh.block_group[at(s / kLanes)]) : 0.0;
  };
  bool longer = elements.lower_bound(of_group) >= low;
  if (!longer) {
    longer = true;
    elements.for_each_original([&](Index s) {
      const auto of_element = [&] { return surfaces.open(s) != 0 ? bounds.of(s) : ContactShare{}; };
      longer = longer && elements.step(s, of_element(), surfaces.open(s)) >= low;
    });
  }
  return communicator.min(longer ? 1.0 : 0.0) > 0;
}

/// The step of this rank's last limiter in contact with this rank's surfaces, s: no shorter than that of the model.
double known_step(const Surfaces& surfaces, const Elements& elements, Index limiter, double time) {
  if (limiter < 0) return std::numeric_limits<double>::infinity();
  if (surfaces.open(limiter) == 0) return elements.step(limiter, {}, 0);
  const ContactPatches patches = surfaces.patches_near(limiter);
  ContactShares contacts(surfaces.model(), surfaces.elements(), patches, time);
  return elements.step(limiter, contacts.of(limiter), surfaces.open(limiter));
}

/// Whether bounds show that the stable step lies in the range. Collective.
bool surely_within(const Communicator& communicator, const Surfaces& surfaces, const Elements& elements, Index limiter,
                   double time, const StepRange& range) {
  return surely_longer(communicator, surfaces, elements, range.low) &&
         communicator.min(known_step(surfaces, elements, limiter, time)) <= range.high;
}

/// The shortest step of this rank's elements, s, and where it is. Contacts are evaluated where they can shorten it.
std::pair<double, Index> shortest_step(const Surfaces& surfaces, const ContactPatches& patches,
                                       const Elements& elements, double time) {
  ContactShares contacts(surfaces.model(), surfaces.elements(), patches, time);
  std::pair<double, Index> shortest{std::numeric_limits<double>::infinity(), -1};
  elements.for_each_original([&](Index s) {
    ContactShare most;
    most.omega_squared.fill(contacts.at_most(s));
    if (!(elements.step(s, most, surfaces.open(s)) < shortest.first)) return;
    const double step = elements.step(s, contacts.of(s), surfaces.open(s));
    if (step < shortest.first) shortest = {step, s};
  });
  return shortest;
}

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
  const Surfaces surfaces(communicator, time_step, state);
  ContactPatches patches = surfaces.patches();
  patches.sort();
  parts.contacts = contact_shares(surfaces.model(), surfaces.elements(), patches, duration(parts.most, steps));
  parts.open = surfaces.model().faces.open;
  return parts;
}

double global_step_length(const Communicator& communicator, const TimeStep& time_step, const StepState& state,
                          double steps, const StepRange& range) {
  const Elements elements(communicator, time_step, state);
  if (!time_step.model().has_contact) {
    double shortest = std::numeric_limits<double>::infinity();
    elements.for_each_original([&](Index s) { shortest = std::min(shortest, elements.step(s, {}, 0)); });
    return communicator.min(shortest);
  }
  const Surfaces surfaces(communicator, time_step, state);
  const double time = duration(elements.most, steps);
  Index& limiter = time_step.memory().limiter;
  if (range.high > 0 && surely_within(communicator, surfaces, elements, limiter, time, range)) return range.low;
  const auto [shortest, slot] = shortest_step(surfaces, surfaces.patches(), elements, time);
  limiter = slot;
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
