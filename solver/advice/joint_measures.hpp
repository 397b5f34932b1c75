#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

/// Measures of the joints of a pair of groups, which share one law, of the model at rest.
namespace breccia {

/// Young's modulus of Lame constants, Pa.
[[nodiscard]] inline double young(const ElasticParams& p) {
  return p.mu * (3 * p.lambda + 2 * p.mu) / (p.lambda + p.mu);
}

/// Index of a joint's pair of groups in WholeModel::joint_groups.
[[nodiscard]] std::size_t groups_of(const Model& model, const ModelJoint& joint);

/// How much softer joints make a body, as a share of its compliance under uniaxial stress.
struct Softness {
  double mean = 0;        ///< of all directions; of a plane model of those in its plane
  double most = 0;        ///< in the softest of these
  Vec3 softest{0, 0, 0};  ///< that direction
  [[nodiscard]] bool is_even() const { return most < 1.2 * mean; }
  /// " along x"; empty: it is even.
  [[nodiscard]] std::string where() const;
};

/// Both sides of the joints.
struct Sides {
  Index softer = -1;           ///< group of the smaller Young's modulus; -1: there are no such joints
  double softer_young = 0;     ///< Pa, its modulus
  double interface_young = 0;  ///< Pa, 2 / (1/E_a + 1/E_b): of a crack along the interface
};

/// Edges of the joints, m.
struct Edges {
  double mean = 0;
  double fine = 0;  ///< below which those of a tenth of the joints are
  /// Elements are of different sizes.
  [[nodiscard]] bool graded() const { return fine > 0 && fine < 0.7 * mean; }
};

struct JointMeasures {
  Sides sides;
  Edges edges;
  Softness softness;
  double softest = 0;  ///< softness in the worst direction, where the elements are finest
  double zone = 0;     ///< m, least length of the fracture process zone; 0: they cannot break
};

/// (laws) of each pair of groups in WholeModel::joint_groups.
using AllJointMeasures = std::vector<JointMeasures>;

/// O(pairs of groups x joints)
[[nodiscard]] AllJointMeasures joint_measures(const Model& model);

/// Whether a group has joints of its own that can break.
[[nodiscard]] bool breaks_inside(const Model& model, Index group);

}  // namespace breccia
