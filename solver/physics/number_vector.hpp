#pragma once

#include "base/types.hpp"
#include "physics/lane_vector.hpp"

namespace breccia {

template <>
struct VectorOver<double> {
  using Type = Vec3;
};

}  // namespace breccia
