#pragma once

// The kernel of physics/sweep.hpp, included once by each translation unit sweep_<instruction set>.cpp and compiled for
// its set: everything here has internal linkage or a type that only this set has, so no unit can borrow another's code.

#include <experimental/simd>

#include "discretisation/blocks.hpp"
#include "discretisation/joint_links.hpp"
#include "physics/elasticity.hpp"
#include "physics/material/bulk_law.hpp"
#include "physics/sweep.hpp"

namespace breccia {
namespace {

namespace stdx = std::experimental;
namespace el = elasticity;

using Real = stdx::native_simd<double>;
constexpr std::size_t kWidth = Real::size();
static_assert(kLanes % kWidth == 0);

using Vector = el::Vector<Real>;
using Corners = el::Corners<Real>;
using Tensor = el::Tensor<Real>;

inline Real load(const double* p) { return Real(p, stdx::element_aligned); }
inline void store(const Real& value, double* p) { value.copy_to(p, stdx::element_aligned); }
inline void add_to(double* p, const Real& value) { store(load(p) + value, p); }

/// A tensor or a vector that stays in memory, component k of W elements at first + 8 k: loaded where it is used, as
/// registers are scarcer than loads.
struct Stored {
  const double* first;
  Real operator[](std::size_t k) const { return load(first + k * kLanes); }
};

/// Likewise the corners of W elements that own their nodes.
struct StoredCorners {
  const double* first;
  Stored operator[](std::size_t c) const { return {first + c * 3 * kLanes}; }
};

struct Motion {
  Real max_speed_squared = 0;
  Real speed_squared_sum = 0;
};

struct Totals {
  Motion motion;
  SweepStatus status;
};

inline Real contract(const Tensor& a, const Tensor& b) {
  Real sum = a[0] * b[0];
  for (std::size_t i = 1; i < 9; ++i) sum += a[i] * b[i];
  return sum;
}

/// Elastic and viscous stress of W elements, kept until the velocities after the step are known.
struct Stress {
  Stored inverse;  // D_m^-1
  Tensor total;    // first Piola
  Tensor viscous;  // its viscous part, set when the group is viscous
  Real volume;
};

/// How many of the lanes marked are this rank's own: the others are counted elsewhere, or have not been moved for long.
template <class Mask>
[[gnu::noinline]] inline std::int64_t count_originals(const SweepArgs& args, const Mask& mask, std::size_t slot) {
  std::int64_t count = 0;
  for (std::size_t l = 0; l < kWidth; ++l) count += mask[l] && args.original[slot + l] != 0 ? 1 : 0;
  return count;
}

/// Stress of W elements whose law has a memory, one after the other.
[[gnu::noinline]] inline void step_with_memory(const SweepArgs& args, const ElasticParams& p, std::size_t first_slot,
                                               const Tensor& f, Tensor& piola) {
  double lanes[9][kWidth];
  for (std::size_t k = 0; k < 9; ++k) store(f[k], lanes[k]);
  for (std::size_t l = 0; l < kWidth; ++l) {
    double one[9], stress[9];
    for (std::size_t k = 0; k < 9; ++k) one[k] = lanes[k][l];
    step_bulk_law(p, one, args.memory + (first_slot + l) * args.memory_stride, stress);
    for (std::size_t k = 0; k < 9; ++k) lanes[k][l] = stress[k];
  }
  for (std::size_t k = 0; k < 9; ++k) piola[k] = load(lanes[k]);
}

/// The group has the neo-Hookean law and no viscosity.
inline bool plain(const ElasticParams& p) { return p.law == BulkLaw::neo_hookean && !(p.viscosity > 0); }

/// @tparam is_plain  the group is plain, so that the stress need not pass through memory
/// @param x, v  corners
template <bool is_plain, class X>
[[gnu::always_inline]] inline void evaluate_stress(const SweepArgs& args, const ElasticParams& p, std::size_t block,
                                                   std::size_t lane, const X& x, const X& v, Totals& totals,
                                                   Stress& s) {
  s.inverse = {args.gradient + block * 72 + lane};
  s.volume = load(args.volume + block * kLanes + lane);
  const Tensor f = el::deformation<Real>(x, s.inverse);
  const Tensor cof = el::cofactor(f);
  const Real j = el::determinant(f, cof);
  const auto crushed = j < p.j_min;
  if (stdx::any_of(crushed)) totals.status.crushed += count_originals(args, crushed, block * kLanes + lane);
  switch (is_plain ? StressKernel::neo_hookean : stress_kernel(p.law)) {
    case StressKernel::neo_hookean:
      el::neo_hookean_piola(f, cof, j, p, s.total);
      break;
    case StressKernel::green_st_venant:
      s.total = el::product(el::green_st_venant_stress(f, j, p), cof);
      break;
    case StressKernel::with_memory:
      step_with_memory(args, p, block * kLanes + lane, f, s.total);
      break;
  }
  if (!is_plain && p.viscosity > 0) {
    s.viscous = el::viscous_piola(el::deformation<Real>(v, s.inverse), cof, j, p);
    for (std::size_t i = 0; i < 9; ++i) s.total[i] += s.viscous[i];
  }
}

inline bool needs_rate(const SweepArgs& args, const ElasticParams& p) {
  return p.viscosity > 0 || (!is_hyperelastic(p.law) && args.stress_before != nullptr);
}

/// Keeps the stress for account_after.
inline void keep_stress(const SweepArgs& args, const ElasticParams& p, const Stress& s, std::size_t block,
                        std::size_t lane) {
  if (args.kept_stress == nullptr || !needs_rate(args, p)) return;
  double* kept = args.kept_stress + block * 144 + lane;
  for (std::size_t i = 0; i < 9; ++i) {
    store(s.total[i], kept + i * kLanes);
    store(p.viscosity > 0 ? s.viscous[i] : Real(0.0), kept + 72 + i * kLanes);
  }
}

/// Half of the step before t_n, s; before the first step as of one as long as it. kick_length() is this and half of the
/// step after t_n.
inline double half_before(const SweepArgs& args) { return args.kick - 0.5 * args.dt; }

/// Accounts the work of the viscous stress, and of the elastic stress of laws that have no energy, during half a step.
/// @param length  of that half, s
template <class X>
inline void account_stress_work(const ElasticParams& p, const Stress& s, const X& v, double length, std::size_t slot,
                                double* viscous, double* stress) {
  const bool no_energy = !is_hyperelastic(p.law) && stress != nullptr;
  const bool dissipates = p.viscosity > 0 && viscous != nullptr;
  if (!no_energy && !dissipates) return;
  const Tensor rate = el::deformation<Real>(v, s.inverse);
  const Real half = length * s.volume;
  const Real viscous_work = p.viscosity > 0 ? half * contract(s.viscous, rate) : Real(0.0);
  if (dissipates) add_to(viscous + slot, viscous_work);
  if (no_energy) add_to(stress + slot, half * contract(s.total, rate) - viscous_work);
}

/// Replaces the elastic joint forces of the lanes whose opening has left the surely elastic range. The limit is that of
/// the element's weakest joint: one that is still elastic by its own keeps its force.
[[gnu::noinline]] inline void replace_crossing(const SweepArgs& args, std::size_t at, Index first_slot, int face,
                                               const bool* crossing, double (*force)[kWidth]) {
  for (std::size_t l = 0; l < kWidth; ++l) {
    if (!crossing[l] || (args.link[at + l] & 15) >= 12) continue;
    double virgin[9];
    for (std::size_t k = 0; k < 9; ++k) virgin[k] = force[k][l];
    args.crossing(args.crossing_context, first_slot + static_cast<Index>(l), face, virgin);
    for (std::size_t k = 0; k < 9; ++k) force[k][l] = virgin[k];
  }
}

/// This side of the intact joints on one face. Self links (free faces and such) have opening zero.
template <std::size_t kFace>
[[gnu::always_inline]] inline void add_joint_forces(const SweepArgs& args, std::size_t block, std::size_t lane,
                                                    const StoredCorners& x, const Real& limit, Corners& force) {
  const std::size_t at = block * 32 + kFace * kLanes + lane;
  const std::int32_t* const places = args.place + block * 96 + kFace * 24 + lane;
  Vector pull[3];
  Real largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr auto corners = kFaceCorners[kFace];
    const Stored own = x[static_cast<std::size_t>(corners[i])];
    const double* linked[kWidth];
    for (std::size_t l = 0; l < kWidth; ++l) linked[l] = args.position + places[i * kLanes + l];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      pull[i][axis] = Real([&](auto l) { return linked[l][axis * kLanes]; }) - own[axis];
    }
    const Vector& d = pull[i];
    largest = stdx::max(largest, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  }
  const Real stiffness = load(args.stiffness + at);
  for (Vector& d : pull) {
    for (Real& component : d) component *= stiffness;
  }
  const auto crossing = largest > limit;
  if (stdx::any_of(crossing)) [[unlikely]] {
    bool lanes[kWidth];
    double forces[9][kWidth];
    crossing.copy_to(lanes, stdx::element_aligned);
    for (std::size_t k = 0; k < 9; ++k) store(pull[k / 3][k % 3], forces[k]);
    replace_crossing(args, at, static_cast<Index>(block * kLanes + lane), static_cast<int>(kFace), lanes, forces);
    for (std::size_t k = 0; k < 9; ++k) pull[k / 3][k % 3] = load(forces[k]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr auto corners = kFaceCorners[kFace];
    for (std::size_t axis = 0; axis < 3; ++axis) force[static_cast<std::size_t>(corners[i])][axis] += pull[i][axis];
  }
}

/// v_(n+1/2) of W nodes from the force on them; accounts damping work if requested.
struct Mover {
  const SweepArgs& args;
  Real keep, gain;  // v <- keep v + gain kick a
  bool damped;

