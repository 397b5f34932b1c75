#pragma once

#include "discretisation/blocks.hpp"
#include "physics/elasticity.hpp"
#include "physics/sweep.hpp"

namespace breccia {

/// What the elements of a volume group have in common.
struct FrequencyGroup {
  const ElasticParams* params = nullptr;  ///< of a law without memory
  double density = 0;                     ///< kg/m3
  double slope_at_j_min = 0;              ///< psi'(j_min), Pa
};

/// omega_e^2 of the elements of a block as stable_step.hpp defines it, 1/s2, [8].
/// @param corners  [4][3][8] positions, m   @param gradient  [9][8], as in LocalMesh
using FrequencyFunction = void (*)(const FrequencyGroup& group, const double* corners, const double* gradient,
                                   double* out);

/// The same bits for every instruction set. @pre simd_available(simd)
[[nodiscard]] FrequencyFunction frequencies_for(Simd simd);

}  // namespace breccia
