#pragma once

#include <array>
#include <span>

#include "base/field.hpp"
#include "base/types.hpp"
#include "discretisation/joint_links.hpp"
#include "discretisation/local_mesh.hpp"
#include "physics/elasticity.hpp"
#include "physics/material/bulk_law.hpp"

namespace breccia {

/// How stiff contact can be at a point of a face: k_c = w kappa b |grad g|^2, N/m (w area share, kappa = sigma_p / H, b
/// the exponent of the unloading branch, whose slope is b times that of loading).
struct ContactStiffness {
  Index slot;
  int face;                     ///< 0..3
  std::array<double, 3> shape;  ///< of the face's corners
  double stiffness;             ///< N/m
};

/// What the step depends on.
struct StepModel {
  const LocalMesh& mesh;
  const JointLinks& links;                     ///< stiffness is 0 where there never was a joint
  std::span<const ElasticParams> params;       ///< (volume groups)
  std::span<const double> density;             ///< (volume groups) kg/m3
  std::span<const ContactStiffness> contacts;  ///< points of a face in a row; empty: no contact
  double lightest_node = 0;                    ///< kg, of the whole model
  MaterialMemory memory{};
};

/// Smallest mass of a node, kg; infinite without one. O(nodes).
[[nodiscard]] double lightest_node(const LocalMesh& mesh);

enum class StepLimit { element, joint, contact };

/// Largest step of central differences, and what limits it.
struct StableStep {
  double step = 0;                       ///< s
  StepLimit limit = StepLimit::element;  ///< what adds most to the worst element's frequency
  GlobalId element = -1;                 ///< the worst element
  int face = -1;                         ///< its face, for a joint or a contact
  GlobalId neighbour = -1;               ///< element across that face while the joint is intact
  double element_step = 0;               ///< s, without joints and contact
  double joint_step = 0;                 ///< s, without contact
  std::array<double, 5> quantiles{};     ///< s: smallest, 1 %, 10 %, 50 % and largest of the elements' own steps
};

/// Bound by element, never above the true limit of the linear system at rest. With undamped frequency omega and damping
/// c
///
///   omega^2 = omega_e^2 + omega_j^2 + omega_c^2,  xi = c / (2 omega),  dt = (2/omega) (sqrt(1 + xi^2) - xi)
///
/// - element: omega_e^2 = (4/rho) sum_a [mu |g_a|^2 + psi''(J) |cof F g_a|^2], g_a the gradients of the shape
///   functions: at rest 4 c_p^2 sum_a h_a^-2, i.e. dt = 1/(c_p sqrt(sum_a h_a^-2)); with the present F it follows
///   crushed elements, below j_min with mu + |F| (psi'(j_min) - psi'(J)) for mu (on 2,000 random deformations each from
///   J = 1.5 to -0.5, neo-Hookean law, 1 to 180 % above the element's own omega^2).
///   c = omega_e^2 2 mubar/(lambda + 2 mu).
///   Elements that share nodes: the mean of their omega_e^2 around each node, weighted with their masses.
///   Drucker-Prager: omega_e^2 = (4/rho) drucker_prager_stiffness (1.35 to 14 times as much, likewise).
/// - joints, own nodes: omega_j^2 = 2 max_i (sum over the three faces of node i of k A0/3) / m_i
/// - contact: omega_c^2 = max over faces of sum over its points of k_c (sum_i N_i^2 / m_i + 1/m_c), the contactor's
///   node as light as the lightest of the model. An element pressed on several faces at once is left to the safety
///   factor.
///
/// @param position  nodal field, m. The result is that of the originals. O(elements).
[[nodiscard]] StableStep stable_step(const StepModel& model, const Field<double>& position);

/// The limit itself at rest, for elements (Hooke) and intact joints (links with a neighbour): 2/omega of the largest
/// eigenvalue of M^-1 K by Lanczos iteration from a fixed start, a few dozen products with K, none of it assembled.
/// Stops when the eigenvalue's residual is below 1 % and adds the residual and another 1 % on the safe side. Contact
/// and viscosity as in `stable_step`. Worth 2 to 3 times the bound for shared nodes on unstructured meshes; valid as
/// long as no insertion, no crushed element changes the model.
/// O(elements) by iteration, 300 bytes an own-node element of temporary memory.
[[nodiscard]] double true_stable_step(const StepModel& model);

}  // namespace breccia
