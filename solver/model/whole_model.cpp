#include "model/whole_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.hpp"
#include "mesh/geometry.hpp"
#include "mesh/quality.hpp"
#include "model/plane.hpp"

namespace breccia {
namespace {

/// Strains below this, or below so many round-offs of positions far from the origin over the size of the element, are
/// round-off: energies of that size are no measure for a residual.
constexpr double kRoundOffStrain = 1e-10, kRoundOffs = 100 * std::numeric_limits<double>::epsilon();

double volume_of(const std::array<Vec3, 4>& x) { return geometry::tetra_volume(x[0], x[1], x[2], x[3]); }

double longest_edge(const Mesh& mesh) {
  double longest = 0;
  for (Index e = 0; e < mesh.num_elements(); ++e)
    longest = std::max(longest, geometry::longest_edge(geometry::corners_of(mesh, e)));
  return longest;
}

/// Centre of mass of each body, m.
/// @param density  (volume groups) kg/m3
std::vector<Vec3> centres_of(const Mesh& mesh, const std::vector<double>& density) {
  std::vector<Vec3> centre(at(mesh.num_bodies), Vec3::Zero());
  std::vector<double> mass(centre.size(), 0.0);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(mesh, e);
    const double m = density[at(mesh.element_group[at(e)])] * volume_of(x);
    centre[at(mesh.element_body[at(e)])] += m * 0.25 * (x[0] + x[1] + x[2] + x[3]);
    mass[at(mesh.element_body[at(e)])] += m;
  }
  for (std::size_t b = 0; b < centre.size(); ++b) {
    if (mass[b] > 0) centre[b] /= mass[b];
  }
  return centre;
}

}  // namespace

Index WholeModel::pair_of(Index group, Index other) const {
  const Index low = std::min(group, other), high = std::max(group, other);
  const auto found = std::find_if(joint_groups.begin(), joint_groups.end(),
                                  [&](const JointGroups& pair) { return pair.a == low && pair.b == high; });
  return found == joint_groups.end() ? -1 : static_cast<Index>(found - joint_groups.begin());
}

WholeModel whole_of(const case_::Case& input, const Mesh& mesh, const std::vector<double>& lambda_2mu,
                    const std::vector<double>& density) {
  WholeModel whole;
  whole.source = mesh.source;
  whole.volume_groups = mesh.volume_groups;
  whole.surface_groups = mesh.surface_groups;
  whole.node_groups = mesh.node_groups;
  whole.element_sets = mesh.element_sets;
  whole.num_elements = mesh.num_elements();
  whole.body_length = mean_inradii(mesh);
  whole.body_extent = body_extents(mesh);
  whole.longest_edge = longest_edge(mesh);
  if (input.plane) whole.lower_side = lower_side(mesh, static_cast<int>(input.plane->axis));
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(mesh, e);
    const double volume = volume_of(x), strain = kRoundOffs * x[0].lpNorm<Eigen::Infinity>() / std::cbrt(volume);
    whole.energy_floor +=
        std::pow(std::max(kRoundOffStrain, strain), 2) * volume * lambda_2mu[at(mesh.element_group[at(e)])];
  }
  for (const case_::InitialVelocity& entry : input.initial_velocities) {
    std::vector<Vec3>& centres = whole.motion_centres.emplace_back();
    if (entry.angular != Vec3::Zero() || entry.strain_rate != Vec3::Zero()) centres = centres_of(mesh, density);
  }
  return whole;
}

}  // namespace breccia
