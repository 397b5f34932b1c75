#include "advice/rule_functions.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "advice/solids.hpp"
#include "base/index.hpp"
#include "base/quantity_text.hpp"
#include "mesh/geometry.hpp"

namespace breccia {
namespace {

constexpr double kLocking = 2.0;  // c
constexpr double kFine = 4;       // elements across the thickness that is advised

double share_of_bending(double edges_over_thickness) {
  return 1 / (1 + kLocking * edges_over_thickness * edges_over_thickness);
}

/// Integrals over a solid.
struct Shape {
  std::int64_t elements = 0;
  double volume = 0;           ///< m3
  double area = 0;             ///< m2, of its free faces
  Vec3 first = Vec3::Zero();   ///< m4
  Mat3 second = Mat3::Zero();  ///< m5, elements as points
  Index group = -1;            ///< of its first element

  void add(const std::array<Vec3, 4>& x, Index of_group) {
    const double v = geometry::tetra_volume(x[0], x[1], x[2], x[3]);
    const Vec3 centre = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    if (elements == 0) group = of_group;
    ++elements;
    volume += v;
    first += v * centre;
    second += v * centre * centre.transpose();
  }

  /// Edge of the regular tetrahedron of the mean volume, m.
  [[nodiscard]] double edge() const { return std::cbrt(6 * std::sqrt(2.0) * volume / static_cast<double>(elements)); }

  /// Whether it is long in one direction alone, as a beam or a thin ring is; else it is a plate or a shell.
  /// @param size  m, of the box around it
  [[nodiscard]] bool is_beam(double size) const {
    constexpr double kNarrow = 0.15, kHollow = 0.3;
    const Vec3 centre = first / volume;
    const Mat3 spread = second / volume - centre * centre.transpose();
    const Vec3 variance = Eigen::SelfAdjointEigenSolver<Mat3>(spread, Eigen::EigenvaluesOnly).eigenvalues();
    return variance[1] < kNarrow * variance[2] || 0.5 * area < kHollow * size * size;
  }
};

std::map<std::size_t, Shape> shapes_of(const Model& model, Solids& solids) {
  std::map<std::size_t, Shape> shapes;
  const Mesh& mesh = model.mesh;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    Shape& shape = shapes[solids.number(e)];
    const auto x = geometry::corners_of(mesh, e);
    shape.add(x, mesh.element_group[at(e)]);
    for (std::size_t f = 0; f < 4; ++f) {
      if (!model.topology.links[at(e)][f].free()) continue;
      const auto corner = [&](std::size_t i) { return x[at(kFaceCorners[f][i])]; };
      shape.area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    }
  }
  return shapes;
}

/// Whether every stage prescribes all of its motion.
std::vector<bool> never_bent(const case_::Case& input, Solids& solids) {
  std::vector<bool> rigid(solids.end(), !input.stages.empty());
  for (const case_::Stage& stage : input.stages) {
    solids.hold(stage);
    for (std::size_t i = 0; i < solids.end(); ++i) rigid[i] = rigid[i] && solids[i].whole;
  }
  return rigid;
}

struct Slender {
  double share = 1;      ///< of the bending that it should have
  double layers = 0;     ///< elements across
  double thickness = 0;  ///< m
};

}  // namespace

Sentences stiff_bending(const case_::Case& input, const Model& model) {
  constexpr double kSlenderBeam = 5, kSlenderPlate = 10, kAcceptableShare = 0.75;
  // Elements, of a grain: a tetrahedron is as thin by volume over area as a plate.
  constexpr std::int64_t kGrainElements = 8;
  if (model.plane) return {};
  Solids solids(model);
  const std::vector<bool> rigid = never_bent(input, solids);
  std::map<Index, Slender> worst;  // by group
  for (const auto& [number, shape] : shapes_of(model, solids)) {
    const double size = solids[number].size();
    const bool beam = shape.is_beam(size);
    const double thickness = (beam ? 4 : 2) * shape.volume / shape.area;
    if (shape.elements < kGrainElements || rigid[number] || size < (beam ? kSlenderBeam : kSlenderPlate) * thickness)
      continue;
    const double share = share_of_bending(shape.edge() / thickness);
    Slender& of_group = worst[shape.group];
    if (share < of_group.share) of_group = {share, thickness / shape.edge(), thickness};
  }
  Sentences advice;
  for (const auto& [group, slender] : worst) {
    if (slender.share > kAcceptableShare) continue;
    advice.push_back(fmt::format(
        "{} is slender and about {:.2g} elements thick. Linear tetrahedra are too stiff in bending: its deflection is "
        "about {:.0f} % of the theoretical one. Where bending matters, use elements of a {:.0f}th of its thickness "
        "({}) or less: about {:.0f} %.",
        model.mesh.volume_groups[at(group)], slender.layers, 100 * slender.share, kFine,
        quantity_text(slender.thickness / kFine, "m"), 100 * share_of_bending(1 / kFine)));
  }
  return advice;
}

}  // namespace breccia
