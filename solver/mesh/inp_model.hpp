#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace breccia::inp {

/// What stands in an Abaqus input file, with its labels and names unresolved.
struct Element {
  std::int64_t label;
  int corners;  ///< 4, 3 or 2
  std::array<std::int64_t, 4> nodes;
  int line;
};

/// A member of a set: a label or the name of a set, of an instance or of the set's own part; a face of it.
struct Item {
  std::string instance;  ///< empty: the set's own part
  std::string name;      ///< empty: a label
  std::int64_t label = 0;
  int face = 0;  ///< 1 to 4 of a tetrahedron, 0: its free faces, or the triangle itself
};

struct Set {
  enum class Kind { nodes, elements, surface, node_surface } kind;
  std::string name;
  std::vector<Item> items;
  int line = 0;
};

struct Part {
  std::string name;  ///< empty: what stands outside parts
  std::vector<std::int64_t> node_labels;
  std::vector<Vec3> nodes;
  std::vector<Element> elements;
  std::vector<Set> sets;
  std::vector<std::string> sections;  ///< names of the element sets with a material
};

struct Instance {
  std::string name, part;
  Vec3 shift = Vec3::Zero();
  bool turned = false;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< of the axis
  double degrees = 0;
  int line = 0;
};

struct Model {
  std::vector<Part> parts;  ///< the first is what stands outside parts
  std::vector<Instance> instances;
  bool higher_order = false;
  std::vector<std::string> notes;
};

}  // namespace breccia::inp
