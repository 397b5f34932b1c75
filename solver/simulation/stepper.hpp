#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/phase_timer.hpp"
#include "model/model.hpp"
#include "model/stage_loads.hpp"
#include "output/frame.hpp"
#include "parallel/communicator.hpp"
#include "parallel/halo.hpp"
#include "physics/energy.hpp"
#include "physics/initial_velocity.hpp"
#include "physics/joint_forces.hpp"
#include "physics/sweep.hpp"
#include "simulation/contact_search.hpp"
#include "simulation/records.hpp"
#include "state/nodal_forces.hpp"
#include "state/state.hpp"

namespace breccia {

/// What ranks send each other besides the physics; all of them receive it in the next step.
struct StepSignals {
  bool stop = false;         ///< some rank asks for the end of the run
  bool broke = false;        ///< joints have broken on some rank since it was last counted
  std::uint64_t orders = 0;  ///< of the root, fewer than 53 bits
};

/// Blocks first .. end - 1.
struct BlockRun {
  Index first, end;
};

/// What a rank keeps when its elements change: clock and accumulated work. Sums over ranks do not depend on who holds
/// what.
struct Accumulators {
  double time = 0, dt = 0, dt_before = 0;  ///< s
  double max_speed = 0;                    ///< m/s
  PhaseTimer timer;
  std::int64_t steps = 0, crushed = 0, broken_joints = 0, searches = 0;
  std::int64_t messages = 0, bytes = 0;  ///< sent to gather proxies
  ExactSum past_external;                ///< J, work of loads and constraints up to now
  GravityWork::Carried gravity;
  JointWork joint_work;
  ContactWork contact_work;
  StepSignals signals, pending_signals;  ///< received in the last step; sent in it and not received yet
  std::vector<GlobalId> released;        ///< joints whose release other ranks have not received yet
  std::optional<double> first_total;     ///< J, energy minus external work of the whole model at the first sample
  EnergyBudget budget;                   ///< of the last sample
};

/// The conductor of one step: owns everything that changes, calls the kernels in their order, computes nothing itself.
///
/// Step n takes x_n, v_(n-1/2) to x_(n+1), v_(n+1/2):
///  1. couples: a new search if one is due; joints that came apart a step ago hand over their faces to contact, all
///  ranks having
///     heard of them meanwhile;
///  2. forces: pressure on faces, then the active joints, by ascending ids, then every couple, by ascending ids;
///  3. the sweep: every element's internal forces, its side of its intact joints, and the motion of its nodes;
///  constraints;
///  4. joints that have left their elastic range join the active list, those that are back in it leave it;
///  5. proxies are gathered from their originals.
///
/// On several ranks the sweep begins with the elements that others wait for, which leave at once, as does, before the
/// sweep, what ranks have to tell each other. So a rank waits for another only where that is behind by the rest of a
/// sweep. What the sweep finds out, speeds and failures, is heard two steps later: a rank that has failed stands still
/// until then.
///
/// On several ranks a rank computes the forces on its originals, nothing else: joints and couples with an element of
/// another rank are computed on both, from the same numbers in the same order. Of its proxies only the near ones are
/// gathered in every step, those that share a joint or a couple with an original, the former without velocities. Before
/// a search those are that have come near to the originals of the rank; after it, and when joints that came apart bring
/// elements of two ranks into couples, ranks tell each other what the points of their elements touch.
class Stepper {
 public:
  /// @pre model outlives this object and does not change.
  Stepper(const Model& model, const ContactSearchParams& search);
  /// Goes on where others stopped. @param records  of the elements of model.mesh
  Stepper(const Model& model, const ContactSearchParams& search, const Records& records, Accumulators accumulators);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// Adds a velocity to the bodies of a group; before the first step.
  void add_velocity(const InitialVelocity& initial) {
    add_initial_velocity(model_.local, initial, state_.position, state_.velocity);
  }

  /// From now on these loads act and steps have length dt, s. Displacements count from the present positions.
  void begin_stage(StageLoads loads, double dt);
  /// Length of the steps from now on, s.
  void set_dt(double dt) { dt_ = dt; }
  /// Takes the joints on these faces away; what they store is booked as dissipated in mode I. Joints broken already
  /// stay so.
  void break_joints(std::span<const LoadedFace> faces);

  /// All that this rank's originals remember, ascending; between two steps.
  [[nodiscard]] Records records() const;
  /// Clock and accumulated work as of now. The stage's loads end with it.
  [[nodiscard]] Accumulators close();
  /// After begin_stage of a stage that had begun before: displacements count from where they did.
  void restore_holds(const Records& records);

  /// From now on this rank is one of several. @pre before the first step of this object. Collective.
  void connect(const Communicator& communicator, const std::vector<SharedElements>& shared, ExchangeKind kind);

