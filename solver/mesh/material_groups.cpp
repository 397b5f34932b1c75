#include "mesh/material_groups.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/index.hpp"

namespace breccia {
namespace {

constexpr const char* kOneMaterial =
    "one [[material]] for every element: its other physical volumes serve constraints, loads, gauges and initial "
    "velocities, and need none";

std::string quoted(const std::vector<std::string>& names, const std::vector<Index>& chosen) {
  std::string text;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    text += std::string(i == 0 ? "" : i + 1 < chosen.size() ? ", " : " and ") + "\"" + names[at(chosen[i])] + "\"";
  return text;
}

}  // namespace

MaterialGroups material_groups(const PhysicalVolumes& physical, const std::vector<std::string>& materials,
                               const std::string& source, std::vector<Problem>& problems) {
  const std::vector<std::string>& names = physical.names;
  const auto has_material = [&](Index group) {
    return std::find(materials.begin(), materials.end(), names[at(group)]) != materials.end();
  };
  std::vector<std::uint8_t> carries(names.size(), 0), is_set(names.size(), 0);
  std::map<int, Index> chosen;
  for (const auto& [volume, groups] : physical.of_volume) {
    std::vector<Index> own;
    std::copy_if(groups.begin(), groups.end(), std::back_inserter(own), has_material);
    const Index carrier = own.empty() ? groups.front() : own.front();
    if (own.size() > 1)
      problems.push_back({source, 0, "volume " + std::to_string(volume), "lies in two physical volumes with a material",
                          kOneMaterial, quoted(names, own)});
    chosen[volume] = carrier;
    carries[at(carrier)] = 1;
    for (const Index group : groups) is_set[at(group)] |= group != carrier ? 1 : 0;
  }
  std::vector<Index> number(names.size(), -1);  // among those of its kind
  MaterialGroups result;
  for (std::size_t g = 0; g < names.size(); ++g) {
    if (carries[g] != 0 && is_set[g] != 0 && !materials.empty() && problems.empty())
      problems.push_back({source, 0, "physical volume \"" + names[g] + "\"",
                          "would carry the material of some of its elements only: others are of another group",
                          kOneMaterial, ""});
    std::vector<std::string>& list = carries[g] == 0 && is_set[g] != 0 ? result.element_sets : result.volume_groups;
    number[g] = static_cast<Index>(list.size());
    list.push_back(names[g]);
  }
  for (const auto& [volume, groups] : physical.of_volume) {
    result.group_of[volume] = number[at(chosen[volume])];
    for (const Index group : groups) {
      if (carries[at(group)] == 0) result.sets_of[volume].push_back(number[at(group)]);
    }
  }
  return result;
}

}  // namespace breccia
