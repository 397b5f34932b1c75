#include "observe/shown_memory.hpp"

#include <set>

namespace breccia {

double ShownNumber::of(const Domain& domain, Index slot) const {
  const Index group = domain.model.local.block_group[static_cast<std::size_t>(slot / kLanes)];
  const BulkLaw found = domain.model.elastic[static_cast<std::size_t>(group)].law;
  return found == law ? material_memory(domain.state.elements).of(slot)[place] : 0.0;
}

std::vector<ShownNumber> shown_numbers(const Model& model) {
  std::vector<ShownNumber> shown;
  std::set<BulkLaw> seen;
  for (const ElasticParams& params : model.elastic) {
    if (!seen.insert(params.law).second) continue;
    std::size_t place = 0;
    for (const MemoryField& field : memory_fields(params.law)) {
      if (field.components == 1) shown.push_back({field.name, params.law, place});
      place += static_cast<std::size_t>(field.components);
    }
  }
  return shown;
}

}  // namespace breccia
