#pragma once

#include <Eigen/Core>

#include "base/index.hpp"

namespace breccia {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace breccia
