#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "case/case.hpp"
#include "mesh/mesh.hpp"

namespace breccia {

/// What forces on the groups of a mesh are shared by.
struct GroupSizes {
  std::vector<double> volume_mass;   ///< (volume groups) kg
  std::vector<double> surface_area;  ///< (surface groups) m2 at rest, of both sides of an inner surface
  /// (curves and points, then element sets) kg, a quarter of every element for each of its corners
  std::vector<double> node_group_mass;
};

/// What depends on the model as a whole, the same on every rank.
struct WholeModel {
  /// A pair of groups that joints hold together.
  struct JointGroups {
    Index a, b;             ///< a <= b
    double size;            ///< m, mean edge of their joints
    Index least_class = 0;  ///< of strength (strength_scatter.hpp) that any of them is in
    Index num_classes = 0;  ///< from that one on; 0: all have the same strengths
  };
  std::string source;            ///< of the mesh, for messages
  std::vector<std::string> cut;  ///< surfaces that stages break, of all runs up to this one; ascending
  std::vector<std::string> volume_groups, surface_groups, node_groups, element_sets;
  std::int64_t num_elements = 0, num_joints = 0;
  std::vector<Index> node_sets;           ///< (volume groups) of shared nodes (node_sets.hpp), or empty
  std::vector<JointGroups> joint_groups;  ///< pair g has the joint law g, of mean strengths
  GroupSizes group_sizes;
  std::vector<double> body_length;  ///< (bodies) H of contact, m: mean inradius of the elements
  std::vector<double> body_extent;  ///< (bodies) m: diagonal of the box around it at rest
  double contactor_size = 0;        ///< m, mean size of the contactors
  double longest_edge = 0;          ///< m, of all elements, reference
  double lower_side = 0;            ///< m, along the axis of a plane model (plane.hpp); 0 of others
  double energy_floor = 0;          ///< J, energies below are round-off
  double step_ratio = 0;            ///< of the true stable step to the bound at rest (time_step.hpp); 0: not found yet
  /// (entries of initial_velocities) centres of mass of the bodies, m; empty: the entry neither turns nor stretches
  /// them
  std::vector<std::vector<Vec3>> motion_centres;

  /// The pair of two groups, as an index; -1: no joints hold them together.
  [[nodiscard]] Index pair_of(Index group, Index other) const;
  /// Joint laws in all: those of the pairs, then those of the classes of the first pair that has some, of the next, ...
  [[nodiscard]] std::int64_t num_joint_laws() const { return first_class_law(joint_groups.size()); }
  /// Law of the least class of pair `groups`.
  [[nodiscard]] std::int64_t first_class_law(std::size_t groups) const {
    auto law = static_cast<std::int64_t>(joint_groups.size());
    for (std::size_t g = 0; g < groups; ++g) law += joint_groups[g].num_classes;
    return law;
  }
};

/// The part that follows from the mesh alone: sizes, bodies and centres; without joints, contact and the step.
/// @param lambda_2mu  (volume groups) Pa;  @param density  (volume groups) kg/m3. O(elements).
[[nodiscard]] WholeModel whole_of(const case_::Case& input, const Mesh& mesh, const std::vector<double>& lambda_2mu,
                                  const std::vector<double>& density);

}  // namespace breccia
