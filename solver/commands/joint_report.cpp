#include "commands/joint_report.hpp"

#include <fmt/core.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/index.hpp"
#include "mesh/geometry.hpp"
#include "mesh/tetrahedron.hpp"

namespace breccia {
namespace {

/// Softness added by the joints that is wanted, and more than that is worth a warning.
constexpr double kSoftness = 0.05, kWorthRaising = 1.1;

/// Young's modulus regained from the Lame constants.
double young(const ElasticParams& p) { return p.mu * (3 * p.lambda + 2 * p.mu) / (p.lambda + p.mu); }

/// Index into WholeModel::joint_groups.
std::size_t groups_of(const Model& model, const ModelJoint& joint) {
  return at(model.groups_of_joint_law[at(joint.law)]);
}

/// Indices of the groups of both sides.
std::pair<std::size_t, std::size_t> groups_beside(const Model& model, const ModelJoint& joint) {
  return {at(model.mesh.element_group[at(joint.face.a)]), at(model.mesh.element_group[at(joint.face.b)])};
}

/// Sum of A n n^T of the joints of a pair of groups over the volume of these, 1/m: under a stress along a unit vector d
/// joints of stiffness k in all directions add a strain of stress / k times d . this d.
Mat3 areas_per_volume(const Model& model, std::size_t groups) {
  Mat3 areas = Mat3::Zero();
  double volume = 0;
  std::vector<bool> counted(model.mesh.volume_groups.size(), false);
  for (const ModelJoint& joint : model.joints) {
    if (groups_of(model, joint) != groups) continue;
    const auto x = geometry::corners_of(model.mesh, joint.face.a);
    const auto& corners = kFaceCorners[static_cast<std::size_t>(joint.face.face_a)];
    const auto corner = [&](std::size_t i) { return x[static_cast<std::size_t>(corners[i])]; };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    areas += joint.face.area * normal * normal.transpose();
    counted[at(model.mesh.element_group[at(joint.face.a)])] = true;
    counted[at(model.mesh.element_group[at(joint.face.b)])] = true;
  }
  for (Index s = 0; s < model.local.num_slots; ++s) {
    if (counted[at(model.local.block_group[at(s / kLanes)])]) volume += model.local.volume[at(s)];
  }
  return volume > 0 ? Mat3(areas / volume) : Mat3(Mat3::Zero());
}

/// How much softer joints make a body, as a share of its compliance under uniaxial stress.
struct Softness {
  double mean = 0;        ///< of all directions; of a plane model of those in its plane
  double most = 0;        ///< in the softest of these
  Vec3 softest{0, 0, 0};  ///< that direction
  [[nodiscard]] bool is_even() const { return most < 1.2 * mean; }
};

/// @param young_over_stiffness  E/k, m
Softness softness_of(const Model& model, std::size_t groups, double young_over_stiffness) {
  Mat3 areas = areas_per_volume(model, groups);
  double directions = 3;
  if (model.plane) {
    areas.row(model.plane->axis).setZero();
    areas.col(model.plane->axis).setZero();
    directions = 2;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(areas);
  return {young_over_stiffness * areas.trace() / directions, young_over_stiffness * eigen.eigenvalues()[2],
          eigen.eigenvectors().col(2)};
}

/// "along x"
std::string words_of(const Vec3& direction) {
  constexpr double kAlong = 0.98;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[static_cast<Eigen::Index>(axis)]) > kAlong) return std::string("along ") + "xyz"[axis];
  }
  return fmt::format("along ({:.2g}, {:.2g}, {:.2g})", direction[0], direction[1], direction[2]);
}

/// Both sides of the joints of a pair.
struct Sides {
  Index softer = -1;           ///< group of the smaller Young's modulus; -1: there are no such joints
  double softer_young = 0;     ///< Pa, its modulus
  double interface_young = 0;  ///< Pa, 2 / (1/E_a + 1/E_b): of a crack along the interface
};
Sides sides_of(const Model& model, std::size_t groups) {
  for (const ModelJoint& joint : model.joints) {
    if (groups_of(model, joint) != groups) continue;
    const auto [a, b] = groups_beside(model, joint);
    const double young_a = young(model.elastic[a]), young_b = young(model.elastic[b]);
    return {static_cast<Index>(young_b < young_a ? b : a), std::min(young_a, young_b), 2 / (1 / young_a + 1 / young_b)};
  }
  return {};
}

