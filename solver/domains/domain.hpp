#pragma once

#include <array>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "base/phase_timer.hpp"
#include "contact/contact_search.hpp"
#include "discretisation/nodal_forces.hpp"
#include "domains/derived.hpp"
#include "domains/exchange.hpp"
#include "model/model.hpp"
#include "physics/initial_velocity.hpp"
#include "physics/sweep.hpp"
#include "state/energy_budget.hpp"
#include "state/records.hpp"
#include "state/state.hpp"

namespace breccia {

/// What the last sample of the energies has found, of the whole model.
struct EnergySample {
  EnergyBudget budget;
  GlobalId worst_element = -1;  ///< with the largest strain energy density; -1: none yet
};

/// Work space of a step: valid during the step and its sample for the history.
struct StepScratch {
  explicit StepScratch(const LocalMesh& local) : forces(local.num_own_blocks(), local.num_nodes) {}

  NodalForces forces;
  std::array<double, 3> gravity{0, 0, 0};                 ///< m/s2, at t_n
  std::vector<FreedFace> freed;                           ///< faces that contact gets in this step
  std::vector<std::size_t> crossed;                       ///< joints that left their elastic range in this step
  Field<double> kept_stress;                              ///< [block][18][8]
  Field<double> viscous_late, stress_late, damping_late;  ///< J, work after t_n of a step with a sample
  std::vector<Vec3> held_before, held_free;  ///< m/s, of the nodes of the constraints: before the step, free
  Field<double> velocity_before;             ///< m/s, v_(n-1/2) of the last step with a sample
};

/// Data that continue when the elements of a rank change: the model's rows of the state, and measurements.
struct Continuation {
  State state;  ///< fields of the model only (copy_model_fields)
  PhaseTimer timer;
  EnergySample sample;
};

/// A rank's part of a run: the model that never changes, the state that does, and what is derived from both. The step
/// (simulation/step.hpp) is a function over it.
struct Domain {
  /// Everything at rest. @pre model outlives this object and does not change
  Domain(const Model& model, const ContactSearchParams& search);
  /// Continues from the state of other domains. @param records  of the elements of model.mesh
  Domain(const Model& model, const ContactSearchParams& search, const Records& records, const Continuation& from);
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;

  /// From now on this rank is one of several. @pre before the first step of this object. Collective.
  void connect(const Communicator& communicator, std::vector<SharedSlots> shared, ExchangeKind kind);
  /// Near proxies, and the order of the sweep that goes with them, after couples have changed. Collective.
  void plan_exchange();

  [[nodiscard]] std::int64_t messages() const { return state.counters.messages + exchange.messages(); }
  [[nodiscard]] std::int64_t bytes() const { return state.counters.bytes + exchange.bytes(); }
  [[nodiscard]] const ContactState* contacts() const { return contact ? &state.contact : nullptr; }

  const Model& model;
  State state;
  Derived derived;
  std::unique_ptr<ContactSearch> contact;  ///< nullptr: no contact in this case
  Exchange exchange;
  PhaseTimer timer;
  EnergySample sample;
  Simd simd = best_simd();
  StepScratch scratch;
};

/// Joints that the sweep does not evaluate join the active list as they are before their first evaluation; before the
/// first step of a model that has just been divided.
void start_joints(Domain& domain);

/// Adds a velocity to the bodies of a group; before the first step.
void add_velocity(Domain& domain, const InitialVelocity& initial);

/// From now on these loads act and steps have length dt, s. Displacements count from the present positions.
void begin_stage(Domain& domain, StageLoads loads, double dt);

/// Forces on nodes that this rank moves, by constraints and by what supports absorbing boundaries, in the last step;
/// ascending nodes.
[[nodiscard]] std::vector<NodeForce> held_forces(const Domain& domain);

/// Takes the joints on these faces away; what they store is accounted as dissipated in mode I. Joints broken already
/// stay so.
void break_joints(Domain& domain, std::span<const LoadedFace> faces);

/// Joints that have left the elastic range join the active list with their history at x_n. @param crossed  in any order
void activate_joints(const Model& model, std::vector<std::size_t>& crossed, State& state, Derived& derived);

/// Work of loads, gravity and constraints on this rank up to t_n, J. Between the forces of a step and its end, or
/// between two steps.
[[nodiscard]] ExactSum external_work(const Domain& domain);

/// Receives what was sent at the end of the last step; after this no more steps. Collective.
void conclude(Domain& domain);

/// The model's rows of the state for continuation elsewhere: the work so far of the stage's loads and of gravity is
/// accounted. Between two steps; the domain is unchanged. @pre a stage has begun. O(elements)
[[nodiscard]] State closed_fields(const Domain& domain);

/// Ends the domain: the stage's loads end, and the data that continue elsewhere are returned. Collective.
[[nodiscard]] Continuation close(Domain& domain);

}  // namespace breccia
