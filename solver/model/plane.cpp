#include "model/plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/index.hpp"
#include "mesh/geometry.hpp"
#include "mesh/tetrahedron.hpp"

namespace breccia {
namespace {

/// Of the thickness, and of the cosine between a normal and the axis: round-off of a mesh written with few digits.
constexpr double kFlat = 1e-6;

/// Cosine between the normal of a face and the axis, without its sign.
double along(const Mesh& mesh, Index element, int face, int axis) {
  const auto x = geometry::corners_of(mesh, element);
  const auto& f = kFaceCorners[at(face)];
  const Vec3 normal = (x[at(f[1])] - x[at(f[0])]).cross(x[at(f[2])] - x[at(f[0])]);
  return std::abs(normal[axis]) / normal.norm();
}

/// The planes between which a mesh lies, m along the axis.
struct Sides {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();

  [[nodiscard]] double thickness() const { return high - low; }
  [[nodiscard]] bool have(double z) const { return z - low <= kFlat * thickness() || high - z <= kFlat * thickness(); }
};

Sides sides_of(const Mesh& mesh, int axis) {
  Sides sides;
  for (const Vec3& x : mesh.nodes) {
    sides.low = std::min(sides.low, x[axis]);
    sides.high = std::max(sides.high, x[axis]);
  }
  return sides;
}

/// Why an element does not belong into a single layer, empty: it does.
std::string fault_of(const Mesh& mesh, const Topology& topology, Index element, const Sides& sides, int axis) {
  const auto x = geometry::corners_of(mesh, element);
  const auto on_sides = std::count_if(x.begin(), x.end(), [&](const Vec3& p) { return sides.have(p[axis]); });
  if (on_sides == 0) return "reaches neither of the two sides";
  for (int face = 0; face < 4; ++face) {
    const double cosine = along(mesh, element, face, axis);
    const auto& f = kFaceCorners[at(face)];
    const bool flat = std::all_of(f.begin(), f.end(), [&](int corner) { return sides.have(x[at(corner)][axis]); }) &&
                      cosine > 1 - kFlat;
    const FaceLink& link = topology.links[at(element)][at(face)];
    if (link.free() && !flat && cosine > kFlat) return "has a free face that neither lies on a side nor stands upright";
    if (link.inner() && cosine > 1 - kFlat) return "has another one above or below it";
  }
  return {};
}

}  // namespace

std::optional<PlaneModel> plane_model(const case_::Case& input) {
  if (!input.plane) return std::nullopt;
  return PlaneModel{input.plane->kind == case_::PlaneKind::strain, static_cast<int>(input.plane->axis)};
}

bool is_held_across(const PlaneModel& plane, double across, double lower_side, double edge) {
  return plane.strain || across - lower_side <= kFlat * edge;
}

double lower_side(const Mesh& mesh, int axis) { return sides_of(mesh, axis).low; }

bool on_side(const Mesh& mesh, Index element, int face, int axis) {
  return along(mesh, element, face, axis) > 1 - kFlat;
}

Topology without_sides(const Mesh& mesh, const Topology& topology, int axis) {
  Topology outline = topology;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (int face = 0; face < 4; ++face) {
      FaceLink& link = outline.links[at(e)][at(face)];
      if (link.free() && on_side(mesh, e, face, axis)) link.neighbour = FaceLink::kBeyond;
    }
  }
  return outline;
}

Layer layer_of(const Mesh& mesh, int axis) {
  std::vector<double> edges;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(mesh, e);
    for (int face = 0; face < 4; ++face) {
      if (!on_side(mesh, e, face, axis)) continue;
      const auto& f = kFaceCorners[at(face)];
      for (std::size_t i = 0; i < 3; ++i) edges.push_back((x[at(f[i])] - x[at(f[(i + 1) % 3])]).norm());
    }
  }
  Layer layer{sides_of(mesh, axis).thickness(), 0};
  if (edges.empty()) return layer;
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  layer.edge = *middle;
  return layer;
}

bool is_layer(const Mesh& mesh, const Topology& topology, int axis) {
  const Sides sides = sides_of(mesh, axis);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    if (!fault_of(mesh, topology, e, sides, axis).empty()) return false;
  }
  return mesh.num_elements() > 0;
}

void check_layer(const case_::Case& input, const Mesh& mesh, const Topology& topology) {
  if (!input.plane) return;
  const int axis = static_cast<int>(input.plane->axis);
  const Sides sides = sides_of(mesh, axis);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const std::string fault = fault_of(mesh, topology, e, sides, axis);
    if (fault.empty()) continue;
    const std::string name(1, "xyz"[axis]);
    throw InputError(Problem{input.file.string(), input.plane->origin.line, "plane",
                             "the mesh is not one flat layer across " + name + ": element " +
                                 std::to_string(mesh.element_id(e)) + " " + fault,
                             "a flat geometry extruded along " + name +
                                 " in one layer (gmsh: Extrude ... Layers{1}), or a raster with one cell along " + name,
                             ""});
  }
}

}  // namespace breccia
