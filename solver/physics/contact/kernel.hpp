#pragma once

// The kernels of block.hpp, included once by each translation unit kernel_<instruction set>.cpp and compiled for its
// set, as the sweep is (sweep_kernel.hpp). Real: a SIMD vector, or double.

#include <experimental/simd>

#include <type_traits>

#include "physics/contact/block.hpp"
#include "physics/contact/evaluate.hpp"
#include "physics/contact/geometry/tetra.hpp"
#include "physics/lane_vector.hpp"

namespace breccia {
namespace {

namespace stdx = std::experimental;

using elasticity::select;
using NativeReal = stdx::native_simd<double>;

template <class Real>
[[nodiscard]] constexpr std::size_t width() {
  if constexpr (std::is_same_v<Real, double>) {
    return 1;
  } else {
    return Real::size();
  }
}
static_assert(kLanes % width<NativeReal>() == 0);

/// The number of each of some lanes. @param number  of a lane, counted from the first of them
template <class Real, class F>
[[nodiscard]] inline Real of_lanes(F&& number) {
  if constexpr (std::is_same_v<Real, double>) {
    return number(std::size_t{0});
  } else {
    return Real([&](auto l) { return number(std::size_t{l}); });
  }
}
template <class Real>
[[nodiscard]] inline double lane_of(const Real& value, std::size_t lane) {
  if constexpr (std::is_same_v<Real, double>) {
    return value;
  } else {
    return value[lane];
  }
}
template <class M>
[[nodiscard]] inline bool is_set(const M& mask, std::size_t lane) {
  if constexpr (std::is_same_v<M, bool>) {
    return mask;
  } else {
    return mask[lane];
  }
}

/// Some couples of a block side by side.
template <class Real>
struct Some {
  using Vector = VectorOf<Real>;
  std::size_t first;

  [[nodiscard]] Real load(const ContactRow& row) const {
    if constexpr (std::is_same_v<Real, double>) {
      return row[first];
    } else {
      return Real(&row.lane[first], stdx::element_aligned);
    }
  }
  [[nodiscard]] Vector load(const ContactRow (&rows)[3]) const { return {load(rows[0]), load(rows[1]), load(rows[2])}; }
  void store(const Real& value, ContactRow& row) const {
    if constexpr (std::is_same_v<Real, double>) {
      row[first] = value;
    } else {
      value.copy_to(&row.lane[first], stdx::element_aligned);
    }
  }
  void store(const Vector& value, ContactRow (&rows)[3]) const {
    store(value[0], rows[0]);
    store(value[1], rows[1]);
    store(value[2], rows[2]);
  }
  /// @param vector  (axis, lane) components, counted from the first lane
  template <class F>
  [[nodiscard]] Vector gather(F&& vector) const {
    const auto component = [&](std::size_t axis) {
      return of_lanes<Real>([&](std::size_t l) { return vector(axis, first + l); });
    };
    return {component(0), component(1), component(2)};
  }
};

/// Numbers of some elements in a nodal field.
template <class Real>
[[nodiscard]] inline std::array<LaneVector<Real>, 4> corners_of(const double* field, std::size_t first) {
  std::array<LaneVector<Real>, 4> corners;
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t i = 0; i < 3; ++i)
      corners[c][i] = of_lanes<Real>([&](std::size_t l) { return field[(3 * c + i) * kLanes + first + l]; });
  }
  return corners;
}

/// Some elements.
template <class Real>
inline void prepare(const double* x, const double* volume, StepElement* elements, std::size_t first) {
  const Real at_rest = of_lanes<Real>([&](std::size_t l) { return volume[first + l]; });
  const PreparedTetraOf<Real> tetra = prepared_tetra<Real>(corners_of<Real>(x, first), at_rest);
  for (std::size_t l = 0; l < width<Real>(); ++l) {
    PreparedTetra& to = elements[first + l].tetra;
    for (std::size_t i = 0; i < 3; ++i) {
      to.origin[i] = lane_of(tetra.origin[i], l);
      for (std::size_t c = 0; c < 3; ++c) to.gradient[c][i] = lane_of(tetra.gradient[c][i], l);
    }
  }
}

