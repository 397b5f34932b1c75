#include "mesh/gmsh/solid_groups.hpp"

#include <gmsh.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/number_text.hpp"

namespace breccia::solids {

void refuse(const GmshSource& source, const std::string& what, const std::string& allowed) {
  throw InputError(Problem{source.file.string(), 0, "mesh.file", what, allowed, ""});
}

void demand_extent(const GmshSource& source, const Vec3& extent) {
  constexpr double kLongest = 1e15, kThinnest = 1e-9;  // units of the file; of the longest
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::string along = std::string(" along ") + "xyz"[axis];
    if (!(extent[axis] <= kLongest))
      refuse(source, "is " + number_text(extent[axis], 3) + " long" + along, "up to 1e15 units of the file");
    if (extent[axis] <= kThinnest * extent.maxCoeff())
      refuse(source, "has no thickness" + along, "solids, at least 1e-9 times as thick as they are long");
  }
}

std::string given_name(const std::string& label) {
  const std::string name = label.substr(label.rfind('/') + 1);
  const bool made_up = name.starts_with("Open CASCADE STEP translator") || name == "SOLID" || name == "COMPOUND";
  return made_up || name == "*" ? std::string() : name;
}

void add_group(int dimension, const std::vector<int>& entities, const std::string& name) {
  gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, entities), name);
}

std::vector<int> tags_of(int dimension) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  std::vector<int> tags;
  for (const auto& entity : entities) tags.push_back(entity.second);
  std::sort(tags.begin(), tags.end());
  return tags;
}

}  // namespace breccia::solids
