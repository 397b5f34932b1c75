// How often pipelines that keep below a budget are executed: InSitu's part that spaces them evenly over the run.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "output/insitu/insitu.hpp"

namespace breccia {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// What an execution leaves behind.
const char* thing_of(const std::string& pipeline) {
  if (case_::is_script(pipeline)) return "turn";
  return case_::draws_pictures(pipeline) ? "picture" : "record";
}

}  // namespace

PaceState InSitu::pace_state(const Pipeline& p) const {
  const double interval = p.interval > 0 ? p.interval : p.trigger.distance(now_.dt);
  const auto steps = static_cast<double>(first_.step + most_steps_ - now_.step);
  const double last = most_steps_ > 0 ? now_.time + steps * now_.dt : kInfinite;
  PaceState state{now_.time, *begin_, std::min(end_, last), p.last, elapsed(), starts(), interval};
  state.least = p.least;
  state.spent = p.overhead.start() + p.overhead.spent();
  state.cost = p.overhead.cost();
  state.done = p.overhead.times();
  return state;
}

/// Shares of the wall time that pipelines may take: even parts, but what some do not need goes to the others.
std::vector<double> InSitu::shares() const {
  std::vector<double> asked;
  double wall = 0;
  for (const Pipeline& p : pipelines_) {
    if (p.strict || p.name == "live") {
      asked.push_back(0);
      continue;
    }
    const PaceState state = pace_state(p);
    wall = expected_wall(state);
    const double times = (state.end - state.now) / state.interval;
    asked.push_back(p.even && state.cost > 0 ? state.spent + times * state.cost : kInfinite);
  }
  std::vector<double> parts = parts_of_budget(std::max(share_ * wall - opening_, 0.0), asked);
  for (double& part : parts) part = wall > 0 ? part / wall : 0.0;
  return parts;
}

/// Now and then all are planned anew: the run may have become slower, which affords more.
void InSitu::space_anew(const Moment& now) {
  if (now.time < next_spacing_) return;
  const double distance = (end_ - first_.time) / Trigger::kTimes;
  next_spacing_ = (std::floor(now.time / distance) + 1) * distance;
  now_ = now;
  std::uint32_t known = 0;
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    if (pipelines_[i].overhead.times() >= 2) known |= std::uint32_t{1} << i;
  }
  space(known);
}

/// Plans the next execution of even ones. Collective.
void InSitu::space(std::uint32_t pipelines) {
  std::vector<double> part(pipelines_.size(), 0.0);
  if (communicator_.is_root() && now_.time > *begin_) part = shares();
  for (std::size_t i = 0; i < pipelines_.size(); ++i) {
    Pipeline& p = pipelines_[i];
    if (!p.even || (pipelines >> i & 1U) == 0) continue;
    if (p.overhead.times() < 2) {  // once more, so that its cost is known
      p.not_before = now_.time + p.interval;
    } else if (now_.time > *begin_ && now_.time < end_) {
      space_one(p, part[i]);
    }
  }
}

void InSitu::space_one(Pipeline& p, double share) {
  PaceState state = pace_state(p);
  state.share = share;
  Spacing spacing{.next = kInfinite};
  if (communicator_.is_root() && state.end > state.last) spacing = spaced_evenly(state);
  std::array<double, 6> roots{spacing.next,  spacing.distance, static_cast<double>(spacing.times),
                              spacing.share, state.share,      state.interval};
  if (!communicator_.is_root()) roots.fill(-kInfinite);
  communicator_.max(roots);
  spacing = {roots[0], roots[1], static_cast<std::int64_t>(roots[2]), roots[3]};
  state.share = roots[4];
  state.interval = roots[5];
  if (p.interval > 0) {
    p.not_before = spacing.next;
  } else {  // the trigger's instant that is nearest
    p.not_before = spacing.next - 0.5 * state.interval;
  }
  if (spacing.times == 0) return;
  if (!p.told) tell_(pace_text(p.name, thing_of(p.name), spacing, state), true);
  p.told = true;
}

}  // namespace breccia