  explicit Mover(const SweepArgs& a)
      : args(a),
        keep((1.0 - 0.5 * a.mass_damping * a.kick) / (1.0 + 0.5 * a.mass_damping * a.kick)),
        gain(1.0 / (1.0 + 0.5 * a.mass_damping * a.kick)),
        damped(a.mass_damping > 0 || a.local_damping > 0) {}

  /// @param v  as of Vector
  template <class V>
  Vector move(const V& v, Vector force, const Real& mass, std::size_t node) const {
    // Without a force along it, and without gravity, the velocity stays zero there.
    if (args.free_across != nullptr) force[args.across] *= load(args.free_across + node);
    const Real kick_over_mass = args.kick / mass;
    Vector moved;
    if (!damped) {
      for (std::size_t i = 0; i < 3; ++i) moved[i] = v[i] + (kick_over_mass * force[i] + args.kick * args.gravity[i]);
      return moved;
    }
    Real before = 0.0, after = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Real unbalanced = force[i] + mass * args.gravity[i];
      const Real size = args.local_damping * stdx::abs(unbalanced);
      const Real local = el::select(v[i] > 0.0, Real(-size), el::select(v[i] < 0.0, size, Real(0.0)));
      moved[i] = keep * v[i] + gain * (kick_over_mass * (unbalanced + local));
      const Real damping = local - 0.5 * args.mass_damping * mass * (v[i] + moved[i]);
      before -= damping * v[i];
      after -= damping * moved[i];
    }
    if (args.damping_before != nullptr) {
      add_to(args.damping_before + node, half_before(args) * before);
      add_to(args.damping_after + node, 0.5 * args.dt * after);
    }
    return moved;
  }
};

inline void note_motion(const Vector& v, Motion& motion) {
  const Real speed_squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  motion.max_speed_squared = stdx::max(motion.max_speed_squared, speed_squared);
  motion.speed_squared_sum += speed_squared;
}

inline void add_motion(const Motion& motion, Motion& total) {
  total.max_speed_squared = stdx::max(total.max_speed_squared, motion.max_speed_squared);
  total.speed_squared_sum += motion.speed_squared_sum;
}

/// W elements that own their nodes, from forces to new positions. @param p  of their group
template <bool is_plain>
inline void sweep_own(const SweepArgs& args, const ElasticParams& p, const Mover& mover, std::size_t block,
                      std::size_t lane, Totals& totals) {
  const std::size_t field = block * 96 + lane;
  const StoredCorners x{args.position + field}, v{args.velocity + field};
  Stress stress;
  evaluate_stress<is_plain>(args, p, block, lane, x, v, totals, stress);
  Corners force = el::corner_forces(stress.total, stress.inverse, stress.volume);
  const Real limit = load(args.limit + block * kLanes + lane);
  add_joint_forces<0>(args, block, lane, x, limit, force);
  add_joint_forces<1>(args, block, lane, x, limit, force);
  add_joint_forces<2>(args, block, lane, x, limit, force);
  add_joint_forces<3>(args, block, lane, x, limit, force);
  const Index slot = args.force_slot[block];
  if (slot >= 0) {
    const double* own = args.own_force + static_cast<std::size_t>(slot) * 96 + lane;
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t i = 0; i < 3; ++i) force[c][i] += load(own + (3 * c + i) * kLanes);
    }
  }
  if (!is_plain) {
    account_stress_work(p, stress, v, half_before(args), block * kLanes + lane, args.viscous_before,
                        args.stress_before);
    keep_stress(args, p, stress, block, lane);
  }
  const Real mass = load(args.node_mass + block * 4 * kLanes + lane);
  Motion motion;
  for (std::size_t c = 0; c < 4; ++c) {
    const Vector moved = mover.move(v[c], force[c], mass, (block * 4 + c) * kLanes + lane);
    note_motion(moved, motion);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t at = field + (3 * c + i) * kLanes;
      store(moved[i], args.velocity + at);
      store(x[c][i] + args.dt * moved[i], args.next_position + at);
    }
  }
  add_motion(motion, totals.motion);
}

