#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "discretisation/nodal_state.hpp"
#include "model/stage_loads.hpp"
#include "physics/contact/forces.hpp"
#include "physics/contact/state.hpp"
#include "physics/joint_forces.hpp"
#include "state/element_fields.hpp"
#include "state/field_table.hpp"

namespace breccia {

/// Where the run is: t_n, and the lengths of the steps to come and done.
struct Clock {
  double time = 0;                               ///< s, t_n: of the positions
  double dt = 0, dt_before = 0, dt_earlier = 0;  ///< s: of the next step, of the last, of the one before that
  std::int64_t steps = 0;                        ///< done
};

/// What ranks send each other besides the physics; all of them receive it in the next step.
struct StepSignals {
  bool stop = false;         ///< a rank requests the end of the run
  bool broke = false;        ///< joints have broken on some rank since it was last counted
  bool checkpoint = false;   ///< a rank requests a checkpoint
  bool writing = false;      ///< some rank still writes one
  std::uint64_t orders = 0;  ///< of the root, fewer than 53 bits
};

/// How far nodes move in single steps, against the limits of domains/motion_limit.hpp.
struct StepMotion {
  double own = 0, own_before = 0;   ///< m, furthest of this rank's nodes in the last step and in the one before it
  double known = 0;                 ///< m, furthest of all ranks' nodes in known_step
  std::int64_t known_step = -2;     ///< the last step whose furthest motion is known; -1: before the first
  std::int64_t stage_step = 0;      ///< first step of the present stage
  std::int64_t exceeded_step = -1;  ///< in which a node of any rank exceeded a limit; -1: none
  double exceeded = 0;              ///< m, its motion in that step
  // Of this rank's fastest node in the last even and the last odd step in which it may have exceeded one.
  std::array<std::int64_t, 2> fastest_step{-1, -1};
  std::array<GlobalId, 2> fastest_node{-1, -1};
  std::array<double, 2> fastest_speed{0, 0};  ///< m/s
};

/// What a rank sends to all others at the end of a step, and what it has received.
struct Signals {
  StepSignals received;                 ///< sent by the ranks a step ago, alike on all of them
  StepSignals sent;                     ///< by this rank in the last step
  double max_speed = 0;                 ///< m/s, of the nodes that this rank moves, after the last step
  double motion = 0;                    ///< m, largest motion of a node of any rank in a step, received with delay
  double fastest = 0;                   ///< m/s, largest max_speed of all ranks, received with delay
  std::int64_t fastest_step = -1;       ///< the step after which it was that; -1: before the first
  bool released = false;                ///< joints of some rank were released in the last step
  std::vector<GlobalId> released_here;  ///< joints of this rank that were released in the last step
  StepMotion step_motion;
};

/// On several ranks, after a step, so many of the last are not in Signals::motion yet.
inline constexpr int kMotionLate = 2;

/// The joints that the sweep does not evaluate.
struct JointSet {
  ActiveJoints active;
  std::vector<ReleasedJoint>
      released;             ///< of side a here: their faces belong to contact; in the order of their release
  std::int64_t broken = 0;  ///< of side a here: no longer hold, released or not
};

/// Work done up to now, J: this rank's part of exact sums, so that totals do not depend on who holds what.
struct AccountedWork {
  ExactSum past_loads;  ///< by loads, constraints and supports of earlier stages
  GravityWork gravity;
  JointWork joints;
  ContactWork contact;
  double first_excess = std::numeric_limits<double>::quiet_NaN();  ///< energy beyond external work, first sample
  double step_change = 0;  ///< moved within stages, where the step changed; of the whole model
};

/// Sums over the run, this rank's part; searches are the same on all ranks.
struct Counters {
  std::int64_t crushed = 0;              ///< element-steps with J below its floor
  std::int64_t searches = 0;             ///< for contact
  std::int64_t messages = 0, bytes = 0;  ///< sent to gather proxies
};

/// Everything on a rank that changes between two steps. What can be derived from it (links, plans, orders) is in
/// domains/derived.hpp.
struct State {
  Clock clock;
  NodalState nodes;
  Field<double> damping_work;  ///< (num_nodes) J dissipated by damping; empty without damping
  ElementFields elements;
  JointSet joints;
  ContactState contact;
  StageLoads loads;  ///< of the present stage, with their work and the anchors of displacements
  Constraints constraints;
  AbsorbingBoundary absorbing;
  std::vector<NodeForce> held;   ///< forces that constraints and absorbing boundaries put on nodes in the last step
                                 ///< before these, ascending nodes
  std::int64_t held_before = 0;  ///< the step that was to come then
  AccountedWork work;
  Counters counters;
  Signals signals;
};

/// The rows of the table that belong to the model, not to an element. Sums are this rank's part; what is marked as
/// hashed is alike on all ranks, or its total is.
template <>
struct FieldTable<State> {
  // clang-format off
  static constexpr auto rows = std::tuple{
      FieldRow{"time", "s", kState, [](auto& s) -> auto& { return s.clock.time; }},
      FieldRow{"step_length", "s", kState, [](auto& s) -> auto& { return s.clock.dt; }},
      FieldRow{"last_step_length", "s", kState, [](auto& s) -> auto& { return s.clock.dt_before; }},
      FieldRow{"step_length_before_last", "s", kNotHashed, [](auto& s) -> auto& { return s.clock.dt_earlier; }},
      FieldRow{"steps", "1", kState, [](auto& s) -> auto& { return s.clock.steps; }},
      FieldRow{"broken_joints", "1", kSummed, [](auto& s) -> auto& { return s.joints.broken; }},
      FieldRow{"work_of_past_loads", "J", kSumNotHashed, [](auto& s) -> auto& { return s.work.past_loads; }},
      FieldRow{"work_of_past_gravity", "J", kSumNotHashed, [](auto& s) -> auto& { return s.work.gravity.past; }},
      FieldRow{"gravity", "m/s2", kNotHashed, [](auto& s) -> auto& { return s.work.gravity.gravity; }},
      FieldRow{"gravity_started", "1", kNotHashed, [](auto& s) -> auto& { return s.work.gravity.started; }},
      FieldRow{"gravity_changing", "1", kNotHashed, [](auto& s) -> auto& { return s.work.gravity.changing; }},
      FieldRow{"joint_mode_1", "J", kSummed, [](auto& s) -> auto& { return s.work.joints.mode_1; }},
      FieldRow{"joint_mode_2", "J", kSummed, [](auto& s) -> auto& { return s.work.joints.mode_2; }},
      FieldRow{"joint_friction", "J", kSummed, [](auto& s) -> auto& { return s.work.joints.friction; }},
      FieldRow{"joint_viscous", "J", kSummed, [](auto& s) -> auto& { return s.work.joints.viscous; }},
      FieldRow{"contact_dissipated", "J", kSummed, [](auto& s) -> auto& { return s.work.contact.dissipated; }},
      FieldRow{"contact_friction", "J", kSummed, [](auto& s) -> auto& { return s.work.contact.friction_dissipated; }},
      FieldRow{"contact_stored", "J", kSummed, [](auto& s) -> auto& { return s.work.contact.stored; }},
      FieldRow{"friction_stored", "J", kSummed, [](auto& s) -> auto& { return s.work.contact.friction_stored; }},
      FieldRow{"touching", "1", kSumNotHashed, [](auto& s) -> auto& { return s.work.contact.touching; }},
      FieldRow{"first_excess", "J", kNotHashed, [](auto& s) -> auto& { return s.work.first_excess; }},
      FieldRow{"step_change", "J", kNotHashed, [](auto& s) -> auto& { return s.work.step_change; }},
      FieldRow{"crushed", "1", kSummed, [](auto& s) -> auto& { return s.counters.crushed; }},
      FieldRow{"searches", "1", kNotHashed, [](auto& s) -> auto& { return s.counters.searches; }},
      FieldRow{"messages", "1", kSumNotHashed, [](auto& s) -> auto& { return s.counters.messages; }},
      FieldRow{"message_bytes", "1", kSumNotHashed, [](auto& s) -> auto& { return s.counters.bytes; }},
      FieldRow{"max_speed", "m/s", kLargest, [](auto& s) -> auto& { return s.signals.max_speed; }},
      FieldRow{"stop_received", "1", kPassing, [](auto& s) -> auto& { return s.signals.received.stop; }},
      FieldRow{"broke_received", "1", kPassing, [](auto& s) -> auto& { return s.signals.received.broke; }},
      FieldRow{"checkpoint_received", "1", kPassing, [](auto& s) -> auto& { return s.signals.received.checkpoint; }},
      FieldRow{"writing_received", "1", kPassing, [](auto& s) -> auto& { return s.signals.received.writing; }},
      FieldRow{"orders_received", "1", kPassing, [](auto& s) -> auto& { return s.signals.received.orders; }},
      FieldRow{"stop_sent", "1", kPassing, [](auto& s) -> auto& { return s.signals.sent.stop; }},
      FieldRow{"broke_sent", "1", kPassing, [](auto& s) -> auto& { return s.signals.sent.broke; }},
      FieldRow{"checkpoint_sent", "1", kPassing, [](auto& s) -> auto& { return s.signals.sent.checkpoint; }},
      FieldRow{"writing_sent", "1", kPassing, [](auto& s) -> auto& { return s.signals.sent.writing; }},
      FieldRow{"orders_sent", "1", kPassing, [](auto& s) -> auto& { return s.signals.sent.orders; }},
      FieldRow{"own_motion", "m", kLargest, [](auto& s) -> auto& { return s.signals.step_motion.own; }},
      FieldRow{"own_motion_before", "m", kLargest, [](auto& s) -> auto& { return s.signals.step_motion.own_before; }},
      FieldRow{"known_motion", "m", kNotHashed, [](auto& s) -> auto& { return s.signals.step_motion.known; }},
      FieldRow{"known_motion_step", "1", kNotHashed, [](auto& s) -> auto& { return s.signals.step_motion.known_step; }},
      FieldRow{"stage_step", "1", kNotHashed, [](auto& s) -> auto& { return s.signals.step_motion.stage_step; }},
      FieldRow{"exceeded_step", "1", kNotHashed, [](auto& s) -> auto& { return s.signals.step_motion.exceeded_step; }},
      FieldRow{"exceeded_motion", "m", kNotHashed, [](auto& s) -> auto& { return s.signals.step_motion.exceeded; }},
      FieldRow{"fastest_steps", "1", kPassing, [](auto& s) -> auto& { return s.signals.step_motion.fastest_step; }},
      FieldRow{"fastest_nodes", "1", kPassing, [](auto& s) -> auto& { return s.signals.step_motion.fastest_node; }},
      FieldRow{"fastest_speeds", "m/s", kPassing, [](auto& s) -> auto& { return s.signals.step_motion.fastest_speed; }},
      FieldRow{"released", "1", kNotHashed, [](auto& s) -> auto& { return s.signals.released; }},
      FieldRow{"released_here", "1", kList, [](auto& s) -> auto& { return s.signals.released_here; }},
  };
};
// clang-format on

/// Gives `to` the model's rows of `from`: for a rank whose elements change.
inline void copy_model_fields(const State& from, State& to) {
  for_each_field(from, [&](const auto& row, const auto& value) { row.access(to) = value; });
}

}  // namespace breccia
