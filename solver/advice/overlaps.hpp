#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "contact/initial_overlap.hpp"
#include "model/model.hpp"

/// Bodies that overlap before the first step.
namespace breccia {

/// The deepest overlap of two groups.
struct GroupOverlap {
  BodyOverlap deepest;
  std::int64_t pairs = 0, points = 0, corners = 0;
};

/// One for each pair of groups whose bodies overlap; none where there is no contact.
/// @param model  of the whole mesh; a bare one will do
[[nodiscard]] std::vector<GroupOverlap> overlaps_by_groups(const Model& model);

/// How deep, where, by how many points and with which stress contact would push, as a sentence without a full stop.
[[nodiscard]] std::string overlap_description(const Model& model, const GroupOverlap& groups);

/// The [[contact]] that rules the two.
[[nodiscard]] const case_::Contact& overlap_entry(const case_::Case& input, const Model& model,
                                                  const BodyOverlap& overlap);

/// What can be done about it.
[[nodiscard]] std::string overlap_remedy(const BodyOverlap& overlap);

}  // namespace breccia
