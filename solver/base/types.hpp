#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace breccia {

/// Local index of an element, node, joint or contact point on one rank.
using Index = std::int32_t;
/// Identity of an entity in the whole model, the same on any number of ranks.
using GlobalId = std::int64_t;

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace breccia