/// Corners of W shared-node elements out of a nodal field.
inline Corners gather(const double* field, const std::int32_t* corners) {
  Corners value;
  for (std::size_t c = 0; c < 4; ++c) {
    const double* place[kWidth];
    for (std::size_t l = 0; l < kWidth; ++l) place[l] = field + nodal(corners[c * kLanes + l], 0);
    for (std::size_t i = 0; i < 3; ++i) value[c][i] = Real([&](auto l) { return place[l][i * kLanes]; });
  }
  return value;
}

/// Internal forces of W shared-node elements, scattered in ascending lanes. @param p  of their group
template <bool is_plain>
inline void scatter_shared(const SweepArgs& args, const ElasticParams& p, std::size_t block, std::size_t lane,
                           Totals& totals) {
  const std::int32_t* corners =
      args.shared_corners + (block - static_cast<std::size_t>(args.num_own_blocks)) * 32 + lane;
  const Corners x = gather(args.position, corners);
  const Corners v = !is_plain && needs_rate(args, p) ? gather(args.velocity, corners) : Corners{};
  Stress stress;
  evaluate_stress<is_plain>(args, p, block, lane, x, v, totals, stress);
  if (!is_plain) {
    account_stress_work(p, stress, v, half_before(args), block * kLanes + lane, args.viscous_before,
                        args.stress_before);
    keep_stress(args, p, stress, block, lane);
  }
  const Corners force = el::corner_forces(stress.total, stress.inverse, stress.volume);
  double lanes[12][kWidth];
  for (std::size_t k = 0; k < 12; ++k) store(force[k / 3][k % 3], lanes[k]);
  const Index first = args.num_own_blocks * 4 * kLanes;
  for (std::size_t l = 0; l < kWidth; ++l) {
    for (std::size_t c = 0; c < 4; ++c) {
      double* f = args.shared_force + nodal(corners[c * kLanes + l] - first, 0);
      f[0] += lanes[3 * c][l];
      f[8] += lanes[3 * c + 1][l];
      f[16] += lanes[3 * c + 2][l];
    }
  }
}

