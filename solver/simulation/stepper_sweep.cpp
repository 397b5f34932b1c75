#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "base/error.hpp"
#include "simulation/stepper.hpp"

/// The part of Stepper that takes nodes from forces to their next positions.
namespace breccia {
namespace {

/// Blocks swept between two chances for messages to move on, about 0.1 ms: a reduction needs several before it is done.
constexpr Index kLongestRun = 128;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Damping force that the sweep put on a node, N, regained from what it did to its velocity (sweep_kernel.hpp, Mover).
Vec3 damping_force(const SweepArgs& args, const Vec3& before, const Vec3& after, double mass) {
  const double half = 0.5 * args.mass_damping * args.dt;
  Vec3 force;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double net = mass * ((1.0 + half) * after[i] - (1.0 - half) * before[i]) / args.dt;  // unbalanced and local
    const double opposed = before[i] == 0.0               ? 0.0
                           : (net > 0) == (before[i] > 0) ? -args.local_damping
                                                          : args.local_damping;
    const double unbalanced = net / (1.0 + opposed);
    force[i] = net - unbalanced - 0.5 * args.mass_damping * mass * (before[i] + after[i]);
  }
  return force;
}

/// Own-node blocks only. @param pause  called now and then
void sweep_runs(SweepFunction sweep, std::span<const BlockRun> runs, SweepArgs args, SweepStatus& status,
                const auto& pause) {
  args.num_shared_blocks = 0;
  args.num_moved_nodes = 0;
  Index since_pause = 0;
  for (const BlockRun& run : runs) {
    args.first_own_block = run.first;
    args.end_own_block = run.end;
    status.add(sweep(args));
    since_pause += run.end - run.first;
    if (since_pause < kLongestRun) continue;
    since_pause = 0;
    pause();
  }
}

}  // namespace

SweepArgs Stepper::sweep_args(bool sample) {
  const LocalMesh& local = model_.local;
  SweepArgs args;
  args.end_own_block = local.num_own_originals / kLanes;
  args.num_own_blocks = local.num_own_blocks();
  args.shared_blocks = shared_blocks_.data();
  args.num_shared_blocks = static_cast<Index>(shared_blocks_.size());
  args.num_moved_nodes = local.num_moved_nodes;
  args.position = state_.position.data();
  args.next_position = state_.next_position.data();
  args.velocity = state_.velocity.data();
  args.gradient = local.gradient.data();
  args.volume = local.volume.data();
  args.node_mass = local.node_mass.data();
  args.shared_corners = shared_corners_.data();
  args.link = links_.link.data();
  args.place = links_.place.data();
  args.stiffness = links_.stiffness.data();
  args.limit = links_.limit.data();
  args.crossing = &Stepper::crossing;
  args.crossing_context = this;
  args.force_slot = forces_.slots();
  args.own_force = forces_.own();
  args.shared_force = forces_.shared();
  args.block_group = local.block_group.data();
  args.params = model_.elastic.data();
  args.dt = dt_;
  args.gravity = gravity_now_;
  args.mass_damping = mass_damping_;
  args.local_damping = local_damping_;
  args.kept_stress = kept_stress_.empty() ? nullptr : kept_stress_.data();
  // When the budget is taken, the half of the work that belongs to the time after t_n must wait.
  const auto split = [&](Field<double>& work, Field<double>& late, double*& before, double*& after) {
    if (work.empty()) return;
    if (sample) late.assign(work.size(), 0.0);
    before = work.data();
    after = sample ? late.data() : work.data();
  };
  split(viscous_, viscous_late_, args.viscous_before, args.viscous_after);
  split(stress_work_, stress_work_late_, args.stress_before, args.stress_after);
  split(damping_, damping_late_, args.damping_before, args.damping_after);
  return args;
}

/// From forces to velocities and next positions. On several ranks what others wait for is final, and on its way, before
/// the rest is begun.
void Stepper::move(const SweepArgs& args) {
  max_speed_ = 0;
  if (near_) {
    note(sweep_ahead(args));
    constrain(args);
    if (failure_) stand_still();
    send_proxies();
    note(sweep_rest(args));
    if (failure_) stand_still();
    return;
  }
  {
    const auto lap = timer_.measure(Phase::sweep);
    note(sweep_for(simd_)(args));
  }
  constrain(args);
}

void Stepper::note(const SweepStatus& status) {
  crushed_ += status.crushed;
  check_finite(status);
  max_speed_ = std::max(max_speed_, std::sqrt(status.max_speed_squared));
}

