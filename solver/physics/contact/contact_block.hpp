#pragma once

#include <cstddef>
#include <cstdint>

#include "base/index.hpp"
#include "discretisation/blocks.hpp"
#include "physics/contact/tetra_place.hpp"

namespace breccia {

/// Change of overlap over motion that is put down to the deformation and rotation of an element in one step.
inline constexpr double kSameSlope = 1e-3;
/// N; a pull as a share of less, at the far end of a steep curve, may overflow.
inline constexpr double kNoForce = 1e-60;

/// A number of each of eight couples: one cache line.
struct ContactRow {
  double lane[kLanes] = {};

  [[nodiscard]] double& operator[](std::size_t l) { return lane[l]; }
  [[nodiscard]] const double& operator[](std::size_t l) const { return lane[l]; }
};

/// Where the point of a couple is: in the contactor, so near that it may be as good as in it (kGap), farther away, or
/// nowhere, as the contactor is inert.
enum class Whereabouts : std::uint8_t { inside, beside, outside, nowhere };

/// Eight couples to be evaluated. Empty places are computed too, and have to be a contactor's.
struct alignas(64) LocateBlock {
  const PreparedTetra* tetra[kLanes] = {};
  ContactRow x[3];  ///< m, of the point
  // Results.
  ContactRow lambda[4];
  ContactRow safe;  ///< m, safe_travel() to kInside where it is beside the contactor, to kGap where it is outside
  Whereabouts where[kLanes] = {};
};

/// Eight couples in continued contact, each with a law of its own: data that the kernel reads and writes, in rows
/// (AoSoA). Empty places are computed too and discarded.
struct alignas(64) ContactBlock {
  // Where: the three nodes of the point's face and the four of the contactor.
  Index node[7][kLanes] = {};
  ContactRow shape[3], lambda[4];
  ContactRow lambda_gradient[3][3];  ///< 1/m, of lambda_1..3
  ContactRow depth[4];               ///< m, coefficients of the overlap function that counts
  // By the normal law, now and one step ago.
  ContactRow change;                 ///< m, of the overlap since the last step, by what the couple had then
  ContactRow deep;                   ///< m, d H
  ContactRow pressure;               ///< N, w sigma
  ContactRow stored, stored_before;  ///< J
  ContactRow lost;                   ///< J, dissipated in this step
  ContactRow last_force[3];          ///< N
  // Of the laws.
  ContactRow stiffness, tangential;  ///< N/m
  ContactRow exponent, friction, longest_delay;
  ContactRow turn[3];  ///< rad, of the two elements in the mean
  // Read and written, as in TouchingCouple.
  ContactRow spring[3], delayed_force, delayed_age, delayed_halfway, gained, gained_before;
  // Results.
  ContactRow force[3], tangential_force[3], balance;
  ContactRow spring_energy, slip_energy;  ///< J, stored in the spring, dissipated
  /// 1: not one of the couples that this kernel is for: what it has computed is void (`press_block`).
  std::uint8_t other[kLanes] = {};
};

/// One step of couples whose points stay under the same function of the overlap of the same contactor, with friction
/// and without damping: the very operations of contact_pass::Pass::touch in the same order, hence the same bits.
/// `other` is set where the scalar code has to evaluate the couple: another slope of the overlap than one step ago, no
/// motion, no force any more.
/// @param velocity  nodal field, m/s;  @param dt  s
using PressKernel = void (*)(double dt, const double* velocity, ContactBlock& block);
using LocateKernel = void (*)(LocateBlock& block);

/// Compiled for one instruction set.
struct ContactKernels {
  LocateKernel locate;
  PressKernel press;  ///< null: couples are evaluated one by one
};
[[nodiscard]] ContactKernels contact_kernels_sse2();
[[nodiscard]] ContactKernels contact_kernels_avx2();
[[nodiscard]] ContactKernels contact_kernels_avx512();

}  // namespace breccia