  /// Hears what was said at the end of the last step; after this no more steps. Collective.
  void conclude();

  /// One step. With `sample`, the energy budget at t_n is taken on the way: budget(). Collective.
  /// @param signals  of this rank, received by all a step later: signals()
  /// Throws SimulationError on all ranks when a velocity was not finite: on a rank that is alone, and when a budget is
  /// taken, in that step, else in the one after the next, or in conclude().
  void step(bool sample, const StepSignals& signals = {});

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] double time() const { return time_; }          ///< s, t_n: of position
  [[nodiscard]] double dt() const { return dt_; }              ///< s
  [[nodiscard]] std::int64_t steps() const { return steps_; }  ///< done
  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const ActiveJoints& active_joints() const { return active_; }
  [[nodiscard]] const ContactSearch* contact() const { return contact_.get(); }  ///< nullptr: no contact in this case
  [[nodiscard]] const ContactWork& contact_work() const { return contact_work_; }
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }
  [[nodiscard]] PhaseTimer& timer() { return timer_; }
  [[nodiscard]] const PhaseTimer& timer() const { return timer_; }
  [[nodiscard]] double max_speed() const { return max_speed_; }  ///< m/s, of the rank's originals after the last step
  [[nodiscard]] const StepSignals& signals() const {
    return signals_;
  }  ///< what ranks sent a step ago, alike on all of them
  /// Furthest that a node of any rank went, m, in the last step but one; on several ranks in the one before that.
  [[nodiscard]] double motion_anywhere() const { return motion_anywhere_; }
  /// On several ranks, after a step, so many of the last are not in motion_anywhere() yet.
  static constexpr int kLateAfter = 2;
  [[nodiscard]] std::int64_t messages() const;  ///< that gathered this rank's originals so far
  [[nodiscard]] std::int64_t bytes() const;     ///< in them
  [[nodiscard]] const std::vector<SharedSlots>& shared_slots() const { return shared_; }
  [[nodiscard]] const Communicator& communicator() const { return communicator_; }
  [[nodiscard]] std::int64_t crushed() const { return crushed_; }  ///< element-steps with J below its floor
  [[nodiscard]] std::int64_t searches() const { return searches_before_ + (contact_ ? contact_->num_searches() : 0); }
  [[nodiscard]] Simd simd() const { return simd_; }
  void use_simd(Simd simd) { simd_ = simd; }

  [[nodiscard]] const JointLinks& links() const { return links_; }
  /// Whether the face had a joint when the model was built.
  [[nodiscard]] bool has_joint(Index slot, int face) const {
    return joint_of_face_[static_cast<std::size_t>(slot) * 4 + static_cast<std::size_t>(face)] >= 0;
  }
  /// Whether it has an intact one that the sweep looks after.
  [[nodiscard]] bool swept(Index slot, int face) const {
    return slot < model_.local.num_own_slots && JointLinks::code_of(links_.link[JointLinks::at(slot, face)]) < 12;
  }
  /// Joints of this rank (side a) that have failed and opened.
  [[nodiscard]] const std::vector<ReleasedJoint>& released_joints() const { return released_; }
  /// Joints of this rank (side a) that no longer hold, opened or not.
  [[nodiscard]] std::int64_t broken_joints() const { return broken_joints_; }

  /// Budget of the whole model at the last sampled step; residual against the first sample.
  [[nodiscard]] const EnergyBudget& budget() const { return budget_; }
  /// Element of the whole model with the largest strain energy density at the last sample, -1: none.
  [[nodiscard]] GlobalId worst_element() const { return worst_element_; }

 private:
  Stepper(const Model& model, std::nullptr_t);
  void index_joints();
  void start_joints();
  void restore_elements(const Records& records);
  void restore_joints(const Records& records);
  void detach(Index slot, int face);
  void remember_joints(Records& records) const;
  void remember_holds(Records& records) const;
  [[nodiscard]] ActiveJoint make_active(std::size_t joint) const;
  void external_forces();
  void joint_forces();
  void find_relevant();
  void find_joined();
  [[nodiscard]] bool relevant(Index slot) const { return relevant_[static_cast<std::size_t>(slot)] != 0; }
  [[nodiscard]] Index element_with(GlobalId id) const;
  [[nodiscard]] std::vector<HaloNeighbour> halo_plan(const std::vector<SharedSlots>& shared) const;
  [[nodiscard]] std::vector<std::uint8_t> near_slots() const;
  [[nodiscard]] std::vector<std::uint8_t> moving_slots() const;
  void plan_near();
  void receive_releases();
  void receive_positions(double distance);
  void exchange_touching();
  void update_contact();
  void finish_reduction();
  void begin_reduction();
  void contact_forces();
  [[nodiscard]] SweepArgs sweep_args(bool sample);
  void move(const SweepArgs& args);
  void plan_order();
  [[nodiscard]] SweepStatus sweep_ahead(const SweepArgs& args);
  [[nodiscard]] SweepStatus sweep_rest(const SweepArgs& args);
  void note(const SweepStatus& status);
  void send_proxies();
  void receive_proxies();
  void gather(Halo& halo, Field<double>& position);
  [[nodiscard]] const SharedSlots& neighbour(int rank) const;
  void remember_held();
  void rebook_damping(const SweepArgs& args, const std::vector<Vec3>& free);
  void check_finite(const SweepStatus& status);
  void stand_still();
  void agree_on_failure();
  void constrain(const SweepArgs& args);
  void finish_motion(const SweepArgs& args);
  void activate_crossing();
  void return_elastic();
  void take_budget(const Field<double>& velocity_before);
  void find_worst(const ElasticEnergy& elastic);
  [[nodiscard]] ExactSum external_work() const;
  void book_after(bool sample);
  static void crossing(void* context, Index slot, int face, double* force);

  const Model& model_;
  State state_;
  JointLinks links_;
  std::vector<Index> joint_of_face_;  ///< (slots, 4) index of the joint, -1: none
  ActiveJoints active_;
  std::vector<ReleasedJoint> released_;  ///< whose faces belong to contact, in the order of their release
  std::vector<std::uint8_t> relevant_;   ///< (slots) 1: forces on its nodes are computed here: originals, and elements
                                         ///< with which they share nodes
  std::vector<std::uint8_t> joined_;     ///< (slots) 1: these, and elements that had a joint with them at first
  std::vector<GlobalId> releasing_;      ///< joints of this rank that came apart in the last step
  std::vector<FreedFace> freed_;         ///< faces that contact gets in this step
  std::vector<std::size_t> crossed_;     ///< joints that left their elastic range in this step
  std::int64_t broken_joints_ = 0;
  NodalForces forces_;
  std::unique_ptr<ContactSearch> contact_;

  std::vector<PressureLoad> pressures_;
  std::vector<NodalConstraint> entries_;
  Constraints constraints_;
  std::array<TimeFunction, 3> gravity_;
  std::array<double, 3> gravity_now_{0, 0, 0};
  GravityWork gravity_work_;
  double mass_damping_ = 0, local_damping_ = 0;

  double time_ = 0, dt_ = 0, dt_before_ = 0, dt_earlier_ = 0;
  std::int64_t steps_ = 0, crushed_ = 0, searches_before_ = 0;
  double max_speed_ = 0, motion_anywhere_ = 0;
  Simd simd_;

  Communicator communicator_;          ///< alone unless connected
  std::vector<SharedSlots> shared_;    ///< with every neighbour
  std::unique_ptr<Halo> near_;         ///< proxies that forces here depend on; none when alone
  std::unique_ptr<Halo> all_;          ///< all of them, where the case wants couples verified
  std::vector<std::uint8_t> current_;  ///< (slots) 1: near enough to be searched, and where it is now
  ExchangeKind exchange_ = ExchangeKind::non_blocking;
  bool news_ = false;                      ///< some rank's joints came apart
  std::int64_t messages_ = 0, bytes_ = 0;  ///< of halos that are gone
  std::optional<PendingReduction> reduction_;
  std::optional<std::string> failure_;  ///< of this rank, not heard yet
  StepSignals sent_signals_, signals_;  ///< by this rank in the last step, by all in the one before

  // Accumulated work, J.
  ExactSum past_external_;  ///< work of the loads and constraints of earlier stages
  JointWork joint_work_;
  ContactWork contact_work_;
  bool viscous_on_ = false, stress_work_on_ = false;
  Field<double> viscous_, stress_work_;  ///< (num_slots) when wanted, else empty
  Field<double> damping_;                ///< (num_nodes) once damping has been asked for
  Field<double> viscous_late_, stress_work_late_, damping_late_;
  std::optional<double> first_total_;  ///< energy minus external work at the first sample
  EnergyBudget budget_;
  GlobalId worst_element_ = -1;

  // For the sweep.
  std::vector<Index> shared_corners_;   ///< [shared block][4][8]
  std::vector<Index> shared_blocks_;    ///< shared-node blocks with an element that matters here
  std::vector<std::uint8_t> sent_;      ///< (own-node blocks) 1: with an element that others wait for
  std::vector<BlockRun> ahead_, rest_;  ///< own-node blocks of originals: swept before the others, and the others
  Field<double> kept_stress_;           ///< [block][18][8]
  std::vector<Vec3> held_before_;       ///< of the nodes of all constraints in turn, m/s
  std::set<Index> rebooked_;
  std::vector<Index> padding_nodes_;
  PhaseTimer timer_;
};

}  // namespace breccia
