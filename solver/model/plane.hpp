#pragma once

#include <optional>

#include "case/case.hpp"
#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace breccia {

/// A model of plane strain or stress: a slice of one flat layer of elements. Its two flat sides, whose normals lie
/// along the axis, are no surface for contact. Under plane strain no node moves along the axis; under plane stress
/// those of the lower side do not, which is the middle plane of a plate of twice the thickness: free on both sides, a
/// slice would bend, buckle and leave the plane wherever contact pushes on it.
struct PlaneModel {
  bool strain = false;
  int axis = 2;
};

[[nodiscard]] std::optional<PlaneModel> plane_model(const case_::Case& input);

/// Thickness of a layer, and the median edge of the elements on its sides, m.
struct Layer {
  double thickness = 0, edge = 0;
};

/// Whether a node does not move along the axis. @param across  m, where it is along the axis in the reference
/// @param lower_side  m, WholeModel::lower_side;  @param edge  m, WholeModel::longest_edge
[[nodiscard]] bool is_held_across(const PlaneModel& plane, double across, double lower_side, double edge);

/// Where the lower side of the layer is, m along the axis. O(nodes)
[[nodiscard]] double lower_side(const Mesh& mesh, int axis);

/// @pre check_layer.  O(elements).
[[nodiscard]] Layer layer_of(const Mesh& mesh, int axis);

/// Whether the mesh is one flat layer across the axis: free faces lie on one of two planes or stand upright on them,
/// every element reaches one of the planes, and no face between two elements is parallel to them. O(elements)
[[nodiscard]] bool is_layer(const Mesh& mesh, const Topology& topology, int axis);

/// Throws InputError if a plane model is none.
void check_layer(const case_::Case& input, const Mesh& mesh, const Topology& topology);

/// Whether the face lies on a side of the layer. @pre check_layer: faces parallel to the sides lie on them
[[nodiscard]] bool on_side(const Mesh& mesh, Index element, int face, int axis);

/// The topology whose free faces are those of the outline alone: sides are no free surface.
[[nodiscard]] Topology without_sides(const Mesh& mesh, const Topology& topology, int axis);

}  // namespace breccia
