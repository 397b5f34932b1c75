#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/field.hpp"
#include "base/types.hpp"
#include "discretisation/joint_links.hpp"
#include "discretisation/local_mesh.hpp"
#include "physics/elasticity.hpp"
#include "physics/material/bulk_law.hpp"

namespace breccia {

/// A joint that the sweep does not evaluate, at its stiffest: intact, or closed. No law is stiffer than k anywhere: the
/// parabolic rise begins with it, softening and unloading are softer, and the friction of the damaged share fills up to
/// it.
struct JointStiffness {
  Index slot_a = 0, slot_b = 0;
  std::int8_t face_a = 0, code = 0;  ///< as in JointFace
  bool mid_edge = false;             ///< sum_p N N^T = (1/2 on the diagonal, 1/4 off it) instead of 1
  double stiffness = 0;              ///< k A0 / 3, N/m
};

/// What the step depends on, contact apart.
struct StepModel {
  const LocalMesh& mesh;
  const JointLinks& links;                 ///< stiffness is 0 where the sweep has no joint
  std::span<const JointStiffness> joints;  ///< the others
  std::span<const ElasticParams> params;   ///< (volume groups)
  std::span<const double> density;         ///< (volume groups) kg/m3
  MaterialMemory memory{};
  double local_damping = 0;  ///< beta
};

/// Ratio of viscous to elastic stiffness of pressure waves, s.
[[nodiscard]] double viscous_ratio(const ElasticParams& params);

enum class StepLimit { element, joint, contact };

/// What contact adds to the corners of an element (contact/step/contact_step.hpp).
struct ContactShare {
  std::array<double, 4> omega_squared{};  ///< 1/s2
  int face = -1;                          ///< that brings the largest
  Index against = -1;                     ///< volume group that it meets
  [[nodiscard]] double largest() const {
    return std::max(std::max(omega_squared[0], omega_squared[1]), std::max(omega_squared[2], omega_squared[3]));
  }
};

/// Largest step of central differences, and what limits it.
struct StableStep {
  double step = 0;                       ///< s
  StepLimit limit = StepLimit::element;  ///< what adds most to the worst element's frequency
  GlobalId element = -1;                 ///< the worst element
  int face = -1;                         ///< its face, for a joint or a contact
  GlobalId neighbour = -1;               ///< element across that face, for a joint
  double element_step = 0;               ///< s, without joints and contact
  double joint_step = 0;                 ///< s, without contact
  std::array<double, 5> quantiles{};     ///< s: smallest, 1 %, 10 %, 50 % and largest of the elements' own steps
};

/// Frequencies squared, 1/s2, of one element by corner.
struct StepShare {
  std::array<double, 4> element{};  ///< alike for all corners of an own-node element
  std::array<double, 4> joint{};    ///< own nodes: by face, for each of its corners; shared nodes: by corner
  double damping = 0;               ///< 1/s
  bool by_face = false;             ///< own nodes

  /// omega_j^2 of a corner. @param open  bits of faces whose joints are released
  [[nodiscard]] double joint_at(int corner, unsigned open = 0) const;
  /// Largest omega_e^2, omega_j^2 and omega_e^2 + omega_j^2.
  [[nodiscard]] double largest_element() const { return *std::max_element(element.begin(), element.end()); }
  [[nodiscard]] double largest_joint() const;
  [[nodiscard]] double largest() const;
};

/// Bound by element, never above the true limit of the linear system at rest. With undamped frequency omega and damping
/// c
///
///   omega^2 = omega_e^2 + omega_j^2 + omega_c^2,  xi = c / (2 omega),  dt = (2/omega) (sqrt(1 + xi^2) - xi)
///
/// - element: omega_e^2 = (4/rho) sum_a [mu |g_a|^2 + psi''(J) |cof F g_a|^2], g_a the gradients of the shape
///   functions: at rest 4 c_p^2 sum_a h_a^-2, i.e. dt = 1/(c_p sqrt(sum_a h_a^-2)); with the present F it follows
///   crushed elements, below j_min with mu + |F| (psi'(j_min) - psi'(J)) for mu (always above the element's own
///   omega^2).
///   c = omega_e^2 2 mubar/(lambda + 2 mu).
///   Elements that share nodes: the mean of their omega_e^2 around each node, weighted with their masses.
///   Drucker-Prager: omega_e^2 = (4/rho) drucker_prager_stiffness (likewise).
/// - joints: omega_j^2 = 2 max_i (sum over the joints at node i of k A0/3) / m_i, for all kinds of
///   points; for shared nodes over all elements around a node
/// - contact: contact/step/contact_step.hpp
///
/// Local damping multiplies every force that decelerates a node by 1 + beta, and so omega^2 and c.
///
/// @param position  nodal field, m.  (num_slots), zeros on padding. O(elements).
[[nodiscard]] std::vector<StepShare> step_shares(const StepModel& model, const Field<double>& position);

/// Largest omega_e^2 + omega_j^2 of the originals; 0 without one.
[[nodiscard]] double stiffest(const StepModel& model, std::span<const StepShare> shares);

/// The step of the originals from their shares.
/// @param most      1/s2, that omega_e^2 + omega_j^2 is known not to exceed anywhere: the true limit
/// @param contacts  (num_slots), or empty: none
/// @param open      (num_slots) bits of faces whose joints are released, or empty: none
[[nodiscard]] StableStep stable_step(const StepModel& model, std::span<const StepShare> shares,
                                     double most = std::numeric_limits<double>::infinity(),
                                     std::span<const ContactShare> contacts = {},
                                     std::span<const std::uint8_t> open = {});

/// The step of single elements, as stable_step finds it.
class ElementSteps {
 public:
  /// @param most  as above
  ElementSteps(const StepModel& model, double most);
  /// s. @param open  bits of faces whose joints are released
  [[nodiscard]] double of(const StepShare& share, const ContactShare& contact, unsigned open) const;
  /// s. @param omega_squared, damping  1/s2 and 1/s, without local damping
  [[nodiscard]] double step_of(double omega_squared, double damping) const;
  /// 1/s: viscosity damps at most in proportion to the stiffness, and so does the true limit.
  [[nodiscard]] double damping(const StepShare& share) const { return std::min(share.damping, most_damping_); }

 private:
  double most_, most_damping_;
  double forces_;  ///< by how much local damping makes them larger, at least as far as the step goes
};

/// The same without contact at these positions. O(elements).
[[nodiscard]] StableStep stable_step(const StepModel& model, const Field<double>& position);

/// The limit itself at rest, without contact: 2/omega of the largest eigenvalue of M^-1 K (physics/largest_eigenvalue),
/// shorter by viscosity. Worth 2 to 3 times the bound for shared nodes on unstructured meshes; valid as long as no
/// insertion, no crushed element changes the model.
[[nodiscard]] double true_stable_step(const StepModel& model);

}  // namespace breccia
