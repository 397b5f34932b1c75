#pragma once

#include <cstddef>
#include <span>

#include "base/index.hpp"
#include "physics/elasticity.hpp"

namespace breccia {

/// One quantity that the elements of a law with memory remember.
struct MemoryField {
  const char* name;
  const char* unit;  ///< SI
  int components;    ///< doubles, one behind the other
};

/// What an element of the law remembers, in the order of its numbers; empty for laws without memory. Zeros are the
/// virgin state of every law.
[[nodiscard]] std::span<const MemoryField> memory_fields(BulkLaw law);

/// Largest number of internal variables (doubles) of an element, for any law.
inline constexpr std::size_t kLargestMemory = 15;

/// Doubles an element of the law remembers.
[[nodiscard]] std::size_t memory_size(BulkLaw law);

/// Of these, the one of the plastic work so far, J/m3 of reference volume; -1: the law has no plastic flow.
[[nodiscard]] int plastic_work_place(BulkLaw law);

/// The memory of all elements: that of a slot from first + slot stride on. Empty: all are virgin.
struct MaterialMemory {
  const double* first = nullptr;
  std::size_t stride = 0;  ///< doubles a slot, >= memory_size of every law in the model

  [[nodiscard]] const double* of(Index slot) const;
};

// Laws element by element. @param f  deformation gradient, row-major

/// One step of a law with memory: the first Piola stress at f without its viscous part, Pa, and the new internal
/// variables. Code of the baseline instruction set, for callers of any.
/// @param memory  read and written;  @param piola  out: [9].  @pre has_memory(p.law)
void step_bulk_law(const ElasticParams& p, const double* f, double* memory, double* piola);

// What follows is for laws with memory alone, and leaves it as it is.

/// First Piola stress without its viscous part, Pa: that of the next step at f.
[[nodiscard]] elasticity::Tensor<double> bulk_piola(const ElasticParams& p, const elasticity::Tensor<double>& f,
                                                    const double* memory);

/// Stored energy, J/m3 of reference volume, once the memory is that of the step at f.
[[nodiscard]] double stored_energy(const ElasticParams& p, const elasticity::Tensor<double>& f, const double* memory);

/// Bound of the tangent of a law with memory, for the stable step, Pa/m2: the largest eigenvalue of an element's
/// stiffness is at most its volume times this. @param gradient  D_m^-1, row-major, 1/m
[[nodiscard]] double bulk_stiffness(const ElasticParams& p, const elasticity::Tensor<double>& f, const double* memory,
                                    const elasticity::Tensor<double>& gradient);

}  // namespace breccia
