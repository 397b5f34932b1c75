#pragma once

#include <array>
#include <cstddef>

#include "base/field.hpp"
#include "physics/material/bulk_law.hpp"

namespace breccia {

/// A number, or several, that an element remembers beside the positions and velocities of its nodes.
struct ElementField {
  const char* name;
  const char* unit;  ///< SI
  std::size_t components;
};

/// Which field: the row of the table.
enum ElementFieldId : std::size_t { kViscousWork, kStressWork, kMaterialMemory, kNumElementFields };

/// The table. All that stands here travels, is hashed and is checkpointed. What a bulk law remembers stands in the list
/// of that law (physics/material/bulk_law.hpp).
inline constexpr std::array<ElementField, kNumElementFields> kElementFields{{
    {"viscous_work", "J", 1},  ///< done against viscosity so far (sweep.hpp)
    {"stress_work", "J", 1},   ///< done by the elastic stress of laws without an energy so far
    {"material_memory", "as memory_fields of the law", kLargestMemory},
}};

inline constexpr std::size_t kNumElementNumbers = [] {
  std::size_t sum = 0;
  for (const ElementField& field : kElementFields) sum += field.components;
  return sum;
}();

/// Where the numbers of a field begin among all of an element.
[[nodiscard]] constexpr std::size_t first_number(ElementFieldId id) {
  std::size_t first = 0;
  for (std::size_t earlier = 0; earlier < id; ++earlier) first += kElementFields[earlier].components;
  return first;
}

/// All of them for one element, in the order of the table.
using ElementNumbers = std::array<double, kNumElementNumbers>;

/// The fields of a rank's elements in the layout of the sweep: [slot][components]. Those that no material of the
/// case needs are empty.
class ElementFields {
 public:
  [[nodiscard]] Field<double>& operator[](ElementFieldId id) { return fields_[id]; }
  [[nodiscard]] const Field<double>& operator[](ElementFieldId id) const { return fields_[id]; }

  /// From now on the field is kept. @param slots  a multiple of 8
  void allocate(ElementFieldId id, Index slots) {
    fields_[id].assign(static_cast<std::size_t>(slots) * kElementFields[id].components, 0.0);
  }
  /// 0 for fields that are not kept.
  [[nodiscard]] ElementNumbers of(Index slot) const {
    ElementNumbers numbers{};
    std::size_t next = 0;
    for (std::size_t id = 0; id < kNumElementFields; ++id) {
      for (std::size_t c = 0; c < kElementFields[id].components; ++c, ++next) {
        if (!fields_[id].empty()) numbers[next] = fields_[id][place(id, slot, c)];
      }
    }
    return numbers;
  }
  /// Numbers of fields that are not kept are passed over.
  void set(Index slot, const ElementNumbers& numbers) {
    std::size_t next = 0;
    for (std::size_t id = 0; id < kNumElementFields; ++id) {
      for (std::size_t c = 0; c < kElementFields[id].components; ++c, ++next) {
        if (!fields_[id].empty()) fields_[id][place(id, slot, c)] = numbers[next];
      }
    }
  }

 private:
  [[nodiscard]] static std::size_t place(std::size_t id, Index slot, std::size_t component) {
    return static_cast<std::size_t>(slot) * kElementFields[id].components + component;
  }

  std::array<Field<double>, kNumElementFields> fields_;
};

/// What the elements of laws with memory remember, for those laws.
[[nodiscard]] inline MaterialMemory material_memory(const ElementFields& elements) {
  const Field<double>& memory = elements[kMaterialMemory];
  return {memory.empty() ? nullptr : memory.data(), kElementFields[kMaterialMemory].components};
}

}  // namespace breccia
