#pragma once

#include <Eigen/Core>

#include <vector>

#include "base/index.hpp"

namespace breccia {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Its three components at the end.
inline void append(std::vector<double>& values, const Vec3& v) { values.insert(values.end(), {v[0], v[1], v[2]}); }

}  // namespace breccia