/// W shared nodes to their new velocities and positions.
inline void move_shared(const SweepArgs& args, const Mover& mover, std::size_t node, Totals& totals) {
  const std::size_t at = node / kLanes * 3 * kLanes + node % kLanes;
  const double* f = args.shared_force + at - static_cast<std::size_t>(args.num_own_blocks) * 96;
  Vector v, force;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = load(args.velocity + at + i * kLanes);
    force[i] = load(f + i * kLanes);
  }
  v = mover.move(v, force, load(args.node_mass + node), node);
  note_motion(v, totals.motion);
  for (std::size_t i = 0; i < 3; ++i) {
    store(v[i], args.velocity + at + i * kLanes);
    store(load(args.position + at + i * kLanes) + args.dt * v[i], args.next_position + at + i * kLanes);
  }
}

/// Second half of the stress work of W elements, when their nodes' velocities are final.
inline void account_after(const SweepArgs& args, std::size_t block, std::size_t lane) {
  const ElasticParams& p = args.params[args.block_group[block]];
  if (!needs_rate(args, p)) return;
  Stress stress;
  stress.inverse = {args.gradient + block * 72 + lane};
  for (std::size_t i = 0; i < 9; ++i) {
    const double* kept = args.kept_stress + block * 144 + i * kLanes + lane;
    stress.total[i] = load(kept);
    stress.viscous[i] = load(kept + 72);
  }
  stress.volume = load(args.volume + block * kLanes + lane);
  const auto account = [&](const auto& v) {
    account_stress_work(p, stress, v, 0.5 * args.dt, block * kLanes + lane, args.viscous_after, args.stress_after);
  };
  if (block < static_cast<std::size_t>(args.num_own_blocks)) {
    account(StoredCorners{args.velocity + block * 96 + lane});
  } else {
    account(gather(args.velocity,
                   args.shared_corners + (block - static_cast<std::size_t>(args.num_own_blocks)) * 32 + lane));
  }
}