void Stepper::check_finite(const SweepStatus& status) {
  if (status.speed_squared_sum < 1e300 || failure_) return;
  std::string place;
  if (status.first_not_finite >= 0) {
    place = " near element " + std::to_string(model_.local.element_of_slot[at(status.first_not_finite) * kLanes]);
  }
  failure_ = "step " + std::to_string(steps_) + ", time " + std::to_string(time_) + " s: a velocity is not finite" +
             place +
             "; the time step is too long for what happens there: lower time.safety (or time.step), or the penalties";
  if (!reduction_) throw SimulationError(*failure_);
}

/// Velocities before the sweep of the nodes that constraints will hold: their damping has to be booked anew.
void Stepper::remember_held() {
  if (mass_damping_ <= 0 && local_damping_ <= 0) return;
  held_before_.clear();
  for (const NodalConstraint& entry : entries_) {
    for (const Index node : entry.nodes) held_before_.push_back(load_node(state_.velocity.data(), node));
  }
}

/// The sweep booked the damping of held nodes with the velocities they would have had; @param free  those
void Stepper::rebook_damping(const SweepArgs& args, const std::vector<Vec3>& free) {
  std::size_t i = 0;
  for (const NodalConstraint& entry : entries_) {
    for (const Index node : entry.nodes) {
      const Vec3 held = load_node(state_.velocity.data(), node);
      const Vec3 force = damping_force(args, held_before_[i], free[i], model_.local.node_mass[at(node)]);
      // A node that two entries hold is met twice: what is final after the first visit changes nothing at the second.
      if (rebooked_.insert(node).second) args.damping_after[at(node)] += 0.5 * dt_ * force.dot(free[i] - held);
      ++i;
    }
  }
  rebooked_.clear();
}

void Stepper::constrain(const SweepArgs& args) {
  if (constraints_.empty()) return;
  const auto lap = timer_.measure(Phase::loads);
  const bool damped = args.damping_after != nullptr && (mass_damping_ > 0 || local_damping_ > 0);
  std::vector<Vec3> free;
  for (const NodalConstraint& entry : entries_) {
    for (const Index node : entry.nodes) {
      if (damped) free.push_back(load_node(state_.velocity.data(), node));
    }
  }
  constraints_.apply(model_.local, state_, time_, dt_before_, dt_);
  if (damped) rebook_damping(args, free);
  for (const NodalConstraint& entry : entries_) {
    for (const Index node : entry.nodes) {
      if (model_.local.counted[at(node)] == 0) continue;
      max_speed_ = std::max(max_speed_, load_node(state_.velocity.data(), node).norm());
    }
  }
}

void Stepper::finish_motion(const SweepArgs& args) {
  const auto lap = timer_.measure(Phase::loads);
  if (args.kept_stress != nullptr) rate_work_for(simd_)(args);
  for (const Index node : padding_nodes_) {
    store_node(state_.velocity.data(), node, Vec3::Zero());
    store_node(state_.next_position.data(), node, load_node(state_.position.data(), node));
    if (args.damping_after != nullptr) args.damping_before[at(node)] = args.damping_after[at(node)] = 0.0;
  }
}

/// Which blocks are swept ahead of the others: those that are sent, and those that constraints hold, which are applied
/// in one go. Shared nodes are all moved with them.
void Stepper::plan_order() {
  std::vector<std::uint8_t> first = sent_;
  for (const NodalConstraint& entry : entries_) {
    for (const Index node : entry.nodes) {
      if (node < model_.local.num_own_nodes()) first[at(node / (4 * kLanes))] = 1;
    }
  }
  ahead_.clear();
  rest_.clear();
  const Index end = model_.local.num_own_originals / kLanes;
  for (Index block = 0; block < end; ++block) {
    std::vector<BlockRun>& runs = first[at(block)] != 0 ? ahead_ : rest_;
    const bool goes_on = !runs.empty() && runs.back().end == block && block - runs.back().first < kLongestRun;
    if (goes_on) {
      runs.back().end = block + 1;
    } else {
      runs.push_back({block, block + 1});
    }
  }
}

SweepStatus Stepper::sweep_ahead(const SweepArgs& args) {
  const auto lap = timer_.measure(Phase::sweep);
  SweepArgs only_shared = args;
  only_shared.end_own_block = 0;
  SweepStatus status = sweep_for(simd_)(only_shared);
  sweep_runs(sweep_for(simd_), ahead_, args, status, [] {});
  return status;
}

/// Messages move on meanwhile.
SweepStatus Stepper::sweep_rest(const SweepArgs& args) {
  const auto lap = timer_.measure(Phase::sweep);
  SweepStatus status;
  sweep_runs(sweep_for(simd_), rest_, args, status, [&] { communicator_.make_progress(); });
  return status;
}

/// What others have of this rank from now on is of some use to them.
void Stepper::stand_still() {
  state_.next_position = state_.position;
  std::fill(state_.velocity.begin(), state_.velocity.end(), 0.0);
}

}  // namespace breccia
