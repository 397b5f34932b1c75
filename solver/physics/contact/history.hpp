#pragma once

#include <string_view>

#include "physics/contact/law/lag.hpp"
#include "physics/lane_vector.hpp"

namespace breccia {

/// A number that a couple remembers, or a component of a vector, as tables, files and messages name it.
struct PairNumber {
  std::string_view name, unit;
};

/// What a couple that touches remembers from step to step, over the number type: double, a SIMD vector, or a row of
/// numbers side by side. Zero: it has not touched yet.
template <class T>
struct PairHistory {
  using Vector = VectorOf<T>;
  T d = 0.0;                       ///< overlap over H, offset subtracted
  T d_max = 0.0;                   ///< largest d since the overlap began
  T share = 0.0;                   ///< of the weight of the point (geometry/outward.hpp), since the force began
  T sides = 0.0;                   ///< functions of the overlap that count (OverlapRows), a bit each
  T offset = 0.0;                  ///< m, overlap without force; < 0: force before an overlap (resolve.hpp)
  Vector spring{0.0, 0.0, 0.0};    ///< m, elongation of the friction spring
  Vector friction{0.0, 0.0, 0.0};  ///< N, tangential force on the point
  DelayedForceOf<T> delayed{};     ///< normal force that limits friction
  Vector force{0.0, 0.0, 0.0};     ///< N, whole force on the point
  T balance = 0.0;                 ///< fraction of its normal force by which the correction has changed it
  T gained = 0.0;                  ///< J, energy gain since the force began: work beyond absorbed and stored energy
  T gained_before = 0.0;           ///< J, the same of earlier overlaps, not yet corrected
};

/// The one list of a couple's numbers: calls f(PairNumber, the number in each of the histories) for all of them.
/// Components of a vector have its name and follow each other.
/// @param histories  any number of PairHistory, of different number types
template <class F, class... Histories>
[[gnu::always_inline]] constexpr void for_each_pair_number(F&& f, Histories&... histories) {
  f(PairNumber{"overlap", "1"}, histories.d...);
  f(PairNumber{"largest_overlap", "1"}, histories.d_max...);
  f(PairNumber{"share", "1"}, histories.share...);
  f(PairNumber{"sides", "1"}, histories.sides...);
  f(PairNumber{"offset", "m"}, histories.offset...);
  f(PairNumber{"spring", "m"}, histories.spring[0]...);
  f(PairNumber{"spring", "m"}, histories.spring[1]...);
  f(PairNumber{"spring", "m"}, histories.spring[2]...);
  f(PairNumber{"friction", "N"}, histories.friction[0]...);
  f(PairNumber{"friction", "N"}, histories.friction[1]...);
  f(PairNumber{"friction", "N"}, histories.friction[2]...);
  f(PairNumber{"delayed_force", "N"}, histories.delayed.force...);
  f(PairNumber{"age", "s"}, histories.delayed.age...);
  f(PairNumber{"delayed_force_halfway", "N"}, histories.delayed.halfway...);
  f(PairNumber{"force", "N"}, histories.force[0]...);
  f(PairNumber{"force", "N"}, histories.force[1]...);
  f(PairNumber{"force", "N"}, histories.force[2]...);
  f(PairNumber{"balance", "1"}, histories.balance...);
  f(PairNumber{"gained", "J"}, histories.gained...);
  f(PairNumber{"gained_before", "J"}, histories.gained_before...);
}

}  // namespace breccia
