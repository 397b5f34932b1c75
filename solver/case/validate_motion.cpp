#include "case/validate_motion.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/number_text.hpp"
#include "case/problem_at.hpp"

namespace breccia::case_ {
namespace {

std::string rounded(double value) { return number_text(value, 4); }

/// Sum of the absolute values of the parts of a function at a time.
double parts_of(const TimeFunction& f, double time) {
  double sum = std::abs(f.constant) + std::abs(f.linear * time);
  for (const TimeFunction::Sine& s : f.sines) sum += std::abs(s.amplitude);
  double most = 0;
  for (const TimeFunction::Point& p : f.table) most = std::max(most, std::abs(p.value));
  return sum + most;
}

// Beyond any sense, and far below what makes an energy overflow: a unit forgotten, or an exponent too long.
constexpr double kFastest = 3e8;         // m/s, that of light
constexpr double kFurthest = 1e10;       // m
constexpr double kFastestTurn = 1e15;    // rad/s
constexpr double kFastestStrain = 1e15;  // 1/s
constexpr double kMostGravity = 1e20;    // m/s2
constexpr double kMostPressure = 1e20;   // Pa
constexpr double kMostForce = 1e20;      // N

/// Speeds, displacements and loads that no run can bear.
class MotionLimits {
 public:
  explicit MotionLimits(const Case& c) : c_(c) {}

  std::vector<Problem> run() {
    for (const InitialVelocity& v : c_.initial_velocities) {
      demand(v.origin, "velocity", v.velocity.cwiseAbs().maxCoeff(), kFastest, "m/s");
      demand(v.origin, "random", std::max(std::abs(v.random[0]), std::abs(v.random[1])), kFastest, "m/s");
      demand(v.origin, "angular", v.angular.cwiseAbs().maxCoeff(), kFastestTurn, "rad/s");
      demand(v.origin, "strain_rate", v.strain_rate.cwiseAbs().maxCoeff(), kFastestStrain, "1/s");
    }
    for (const Stage& stage : c_.stages) {
      for (const TimeFunction& f : stage.gravity)
        demand(stage.origin, "gravity", parts_of(f, stage.end), kMostGravity, "m/s2");
      for (const Constraint& constraint : stage.constraints) {
        if (constraint.kind == ConstraintKind::fixed) continue;
        const bool velocity = constraint.kind == ConstraintKind::velocity;
        for (const TimeFunction& f : constraint.value)
          demand(constraint.origin, velocity ? "velocity" : "displacement", parts_of(f, stage.end),
                 velocity ? kFastest : kFurthest, velocity ? "m/s" : "m");
      }
      for (const Pressure& pressure : stage.pressures)
        demand(pressure.origin, "value", parts_of(pressure.value, stage.end), kMostPressure, "Pa");
      for (const Traction& traction : stage.tractions) {
        for (const TimeFunction& f : traction.value)
          demand(traction.origin, "value", parts_of(f, stage.end), kMostPressure, "Pa");
      }
      for (const Force& force : stage.forces) {
        for (const TimeFunction& f : force.value)
          demand(force.origin, "value", parts_of(f, stage.end), kMostForce, "N");
      }
    }
    return std::move(problems_);
  }

 private:
  void demand(const Origin& origin, const char* name, double magnitude, double most, const std::string& unit) {
    if (magnitude <= most) return;
    problems_.push_back(problem_at(c_, origin, name, "is too large to be computed",
                                   "magnitudes up to " + rounded(most) + " " + unit, rounded(magnitude) + " " + unit));
  }

  const Case& c_;
  std::vector<Problem> problems_;
};

class PlaneCheck {
 public:
  explicit PlaneCheck(const Case& c)
      : c_(c),
        axis_(static_cast<std::size_t>(c.plane->axis)),
        name_(1, "xyz"[axis_]),
        strain_(c.plane->kind == PlaneKind::strain) {}