/// Mean length of the edges of a joint, m; of a plane model as seen along its axis, without those that stand upright:
/// a crack runs through the thickness at once, whatever that is.
double edge_of(const Model& model, const JointFace& face) {
  if (!model.plane) return face.size;
  constexpr double kUpright = 1e-6;  // of an edge: round-off of a mesh written with few digits
  const auto x = geometry::corners_of(model.mesh, face.a);
  const auto& corners = kFaceCorners[static_cast<std::size_t>(face.face_a)];
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 edge = x[static_cast<std::size_t>(corners[(i + 1) % 3])] - x[static_cast<std::size_t>(corners[i])];
    const double length = edge.norm();
    edge[model.plane->axis] = 0;
    if (edge.norm() <= kUpright * length) continue;
    sum += edge.norm();
    ++count;
  }
  return count > 0 ? sum / count : face.size;
}

/// Edges of the joints of a pair, m.
struct Edges {
  double mean = 0;
  double fine = 0;  ///< below which those of a tenth of the joints are
};
Edges edges_of(const Model& model, std::size_t groups) {
  std::vector<double> edges;
  for (const ModelJoint& joint : model.joints) {
    if (groups_of(model, joint) == groups) edges.push_back(edge_of(model, joint.face));
  }
  if (edges.empty()) return {};
  const double mean = std::accumulate(edges.begin(), edges.end(), 0.0) / static_cast<double>(edges.size());
  const auto tenth = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 10);
  std::nth_element(edges.begin(), tenth, edges.end());
  return {mean, *tenth};
}

/// Whether a group has joints of its own that can break.
bool breaks_inside(const Model& model, Index group) {
  for (std::size_t l = 0; l < model.whole.joint_groups.size(); ++l) {
    const WholeModel::JointGroups& groups = model.whole.joint_groups[l];
    if (groups.a == group && groups.b == group) return model.joint_laws[l].breakable();
  }
  return false;
}

/// Whether the joints of a pair lie on planes between two groups neither of which can break inside.
bool path_is_given(const Model& model, std::size_t l) {
  const WholeModel::JointGroups& groups = model.whole.joint_groups[l];
  return groups.a != groups.b && !breaks_inside(model, groups.a) && !breaks_inside(model, groups.b);
}

/// Least length of the fracture process zone of a pair, m: the lesser of two estimates.
double process_zone(const Model& model, std::size_t groups) {
  const JointLawParams& law = model.joint_laws[groups];
  const double length = sides_of(model, groups).interface_young * law.width_normal / law.tensile_strength;
  return std::min(length / 4, std::numbers::pi * length / 32);
}

/// Elements are of different sizes where the finest tenth is below this share of the mean.
constexpr double kGraded = 0.7;

/// Share of the process zone that elements should have, so that several lie across it.
constexpr double kWanted = 1.0 / 3;

/// Finer elements or shorter steps than this are not advised: elements would be 8,000 times as many.
constexpr double kWorthRefining = 20;

bool beyond_refining(double h, double zone) { return h > kWorthRefining * kWanted * zone; }

/// What depends on the mesh, and what to do: one aim, whatever the elements are.
/// @param refinement  to a third of the process zone;  @param larger  they are larger than all of it
std::string refine(double refinement, bool larger, bool given) {
  const std::string by = fmt::format("Refine by {:.2g}, to a third of that zone,", refinement);
  const char* instead = " or take the results as qualitative.";
  if (given) {
    return fmt::format(
        "the load at fracture and the speed of the crack depend on the mesh; its path is given, between two groups "
        "that cannot break. {}{}",
        by, larger ? instead : " where load and speed matter.");
  }
  if (larger) return fmt::format("the load at fracture and the crack paths depend on the mesh. {}{}", by, instead);
  return fmt::format(
      "crack paths and branching depend on the mesh. {} where cracks are to branch or turn; a fine mesh alone does not "
      "make a crack branch, that takes enough load as well.",
      by);
}

