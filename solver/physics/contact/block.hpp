#pragma once

#include <cstddef>
#include <cstdint>

#include "base/index.hpp"
#include "discretisation/blocks.hpp"
#include "physics/contact/elements.hpp"
#include "physics/contact/evaluate.hpp"
#include "physics/contact/history.hpp"
#include "physics/contact/law/normal.hpp"

namespace breccia {

/// A number of each of eight couples: one cache line.
struct ContactRow {
  double lane[kLanes] = {};

  ContactRow(double all = 0.0) {
    for (double& x : lane) x = all;
  }
  [[nodiscard]] double& operator[](std::size_t l) { return lane[l]; }
  [[nodiscard]] const double& operator[](std::size_t l) const { return lane[l]; }
};

/// Where the point of a couple is: in the contactor, so near that it may be as good as in it (kGap), farther away, or
/// nowhere, as the contactor is inert.
enum class Whereabouts : std::uint8_t { inside, beside, outside, nowhere };

/// Eight couples whose points are located in their contactors. Empty places are computed too, and have to be a
/// contactor's.
struct alignas(64) LocateBlock {
  const PreparedTetra* tetra[kLanes] = {};
  ContactRow x[3];  ///< m, of the point
  // Results.
  ContactRow lambda[4];
  ContactRow safe;  ///< m, safe_travel() to kInside where it is beside the contactor, to kGap where it is outside
  Whereabouts where[kLanes] = {};
};

/// Eight couples in contact, each with a law of its own: all that evaluate() reads and writes, in rows (AoSoA). Empty
/// places are computed too and discarded.
struct alignas(64) PairBlock {
  const StepElement *target[kLanes] = {}, *contactor[kLanes] = {};
  const double* velocity[3][kLanes] = {};  ///< m/s, of the nodes of the point's face, three numbers each
  ContactRow shape[3], lambda[4];          ///< of the point on its face and in the contactor
  ContactRow depth[4];                     ///< m, coefficients of the overlap function that counts
  ContactRow overlap, overlap_before;      ///< m, g by the field of now and of one step ago
  const ContactLaw* common_law = nullptr;  ///< of all of them; null: `law` has those of each
  ContactLawOf<ContactRow> law;
  ContactRow weight = 1.0, length = 1.0;  ///< m2 of the point; m, H of the contactor's body
  ContactRow longest_delay;               ///< s
  ContactRow continues;                   ///< 1: the couple touched one step ago, 0: not
  // Of the motion of the last step.
  ContactRow motion[3];                  ///< m, of the point relative to the contactor's material
  ContactRow gradient[3];                ///< -, of the overlap
  ContactRow turn;                       ///< m, gradient times motion less the change of the overlap
  ContactRow stored_by_old_law;          ///< J, energy of the couple by its former law less that by the present one
  ContactRow damping_before;             ///< J, twice the work of the damping force of one step ago over the motion
  std::uint8_t same_slope[kLanes] = {};  ///< 1: the overlap has changed by gradient times motion; 0: not, or
                                         ///< nothing has moved
  PairHistory<ContactRow> history;       ///< one step ago, then now
  // Energies, J.
  ContactRow stored, stored_in_spring;  ///< now
  ContactRow lost, damped, rubbed;      ///< dissipated in this step by the normal law, by damping, by friction
};

using LocateKernel = void (*)(LocateBlock& block);
/// Places of eight elements. @param x  m, of their corners: [corner][axis][lane];  @param volume  (kLanes) m3, at rest
using PrepareKernel = void (*)(const double* x, const double* volume, StepElement* elements);
/// Velocities and curls of eight elements that are prepared. @param v  m/s, as x
using ElementMotionKernel = void (*)(const double* v, StepElement* elements);
/// Motion, gradient, turn and same_slope. @param dt  s
using MotionKernel = void (*)(double dt, PairBlock& block);
/// One step of all couples of the block (evaluate.hpp).
using EvaluateKernel = void (*)(double dt, const EvaluationRules& rules, PairBlock& block);

/// Compiled for one instruction set, or for one couple after the other. All give the same bits.
struct ContactKernels {
  PrepareKernel prepare;
  ElementMotionKernel move_elements;
  LocateKernel locate;
  MotionKernel move;
  EvaluateKernel evaluate;
};
[[nodiscard]] ContactKernels contact_kernels_scalar();
[[nodiscard]] ContactKernels contact_kernels_sse2();
[[nodiscard]] ContactKernels contact_kernels_avx2();
[[nodiscard]] ContactKernels contact_kernels_avx512();

}  // namespace breccia
