#include "domains/motion_limit.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/number_text.hpp"

namespace breccia {
namespace {

constexpr double kFurthest = 0.5;  ///< share of H

double contactor_size(const Domain& domain) { return domain.contact->searches().contactor_size(); }

double unforeseen_share(const Domain& domain, std::int64_t step) {
  return step == domain.state.signals.step_motion.stage_step ? kUnforeseenAtStart : kUnforeseen;
}

/// @param motion, before  m, furthest in the step and in the one before it
bool exceeds(const Domain& domain, std::int64_t step, double motion, double before) {
  const double size = contactor_size(domain);
  return motion > kFurthest * size || motion > 2 * before + unforeseen_share(domain, step) * size;
}

std::string name_of_node(GlobalId node) {
  if (node < 0) return "a node";
  if (node >= kFirstSharedNode) return "node " + std::to_string(mesh_node_of(node));
  return "corner " + std::to_string(node % 4) + " of element " + std::to_string(node / 4);
}

std::string number(double value) { return number_text(value, 4); }

}  // namespace

FastestNode fastest_node(const Domain& domain) {
  const LocalMesh& local = domain.model.local;
  FastestNode fastest;
  for (Index n = 0; n < local.num_nodes; ++n) {
    if (!local.is_moved(n) || local.node_id[static_cast<std::size_t>(n)] < 0) continue;
    const Vec3 v = load_node(domain.state.nodes.velocity.data(), n);
    const double speed = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const GlobalId id = local.node_id[static_cast<std::size_t>(n)];
    if (fastest.node < 0 || speed > fastest.speed || (speed == fastest.speed && id < fastest.node))
      fastest = {id, speed};
  }
  return fastest;
}

double unforeseen_motion(const Domain& domain, int unknown) {
  if (!domain.contact || domain.exchange.alone()) return 0;
  const std::int64_t in_stage = domain.state.clock.steps - domain.state.signals.step_motion.stage_step;
  const bool at_start = 1 <= in_stage && in_stage <= unknown;
  return (at_start ? kUnforeseenAtStart : kUnforeseen) * contactor_size(domain);
}

void note_motion(Domain& domain) {
  if (!domain.contact) return;
  State& state = domain.state;
  StepMotion& motion = state.signals.step_motion;
  motion.own_before = motion.own;
  motion.own = state.signals.max_speed * state.clock.dt;
  if (!exceeds(domain, state.clock.steps, motion.own, motion.own_before)) return;
  const auto place = static_cast<std::size_t>(state.clock.steps % 2);
  const FastestNode fastest = fastest_node(domain);
  motion.fastest_step[place] = state.clock.steps;
  motion.fastest_node[place] = fastest.node;
  motion.fastest_speed[place] = fastest.speed;
}

namespace {

/// The furthest motion of a step is known from now on.
void record_length(Domain& domain, std::int64_t step, double length) {
  StepMotion& motion = domain.state.signals.step_motion;
  if (step >= 0 && motion.exceeded_step < 0 && exceeds(domain, step, length, motion.known)) {
    motion.exceeded_step = step;
    motion.exceeded = length;
  }
  motion.known_step = step;
  motion.known = length;
}

}  // namespace

void record_received_motion(Domain& domain) {
  if (!domain.contact) return;
  const Clock& clock = domain.state.clock;
  const Signals& signals = domain.state.signals;
  const std::int64_t step = signals.fastest_step;
  // Before the first step a division may already have sent the speeds, but not yet the length of that step.
  if (clock.steps > 0 && step <= signals.step_motion.known_step) return;
  const bool last = step == clock.steps - 1;
  const double length = signals.fastest * (clock.steps == 0 ? clock.dt : last ? clock.dt_before : clock.dt_earlier);
  record_length(domain, step, length);
}

void record_motion_before_last(Domain& domain) {
  if (!domain.contact) return;
  const StepMotion& motion = domain.state.signals.step_motion;
  const std::int64_t step = domain.state.clock.steps - 2;
  if (step <= motion.known_step) return;
  record_length(
      domain, step,
      step < 0 ? motion.own : motion.own_before);  // before the first step all move at their initial velocities
}

namespace {

/// @pre a node has exceeded the limit in one of the last two steps. Collective.
[[noreturn]] void refuse_motion(const Domain& domain) {
  const StepMotion& motion = domain.state.signals.step_motion;
  const Clock& clock = domain.state.clock;
  const double dt = motion.exceeded_step == clock.steps - 1 ? clock.dt_before : clock.dt_earlier;
  const Communicator& communicator = domain.exchange.communicator();
  const auto place = static_cast<std::size_t>(motion.exceeded_step % 2);
  const bool mine = motion.fastest_step[place] == motion.exceeded_step;
  const double speed = communicator.max(mine ? motion.fastest_speed[place] : 0.0);
  constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();
  const std::int64_t node =
      communicator.max(mine && motion.fastest_speed[place] == speed ? -motion.fastest_node[place] : kNone);
  const double size = contactor_size(domain), length = motion.exceeded;
  const bool far = length > kFurthest * size;
  throw SimulationError(
      "step " + std::to_string(motion.exceeded_step) + ": " + name_of_node(node == kNone ? -1 : -node) + " moves by " +
      number(length) + " m in one step, at " + number(length / dt) + " m/s, " +
      (far ? "more than half the mean size of what may touch (" + number(size) + " m): contacts would be missed"
           : "much further than any node in the previous step: contacts may be detected with a delay") +
      "; lower time.safety (or time.step), or the penalties, or accelerate driven groups gradually");
}

}  // namespace

void check_motion(const Domain& domain) {
  const StepMotion& motion = domain.state.signals.step_motion;
  if (motion.exceeded_step < 0 || domain.state.clock.steps < motion.exceeded_step + 2) return;
  refuse_motion(domain);
}

void check_last_motion(Domain& domain) {
  const Clock& clock = domain.state.clock;
  if (!domain.contact || clock.steps == 0) return;
  const StepMotion& motion = domain.state.signals.step_motion;
  const double last = domain.exchange.communicator().max(motion.own);
  if (clock.steps - 1 > motion.known_step) record_length(domain, clock.steps - 1, last);
  if (motion.exceeded_step >= 0) refuse_motion(domain);
}

}  // namespace breccia