/// Element size against the process zone, m.
/// @param given  the joints lie on planes alone: see path_is_given
std::string zone_advice(const std::string& name, double zone, const Edges& edges, bool given) {
  constexpr double kClearlyLarger = 1.1;
  const double h = edges.mean, fine = edges.fine;
  if (h <= kWanted * zone) return {};
  const std::string elements = fmt::format("The elements of {} (edge {:.3g} m)", name, h);
  if (fine < kGraded * h && fine <= kWanted * zone) {
    return fmt::format(
        "{} are larger than a third of its fracture process zone ({:.3g} m), but for the finest tenth (below {:.3g} "
        "m): trust fracture in that part alone.",
        elements, zone, fine);
  }
  if (beyond_refining(h, zone)) {
    return fmt::format(
        "{} are far larger than its fracture process zone, which no practicable mesh resolves: how these joints break "
        "depends on the mesh. It is of no concern where a group was made soft for an excavation, or in a thin soft "
        "layer; else look at young, tensile_strength and energy_mode_1.",
        elements);
  }
  const bool larger = h > kClearlyLarger * zone;
  const std::string share = larger            ? "larger than"
                            : h < 0.95 * zone ? fmt::format("{:.2g} of", h / zone)
                                              : "as large as";
  const std::string finest = fine < kGraded * h ? fmt::format(", in the finest tenth {:.2g} of it", fine / zone) : "";
  return fmt::format("{} are {} its fracture process zone ({:.3g} m){}: {}", elements, share, zone, finest,
                     refine(h / (kWanted * zone), larger, given));
}

/// Strengths that scatter, of the joints of a pair; empty: they do not.
std::string scatter_report(const Model& model, std::size_t groups) {
  if (model.whole.joint_groups[groups].num_classes == 0) return {};
  std::vector<double> strengths;
  for (const ModelJoint& joint : model.joints) {
    if (groups_of(model, joint) == groups) strengths.push_back(model.joint_laws[at(joint.law)].tensile_strength);
  }
  if (strengths.empty()) return {};
  std::sort(strengths.begin(), strengths.end());
  const double mean = std::accumulate(strengths.begin(), strengths.end(), 0.0) / static_cast<double>(strengths.size());
  return fmt::format("  tensile strengths scatter from {:.4g} to {:.4g} Pa, mean {:.4g} Pa, a tenth below {:.4g} Pa\n",
                     strengths.front(), strengths.back(), mean, strengths[strengths.size() / 10]);
}

/// Of joints that cannot break: whether they could, on the interface of a breakable group; else empty.
std::string glue_line(const Model& model, std::size_t l) {
  const WholeModel::JointGroups& groups = model.whole.joint_groups[l];
  if (groups.a == groups.b || !(breaks_inside(model, groups.a) || breaks_inside(model, groups.b))) return {};
  return "  they cannot break: their [[joint]] has no tensile_strength\n";
}

/// What is advised on the joints of a pair of groups; empty: nothing.
struct Finding {
  double weight = 0;
  std::string advice;
};
struct LawReport {
  std::string text;
  Finding softness, zone;
};

/// Of the findings on joints that follow one entry of the case the heaviest, in the order of the first of each.
class Heaviest {
 public:
  void add(const std::string& key, Finding finding) {
    const auto [known, fresh] = place_.emplace(key, findings_.size());
    if (fresh) findings_.emplace_back();
    Finding& told = findings_[known->second];
    if (!finding.advice.empty() && finding.weight > told.weight) told = std::move(finding);
  }
  void tell(Advice& advice) {
    for (Finding& finding : findings_) advise(advice, std::move(finding.advice));
  }

 private:
  std::vector<Finding> findings_;
  std::map<std::string, std::size_t> place_;
};

/// How advice names the joints of a pair of groups.
std::string advised_name(const Model& model, std::size_t l) {
  const std::vector<std::string>& keys = model.joint_law_keys;
  const auto laws = std::count(keys.begin(), keys.end(), keys[l]);
  const std::string& name = model.joint_law_names[l];
  return laws == 1 ? name : fmt::format("{} (the worst of {} that follow {})", name, laws, keys[l]);
}