  std::vector<Problem> run() {
    for (const InitialVelocity& v : c_.initial_velocities) initial_velocity(v);
    for (const Stage& stage : c_.stages) {
      if (!stage.gravity[axis_].is_zero()) problem(stage.origin, "gravity", "none along " + name_);
      for (const Constraint& constraint : stage.constraints) this->constraint(constraint);
      for (const Traction& traction : stage.tractions) {
        if (!traction.value[axis_].is_zero()) problem(traction.origin, "value", "none along " + name_);
      }
      for (const Force& force : stage.forces) {
        if (!force.value[axis_].is_zero()) problem(force.origin, "value", "none along " + name_);
      }
    }
    if (c_.sphere) problem(c_.sphere->origin, "", "no [sphere]");
    return std::move(problems_);
  }

 private:
  void problem(const Origin& origin, const std::string& name, const std::string& allowed) {
    problems_.push_back(
        problem_at(c_, origin, name, "acts along " + name_ + ", the axis of this plane model", allowed, ""));
  }
  void initial_velocity(const InitialVelocity& v) {
    const auto axis = static_cast<Eigen::Index>(axis_);
    if (v.velocity[axis] != 0) problem(v.origin, "velocity", "none along " + name_);
    if (v.strain_rate[axis] != 0) problem(v.origin, "strain_rate", "none along " + name_);
    if (v.random[1] > 0) problem(v.origin, "random", "no random velocity");
    Vec3 across = v.angular;
    across[axis] = 0;
    if (across != Vec3::Zero()) problem(v.origin, "angular", "a rotation about " + name_);
  }
  void constraint(const Constraint& constraint) {
    if (!constraint.axes[axis_]) return;
    const char* key = constraint.kind == ConstraintKind::fixed      ? "fixed"
                      : constraint.kind == ConstraintKind::velocity ? "velocity"
                                                                    : "displacement";
    if (constraint.kind != ConstraintKind::fixed && !constraint.value[axis_].is_zero())
      problem(constraint.origin, key, "none along " + name_);
    else if (!strain_)
      problem(constraint.origin, key, "the other axes: under plane stress the thickness is free");
  }

  const Case& c_;
  std::size_t axis_;
  std::string name_;
  bool strain_;
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> jumps_at(const Case& c, const Stage& stage, double start) {
  constexpr double kRoundOff = 1e-9;
  std::vector<Problem> problems;
  for (const Constraint& constraint : stage.constraints) {
    if (constraint.kind != ConstraintKind::displacement) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double jump = constraint.value[axis](start);
      if (!constraint.axes[axis] || std::abs(jump) <= kRoundOff * parts_of(constraint.value[axis], start)) continue;
      problems.push_back(
          problem_at(c, constraint.origin, "displacement." + std::string(1, "xyz"[axis]),
                     "jumps in the first step of its stage: displacements count from the start of the stage, at " +
                         rounded(start) + " s of the run, and time from the start of the run",
                     "a function that is 0 at " + rounded(start) + " s, such as { ramp = { start = " + rounded(start) +
                         ", end = ..., to = ... } }",
                     rounded(jump) + " m"));
    }
  }
  return problems;
}

std::vector<Problem> validate_motion(const Case& c) {
  std::vector<Problem> problems;
  double start = 0;
  for (std::size_t s = 0; s < c.stages.size(); ++s) {
    if (s > 0 || !c.start) {
      const std::vector<Problem> jumps = jumps_at(c, c.stages[s], start);
      problems.insert(problems.end(), jumps.begin(), jumps.end());
    }
    start = c.stages[s].end;
  }
  const std::vector<Problem> beyond = MotionLimits(c).run();
  problems.insert(problems.end(), beyond.begin(), beyond.end());
  if (!c.plane) return problems;
  const std::vector<Problem> across = PlaneCheck(c).run();
  problems.insert(problems.end(), across.begin(), across.end());
  return problems;
}

}  // namespace breccia::case_
