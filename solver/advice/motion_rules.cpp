#include "advice/rule_functions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "advice/constraint_words.hpp"
#include "advice/solids.hpp"
#include "base/index.hpp"
#include "base/quantity_text.hpp"

namespace breccia {
namespace {

/// Share of a stage over which the speed of a displacement is measured.
constexpr double kMoment = 1e-6;

/// Velocity that an entry prescribes along an axis, m/s, just after (moment > 0) or before a time.
double prescribed(const case_::Constraint& entry, std::size_t axis, double time, double moment) {
  const TimeFunction& value = entry.value[axis];
  switch (entry.kind) {
    case case_::ConstraintKind::fixed:
      break;
    case case_::ConstraintKind::velocity:
      return value(time);
    case case_::ConstraintKind::displacement:
      return (value(time + moment) - value(time)) / moment;
  }
  return 0;
}

/// A stage with the one before it and the times between which it acts, s.
struct StageTimes {
  const case_::Stage& stage;
  const case_::Stage* before;
  double begun, start;  ///< starts of the one before and of this one
};

/// Velocity of what an entry drives before its stage, along an axis, m/s; nothing: unknown.
std::optional<double> velocity_before(const case_::Case& input, const StageTimes& times, const Solids& solids,
                                      const Model& model, const case_::Constraint& entry, std::size_t axis) {
  std::optional<double> found;
  if (times.before != nullptr) {
    for (const case_::Constraint& last : times.before->constraints) {
      if (last.group == entry.group && last.axes[axis])
        found = prescribed(last, axis, times.start, -kMoment * (times.start - times.begun));
    }
    return found;
  }
  if (input.start) return found;
  std::string group;
  solids.for_each_element(
      entry.group, [&](Index e, bool) { group = model.mesh.volume_groups[at(model.mesh.element_group[at(e)])]; });
  found = 0.0;
  for (const case_::InitialVelocity& initial : input.initial_velocities) {
    if (initial.group != group || !found) continue;
    const bool even = initial.random[1] == 0 && initial.angular.isZero() && initial.strain_rate.isZero();
    found = even ? std::optional(*found + initial.velocity[static_cast<Eigen::Index>(axis)]) : std::nullopt;
  }
  return found;
}

/// The jump with which an entry begins.
struct Jump {
  const case_::Constraint* entry = nullptr;
  double speed = 0;  ///< m/s
  std::size_t axis = 0;
  double velocity = 0;  ///< m/s along that axis, the fastest one

  double stress = 0, share = 0;  ///< Pa, and of the strength
  std::string joints;
  double crossing = 0;  ///< s, of a wave through the slowest solid reached
  double start = 0;     ///< s
};

Jump jump_of(const case_::Case& input, const StageTimes& times, const Solids& solids, const Model& model,
             const case_::Constraint& entry) {
  Jump jump{.entry = &entry, .joints = {}, .start = times.start};
  Vec3 change = Vec3::Zero();
  for (std::size_t a = 0; a < 3; ++a) {
    const auto i = static_cast<Eigen::Index>(a);
    if (!entry.axes[a] || entry.kind == case_::ConstraintKind::fixed) continue;
    const double velocity = prescribed(entry, a, times.start, kMoment * (times.stage.end - times.start));
    const std::optional<double> before = velocity_before(input, times, solids, model, entry, a);
    if (!before) continue;
    change[i] = velocity - *before;
    if (std::abs(change[i]) >= change.cwiseAbs().maxCoeff()) {  // so far
      jump.axis = a;
      jump.velocity = velocity;
    }
  }
  jump.speed = change.norm();
  return jump;
}

/// Groups that the wave of an entry comes to: in the solids that it drives, and in those that lie on them.
/// @param jump  its crossing is set
std::vector<bool> groups_reached(const Model& model, Solids& solids, Jump& jump) {
  std::vector<bool> reached(solids.end(), false), groups(model.mesh.volume_groups.size(), false);
  std::vector<std::size_t> driven;
  solids.for_each_element(jump.entry->group, [&](Index e, bool) {
    if (!reached[solids.number(e)]) driven.push_back(solids.number(e));
    reached[solids.number(e)] = true;
  });
  for (const std::size_t from : driven) {
    for (std::size_t to = 0; to < solids.end(); ++to) reached[to] = reached[to] || solids.touch(from, to);
  }
  for (std::size_t i = 0; i < solids.end(); ++i) {
    if (reached[i]) jump.crossing = std::max(jump.crossing, solids[i].crossing());
  }
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    const std::size_t group = at(model.mesh.element_group[at(e)]);
    // What is driven as a whole, moves as a whole.
    if (reached[solids.number(e)] && model.mesh.volume_groups[group] != jump.entry->group) groups[group] = true;
  }
  return groups;
}

/// The weakest joints that the wave comes to.
void meet_joints(const Model& model, const std::vector<bool>& reached, Jump& jump) {
  for (std::size_t g = 0; g < model.whole.joint_groups.size(); ++g) {
    const std::size_t a = at(model.whole.joint_groups[g].a), b = at(model.whole.joint_groups[g].b);
    if (!model.joint_laws[g].breakable() || !(reached[a] || reached[b])) continue;
    const double stress = std::min(impedance(model, a), impedance(model, b)) * jump.speed;
    const double share = stress / model.joint_laws[g].tensile_strength;
    if (!(share > jump.share)) continue;
    jump.stress = stress;
    jump.share = share;
    jump.joints = model.joint_law_names[g];
  }
}

}  // namespace

std::string sudden_motion(const case_::Case& input, const Model& model) {
  constexpr double kNotable = 0.1, kPulse = 10, kSlow = 20;  // of the strength; crossings of a wave
  Solids solids(model);
  Jump worst;
  const case_::Stage* before = nullptr;
  double begun = 0, start = 0;
  for (const case_::Stage& stage : input.stages) {
    for (const case_::Constraint& entry : stage.constraints) {
      Jump jump = jump_of(input, {stage, before, begun, start}, solids, model, entry);
      if (!(jump.speed > 0)) continue;
      meet_joints(model, groups_reached(model, solids, jump), jump);
      if (jump.share > std::max(worst.share, kNotable) && stage.end - start > kPulse * jump.crossing) worst = jump;
    }
    before = &stage;
    begun = start;
    start = stage.end;
  }
  if (worst.entry == nullptr) return {};
  const std::string ramp = worst.start > 0 ? fmt::format("start = {:g}, ", worst.start) : "";
  return fmt::format(
      "{} begins with a jump in speed of {}: its stress wave rho c v of about {} is {:.2g} % of the tensile strength "
      "of the joints of {}. For a slow load, use a ramp over {} or more: velocity = {{ {} = {{ ramp = {{ {}end = ..., "
      "to = {:g} }} }} }}.",
      name_of(*worst.entry), quantity_text(worst.speed, "m/s"), quantity_text(worst.stress, "Pa"), 100 * worst.share,
      worst.joints, quantity_text(kSlow * worst.crossing, "s"), "xyz"[worst.axis], ramp, worst.velocity);
}

}  // namespace breccia
