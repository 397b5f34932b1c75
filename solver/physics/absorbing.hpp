#pragma once

#include <span>
#include <vector>

#include "base/field.hpp"
#include "base/types.hpp"
#include "base/work_sum.hpp"
#include "discretisation/local_mesh.hpp"
#include "discretisation/nodal_state.hpp"
#include "physics/constraints.hpp"
#include "physics/loads.hpp"

namespace breccia {

/// Absorbing surfaces: the material continues behind them.
struct AbsorbingSurfaces {
  struct Part {
    LoadedFace face;
    double normal = 0;   ///< rho c_p, Pa s/m
    double tangent = 0;  ///< rho c_s, Pa s/m
  };
  std::vector<Part> faces;
  std::vector<Index> nodes;  ///< of the surfaces: those of the faces, and others of the same places

  [[nodiscard]] bool empty() const { return faces.empty(); }
};

/// Viscous boundary (Lysmer and Kuhlemeyer 1969): on each face the traction
///
///   t = -(rho c_p n n^T + rho c_s (I - n n^T)) v,
///
/// n its normal at rest, a third of its area to each corner. Waves along n leave without reflection, others with a
/// little. The force of a node is -C (v(n-1/2) + v(n+1/2)) / 2, C the sum over its faces, so that the boundary sets no
/// limit to the step. The forces of former constraints on its nodes continue (`supports`): a body at rest stays at
/// rest.
///
/// In a step: `begin` before the sweep, `apply` right after it, before constraints, `account_after` when the works up
/// to t_n have been read. O(nodes of the boundary), no allocation, throws nothing.
class AbsorbingBoundary {
 public:
  AbsorbingBoundary() = default;
  /// @param held  constrained axes are excluded
  /// @param before  constraint forces on nodes so far, ascending nodes
  /// @pre mesh outlives this object
  AbsorbingBoundary(const AbsorbingSurfaces& surfaces, const LocalMesh& mesh, const Constraints& held,
                    std::span<const NodeForce> before);

  void begin(const Field<double>& velocity);

  /// Corrects v(n+1/2) and next_position, from what the sweep made of the other forces:
  ///   (m + k C/2) v = m v_free + k S - k C/2 v(n-1/2),  k = kick_length(dt_before, dt).
  /// @param damping_before, damping_after  (num_nodes) J, what is dissipated in the halves of the step before and after
  /// t_n is added
  void apply(NodalState& state, double dt_before, double dt, double* damping_before, double* damping_after);

  /// Accounts the work of the supports over the step that begins at t_n.
  void account_after(const Field<double>& velocity, double dt);

  /// Work of the supports on the nodes that this rank counts, J.
  [[nodiscard]] const ExactSum& work() const { return work_.sum(); }
  /// Ascending nodes; those without a force are left out.
  [[nodiscard]] std::vector<NodeForce> supports() const;
  [[nodiscard]] bool empty() const { return nodes_.empty(); }

 private:
  struct Node {
    Index node;
    Mat3 impedance = Mat3::Zero();  ///< C, N s/m
    Vec3 support = Vec3::Zero();    ///< S, N
    Vec3 velocity = Vec3::Zero();   ///< m/s, before the step
  };
  const LocalMesh* mesh_ = nullptr;
  std::vector<Node> nodes_;  ///< ascending
  WorkSum work_;
};

}  // namespace breccia
