#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/field.hpp"
#include "discretisation/blocks.hpp"

namespace breccia {

/// A number, or several, that an element remembers beside the positions and velocities of its nodes.
struct ElementField {
  const char* name;
  const char* unit;  ///< SI
  std::size_t components;
  bool shown;  ///< in frames and in-situ channels, under its name
};

/// Which field: the row of the table.
enum ElementFieldId : std::size_t { kViscousWork, kStressWork, kNumElementFields };

/// The table. A bulk law with memory adds its rows here; they then travel, are hashed and are checkpointed.
inline constexpr std::array<ElementField, kNumElementFields> kElementFields{{
    {"viscous_work", "J", 1, false},  ///< done against viscosity so far (sweep.hpp)
    {"stress_work", "J", 1, false},   ///< done by the elastic stress of laws without an energy so far
}};

inline constexpr std::size_t kNumElementNumbers = [] {
  std::size_t sum = 0;
  for (const ElementField& field : kElementFields) sum += field.components;
  return sum;
}();

/// All of them for one element, in the order of the table.
using ElementNumbers = std::array<double, kNumElementNumbers>;

/// The fields of a rank's elements in the layout of the sweep: [block][components][8]. Those that no material of the
/// case needs are empty.
class ElementFields {
 public:
  [[nodiscard]] Field<double>& operator[](ElementFieldId id) { return fields_[id]; }
  [[nodiscard]] const Field<double>& operator[](ElementFieldId id) const { return fields_[id]; }

  /// From now on the field is kept. @param slots  a multiple of 8
  void allocate(ElementFieldId id, Index slots) {
    kept_[id] = true;
    fields_[id].assign(static_cast<std::size_t>(slots) * kElementFields[id].components, 0.0);
  }
  /// Whether a material of the case needs it, alike on all ranks.
  [[nodiscard]] bool keeps(ElementFieldId id) const { return kept_[id]; }
  /// Appends the components of one field. @pre the field is kept
  void append(ElementFieldId id, Index slot, std::vector<double>& values) const {
    for (std::size_t c = 0; c < kElementFields[id].components; ++c) values.push_back(fields_[id][place(id, slot, c)]);
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
    const auto s = static_cast<std::size_t>(slot), lanes = static_cast<std::size_t>(kLanes);
    return (s / lanes * kElementFields[id].components + component) * lanes + s % lanes;
  }

  std::array<Field<double>, kNumElementFields> fields_;
  std::array<bool, kNumElementFields> kept_{};
};

}  // namespace breccia