inline void account_rate_work(const SweepArgs& args) {
  const auto account = [&](Index block) {
    for (std::size_t lane = 0; lane < kLanes; lane += kWidth)
      account_after(args, static_cast<std::size_t>(block), lane);
  };
  for (Index block = args.first_own_block; block < args.end_own_block; ++block) account(block);
  for (Index b = 0; b < args.num_shared_blocks; ++b) account(args.shared_blocks[b]);
}

inline SweepStatus sweep(const SweepArgs& args) {
  const Mover mover(args);
  Totals totals;
  double checked_sum = 0;
  const auto own = static_cast<std::size_t>(args.num_own_blocks);
  const auto end = static_cast<std::size_t>(args.end_own_block);
  for (auto block = static_cast<std::size_t>(args.first_own_block); block < end; ++block) {
    const ElasticParams& p = args.params[args.block_group[block]];
    const auto sweep_block = plain(p) ? sweep_own<true> : sweep_own<false>;
    for (std::size_t lane = 0; lane < kLanes; lane += kWidth) sweep_block(args, p, mover, block, lane, totals);
    if ((block & 63) == 63 || block + 1 == end) {  // NaN is sought every 512 elements: near enough to name the place
      checked_sum = stdx::reduce(totals.motion.speed_squared_sum);
      if (!(checked_sum < 1e300) && totals.status.first_not_finite < 0) {
        totals.status.first_not_finite = static_cast<Index>(block & ~std::size_t{63});
      }
    }
  }
  for (Index b = 0; b < args.num_shared_blocks; ++b) {
    const auto block = static_cast<std::size_t>(args.shared_blocks[b]);
    const ElasticParams& p = args.params[args.block_group[block]];
    const auto scatter_block = plain(p) ? scatter_shared<true> : scatter_shared<false>;
    for (std::size_t lane = 0; lane < kLanes; lane += kWidth) scatter_block(args, p, block, lane, totals);
  }
  for (auto node = own * 4 * kLanes; node < static_cast<std::size_t>(args.num_moved_nodes); node += kWidth) {
    move_shared(args, mover, node, totals);
  }
  totals.status.max_speed_squared = stdx::hmax(totals.motion.max_speed_squared);
  totals.status.speed_squared_sum = stdx::reduce(totals.motion.speed_squared_sum);
  return totals.status;
}

}  // namespace
}  // namespace breccia
