#pragma once

#include <set>
#include <string>
#include <vector>

#include "mesh/gmsh_reader.hpp"

// Groups of the volumes and surfaces of a solid that gmsh has open; for solids.cpp and stl_solids.cpp.
namespace breccia::solids {

/// Throws InputError about the file.
[[noreturn]] void refuse(const GmshSource& source, const std::string& what, const std::string& allowed);

/// Refuses what gmsh would work on without end: a box of no thickness, or one that is longer than any length.
/// @param extent  of the box around all of the file, in its units
void demand_extent(const GmshSource& source, const Vec3& extent);

/// Names of physical groups, each once.
class Names {
 public:
  std::string free(const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; !taken_.insert(name).second; ++i) name = wanted + "_" + std::to_string(i);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

/// The name that a person gave, out of a label "Shapes/assembly/part"; empty: none, or one that OpenCASCADE made up.
[[nodiscard]] std::string given_name(const std::string& label);

/// Makes a physical group of entities of one dimension.
void add_group(int dimension, const std::vector<int>& entities, const std::string& name);

/// All entities of a dimension, ascending.
[[nodiscard]] std::vector<int> tags_of(int dimension);

}  // namespace breccia::solids
