#pragma once

#include "base/types.hpp"
#include "case/case.hpp"

namespace breccia {

// Strengths that scatter from joint to joint after Weibull. Of a joint of area A both strengths are multiplied by
//   s = (-ln u)^(1/m) / Gamma(1 + 1/m) (A_0/A)^(1/m),
// u uniform in (0, 1), drawn from the seed and the joint's id; m the modulus; A_0 the reference area, without which the
// last factor is 1. So the strengths of the case are means, with A_0 those of a joint of that area, and samples of n
// joints of A each break at the same mean as those of one joint of n A. Energies do not scatter.
// Source: [Weibull 1939]; in cohesive elements [Zhou and Molinari 2004].
//
// Joints of one class, two per cent wide, share their strengths and so their law.

/// Class of a joint: ln s in units of ln 1.02, rounded. The same on every machine and number of ranks.
/// @param id  of the joint in the whole model;  @param area  m2, > 0.  @pre joint.weibull_modulus > 0
[[nodiscard]] Index strength_class(const case_::Joint& joint, GlobalId id, double area);

/// Classes that numbers of the case can lead to lie between minus this and this.
inline constexpr Index kMostStrengthClasses = 1 << 17;

/// s of a class: 1.02^number.
[[nodiscard]] double strength_factor(Index number);

}  // namespace breccia
