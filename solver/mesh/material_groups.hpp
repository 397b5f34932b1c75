#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"

namespace breccia {

/// The physical volumes of a geometry.
struct PhysicalVolumes {
  std::vector<std::string> names;               ///< by ascending tag
  std::map<int, std::vector<Index>> of_volume;  ///< of each volume with elements, ascending: indices into names
};

/// The physical volumes, divided into those that carry a material, one for each volume, and the others.
struct MaterialGroups {
  std::vector<std::string> volume_groups, element_sets;  ///< in the order of PhysicalVolumes::names
  std::map<int, Index> group_of;                         ///< of each volume: index into volume_groups
  std::map<int, std::vector<Index>> sets_of;             ///< of each volume that lies in some: into element_sets
};

/// Of several physical volumes that a volume lies in, the one with a material carries it. Where the case has none for
/// any of them, the first does. Physical volumes that share no volume with another are as they were.
/// @param materials  names of the groups that have one
/// @param problems   out: volumes in two groups with a material, groups that would carry it for some of their volumes
///                   only, each as @p source. O(volumes x groups of each).
[[nodiscard]] MaterialGroups material_groups(const PhysicalVolumes& physical, const std::vector<std::string>& materials,
                                             const std::string& source, std::vector<Problem>& problems);

}  // namespace breccia
