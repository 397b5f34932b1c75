#pragma once

#include "base/types.hpp"
#include "discretisation/blocks.hpp"

namespace breccia {

/// Node's vector out of a nodal field.
[[nodiscard]] inline Vec3 load_node(const double* field, Index node) {
  const double* p = field + nodal(node, 0);
  return {p[0], p[8], p[16]};
}

inline void store_node(double* field, Index node, const Vec3& value) {
  double* p = field + nodal(node, 0);
  p[0] = value[0];
  p[8] = value[1];
  p[16] = value[2];
}

}  // namespace breccia