/// The joints of a pair of groups: penalty, softness, process zone.
LawReport law_report(const Model& model, std::size_t l) {
  const JointLawParams& law = model.joint_laws[l];
  const Edges edges = edges_of(model, l);
  const Softness softness = softness_of(model, l, sides_of(model, l).softer_young / law.stiffness);
  const double typical = softness.is_even() ? softness.mean : softness.most;
  // Joints of one k lie the closer the finer the elements are.
  const bool graded = edges.fine > 0 && edges.fine < kGraded * edges.mean;
  const double softest = graded ? typical * edges.mean / edges.fine : typical;
  const std::string where = softness.is_even() ? "" : " " + words_of(softness.softest);
  const std::string name = advised_name(model, l);
  LawReport report;
  report.text =
      fmt::format("joints of {}: k = p/h = {:.4g} Pa/m with h = {:.4g} m; they make the body {:.2g} % softer{}{}\n",
                  model.joint_law_names[l], law.stiffness, model.joint_sizes[l], 100 * softness.mean,
                  softness.is_even() ? "" : fmt::format(", {:.2g} %{}", 100 * softness.most, where),
                  graded ? fmt::format(", {:.2g} % where a tenth of them is finest", 100 * softest) : "");
  if (softest > kWorthRaising * kSoftness) {
    report.softness = {softest,
                       fmt::format("The joints of {} make it {:.1f} % softer{}{}. For 5 % raise joint.penalty (or "
                                   "joint.penalty_factor, whichever "
                                   "the case has) by a factor of {:.2g}{}; the time step falls with its root.",
                                   name, 100 * softest, where, graded ? " where it is meshed finest" : "",
                                   softest / kSoftness, graded ? ", or give joint.size the edges of that part" : "")};
  }
  if (!law.breakable()) {
    report.text += glue_line(model, l);
    return report;
  }
  const double zone = process_zone(model, l);
  report.text +=
      fmt::format("  fracture process zone at least {:.4g} m; mean joint edge {:.4g} m{}, a tenth below {:.4g} m\n",
                  zone, edges.mean, model.plane ? " in the plane" : "", edges.fine);
  report.text += scatter_report(model, l);
  report.zone = {edges.mean / zone, zone_advice(name, zone, edges, path_is_given(model, l))};
  return report;
}

}  // namespace

std::string joint_report(const Model& model, Advice& advice) {
  std::string text;
  Heaviest softness, zones;
  for (std::size_t l = 0; l < model.joint_law_names.size(); ++l) {
    LawReport report = law_report(model, l);
    text += report.text;
    softness.add(model.joint_law_keys[l], std::move(report.softness));
    zones.add(model.joint_law_keys[l], std::move(report.zone));
  }
  softness.tell(advice);
  zones.tell(advice);
  return text;
}

Advice sudden_softening(const Model& model, double dt) {
  // Measured on a glass bar that breaks in tension, with 3.8, 7.6, 10, 15 and 30 steps: residual 6.0, 2.0, 1.25, 0.5
  // and 0.13 %; damping of damaged joints 54, 45, 43, 32 and 18 % of the work; fracture 20 % with 3.8, 27 % with 15.
  constexpr double kEnough = 10;
  Heaviest sudden;
  for (std::size_t l = 0; l < model.joint_law_names.size(); ++l) {
    const JointLawParams& law = model.joint_laws[l];
    const Index group = sides_of(model, l).softer;
    if (!law.breakable() || group < 0) continue;
    const double impedance = std::sqrt(young(model.elastic[at(group)]) * model.density[at(group)]);
    const double steps = law.width_normal * impedance / (2 * law.tensile_strength * dt);
    if (steps >= kEnough) continue;
    // joint_report says that nothing resolves these.
    if (kEnough / steps > kWorthRefining && beyond_refining(edges_of(model, l).mean, process_zone(model, l))) continue;
    sudden.add(model.joint_law_keys[l],
               {1 / steps, fmt::format("The joints of {} soften within {:.2g} steps, too few to follow: of a glass bar "
                                       "6 % of the energy was lost "
                                       "with 3.8 steps, 1.3 % with 10, and damping took more than fracture "
                                       "(time.residual_limit ends a run that loses "
                                       "too much). With a time.safety {:.2g} times smaller it is 10 steps.",
                                       advised_name(model, l), steps, kEnough / steps)});
  }
  Advice advice;
  sudden.tell(advice);
  return advice;
}

}  // namespace breccia