/// Motion of some elements.
template <class Real>
inline void move_elements(const double* v, StepElement* elements, std::size_t first) {
  using Vector = LaneVector<Real>;
  const std::array<Vector, 4> velocity = corners_of<Real>(v, first);
  const auto gradient = [&](std::size_t c, std::size_t i) {
    return of_lanes<Real>([&](std::size_t l) { return elements[first + l].tetra.gradient[c][i]; });
  };
  Vector curl{Real(0.0), Real(0.0), Real(0.0)};
  for (std::size_t c = 1; c < 4; ++c) {
    const Vector row{gradient(c - 1, 0), gradient(c - 1, 1), gradient(c - 1, 2)};
    curl += row.cross(velocity[c] - velocity[0]);
  }
  const Real any = gradient(0, 0);
  const auto inert = !(any == any);
  for (std::size_t i = 0; i < 3; ++i) curl[i] = select(inert, Real(0.0), curl[i]);
  for (std::size_t l = 0; l < width<Real>(); ++l) {
    StepElement& element = elements[first + l];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t c = 0; c < 4; ++c) element.velocity[c][i] = v[(3 * c + i) * kLanes + first + l];
      element.curl[i] = lane_of(curl[i], l);
    }
  }
}

/// Where the points of some couples are.
template <class Real>
inline void locate(LocateBlock& b, std::size_t first) {
  const PreparedTetra* const* some = b.tetra + first;
  const Some<Real> at{first};
  PreparedTetraOf<Real> tetra;
  std::array<Real, 3> x;
  for (std::size_t i = 0; i < 3; ++i) {
    tetra.origin[i] = of_lanes<Real>([&](std::size_t l) { return some[l]->origin[i]; });
    for (std::size_t c = 0; c < 3; ++c)
      tetra.gradient[c][i] = of_lanes<Real>([&](std::size_t l) { return some[l]->gradient[c][i]; });
    x[i] = at.load(b.x[i]);
  }
  const std::array<Real, 4> lambda = barycentric(tetra, x);
  const Real least =
      elasticity::lesser(elasticity::lesser(lambda[0], lambda[1]), elasticity::lesser(lambda[2], lambda[3]));
  const auto inert = !(tetra.gradient[0][0] == tetra.gradient[0][0]), inside = least >= -kInside, near = least >= -kGap;
  for (std::size_t a = 0; a < 4; ++a) at.store(lambda[a], b.lambda[a]);
  at.store(safe_travel(tetra, lambda, select(near, Real(kInside), Real(kGap))), b.safe);
  for (std::size_t l = 0; l < width<Real>(); ++l) {
    b.where[first + l] = is_set(inside, l)  ? Whereabouts::inside
                         : is_set(near, l)  ? Whereabouts::beside
                         : is_set(inert, l) ? Whereabouts::nowhere
                                            : Whereabouts::outside;
  }
}

/// How the points of some couples have moved in the last step.
template <class Real>
inline void move(double dt, PairBlock& b, std::size_t first) {
  using Vector = VectorOf<Real>;
  using std::abs;
  const Some<Real> at{first};
  const auto face = [&](std::size_t i) {
    return at.gather([&](std::size_t axis, std::size_t l) { return b.velocity[i][l][axis]; });
  };
  const auto corner = [&](std::size_t a) {
    return at.gather([&](std::size_t axis, std::size_t l) { return b.contactor[l]->velocity[a][axis]; });
  };
  Vector relative = at.load(b.shape[0]) * face(0) + at.load(b.shape[1]) * face(1) + at.load(b.shape[2]) * face(2);
  for (std::size_t a = 0; a < 4; ++a) relative -= at.load(b.lambda[a]) * corner(a);
  const Vector motion = Real(dt) * relative;
  Vector gradient{Real(0.0), Real(0.0), Real(0.0)};
  const Real depth = at.load(b.depth[0]);
  for (std::size_t c = 0; c < 3; ++c) {
    gradient += (at.load(b.depth[c + 1]) - depth) *
                at.gather([&](std::size_t axis, std::size_t l) { return b.contactor[l]->tetra.gradient[c][axis]; });
  }
  const Real change =
      at.load(b.overlap_before) - (at.load(b.history.d) * at.load(b.length) + at.load(b.history.offset));
  const Real along = gradient.dot(motion);
  const auto same = pair_step::any_component(motion) && abs(change - along) <= kSameSlope * motion.norm();
  at.store(motion, b.motion);
  at.store(gradient, b.gradient);
  at.store(Real(along - change), b.turn);
  for (std::size_t l = 0; l < width<Real>(); ++l) b.same_slope[first + l] = is_set(same, l) ? 1 : 0;
}

