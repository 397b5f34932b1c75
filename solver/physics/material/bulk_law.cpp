#include "physics/material/bulk_law.hpp"

#include <algorithm>
#include <array>

#include "physics/material/drucker_prager.hpp"

namespace breccia {
namespace {

static_assert(kLargestMemory >= material::kDruckerPragerMemory);
constexpr std::array<double, kLargestMemory> kVirgin{};

}  // namespace

std::span<const MemoryField> memory_fields(BulkLaw law) {
  switch (law) {
    case BulkLaw::neo_hookean:
    case BulkLaw::green_st_venant:
      return {};
    case BulkLaw::drucker_prager:
      return material::kDruckerPragerFields;
  }
  return {};
}

std::size_t memory_size(BulkLaw law) {
  std::size_t size = 0;
  for (const MemoryField& field : memory_fields(law)) size += static_cast<std::size_t>(field.components);
  return size;
}

int plastic_work_place(BulkLaw law) {
  switch (law) {
    case BulkLaw::neo_hookean:
    case BulkLaw::green_st_venant:
      return -1;
    case BulkLaw::drucker_prager:
      return material::kDruckerPragerMemory - 1;
  }
  return -1;
}

const double* MaterialMemory::of(Index slot) const {
  return first == nullptr ? kVirgin.data() : first + static_cast<std::size_t>(slot) * stride;
}

void step_bulk_law(const ElasticParams& p, const double* f, double* memory, double* piola) {
  switch (p.law) {
    case BulkLaw::neo_hookean:
    case BulkLaw::green_st_venant:
      break;
    case BulkLaw::drucker_prager:
      material::drucker_prager_piola(p, f, memory, piola);
      break;
  }
}

elasticity::Tensor<double> bulk_piola(const ElasticParams& p, const elasticity::Tensor<double>& f,
                                      const double* memory) {
  std::array<double, kLargestMemory> passing{};
  std::copy_n(memory, memory_size(p.law), passing.begin());
  elasticity::Tensor<double> piola{};
  step_bulk_law(p, f.data(), passing.data(), piola.data());
  return piola;
}

double stored_energy(const ElasticParams& p, const elasticity::Tensor<double>& f, const double* memory) {
  switch (p.law) {
    case BulkLaw::neo_hookean:
    case BulkLaw::green_st_venant:
      return 0.0;
    case BulkLaw::drucker_prager:
      return material::drucker_prager_energy(p, f.data(), memory);
  }
  return 0.0;
}

double bulk_stiffness(const ElasticParams& p, const elasticity::Tensor<double>& f, const double* memory,
                      const elasticity::Tensor<double>& gradient) {
  switch (p.law) {
    case BulkLaw::neo_hookean:
    case BulkLaw::green_st_venant:
      return 0.0;
    case BulkLaw::drucker_prager:
      return material::drucker_prager_stiffness(p, f.data(), memory, gradient.data());
  }
  return 0.0;
}

}  // namespace breccia