/// One step of some couples.
template <class Real>
inline void evaluate_some(double dt, const EvaluationRules& rules, PairBlock& b, std::size_t first) {
  const Some<Real> at{first};
  ContactPair<Real> pair;
  if (b.common_law != nullptr) {
    for_each_law_number([](Real& x, const double& of_all) { x = of_all; }, pair.law, *b.common_law);
    const int whole = static_cast<int>(b.common_law->exponent);
    pair.whole_exponent = whole == b.common_law->exponent ? whole : 0;
  } else {
    for_each_law_number([&](Real& x, const ContactRow& row) { x = at.load(row); }, pair.law, b.law);
  }
  pair.weight = at.load(b.weight);
  pair.length = at.load(b.length);
  pair.overlap = at.load(b.overlap);
  pair.overlap_before = at.load(b.overlap_before);
  pair.motion = at.load(b.motion);
  pair.gradient = at.load(b.gradient);
  pair.turn = at.load(b.turn);
  pair.longest_delay = at.load(b.longest_delay);
  // Half the curl of the motion of each element.
  const auto curl = [&](const StepElement* const(&elements)[kLanes]) {
    return at.gather([&](std::size_t axis, std::size_t l) { return elements[l]->curl[axis]; });
  };
  if (rules.spring_turns) pair.rotation = Real(0.25 * dt) * (curl(b.target) + curl(b.contactor));
  pair.continues = at.load(b.continues);
  pair.stored_by_old_law = at.load(b.stored_by_old_law);
  pair.damping_before = at.load(b.damping_before);
  pair.rules = rules;
  PairHistory<Real> h;
  for_each_pair_number([&](const PairNumber&, auto& x, const ContactRow& row) { x = at.load(row); }, h, b.history);
  const PairEnergies<Real> e = evaluate(pair, dt, h);
  for_each_pair_number([&](const PairNumber&, const auto& x, ContactRow& row) { at.store(x, row); }, h, b.history);
  at.store(e.stored, b.stored);
  at.store(e.stored_in_spring, b.stored_in_spring);
  at.store(e.lost, b.lost);
  at.store(e.damped, b.damped);
  at.store(e.rubbed, b.rubbed);
}

template <class Real>
inline void locate_block(LocateBlock& block) {
  for (std::size_t first = 0; first < kLanes; first += width<Real>()) locate<Real>(block, first);
}
template <class Real>
inline void prepare_block(const double* x, const double* volume, StepElement* elements) {
  for (std::size_t first = 0; first < kLanes; first += width<Real>()) prepare<Real>(x, volume, elements, first);
}
template <class Real>
inline void move_elements_block(const double* v, StepElement* elements) {
  for (std::size_t first = 0; first < kLanes; first += width<Real>()) move_elements<Real>(v, elements, first);
}
template <class Real>
inline void move_block(double dt, PairBlock& block) {
  for (std::size_t first = 0; first < kLanes; first += width<Real>()) move<Real>(dt, block, first);
}
template <class Real>
inline void evaluate_block(double dt, const EvaluationRules& rules, PairBlock& block) {
  for (std::size_t first = 0; first < kLanes; first += width<Real>()) evaluate_some<Real>(dt, rules, block, first);
}
template <class Real>
[[nodiscard]] inline ContactKernels contact_kernels() {
  return {prepare_block<Real>, move_elements_block<Real>, locate_block<Real>, move_block<Real>, evaluate_block<Real>};
}

}  // namespace
}  // namespace breccia
