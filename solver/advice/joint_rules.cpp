#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "advice/joint_measures.hpp"
#include "advice/rule_functions.hpp"
#include "base/index.hpp"

namespace breccia {
namespace {

/// Whether the joints of a pair lie on planes between two groups neither of which can break inside.
bool path_is_given(const Model& model, std::size_t l) {
  const WholeModel::JointGroups& groups = model.whole.joint_groups[l];
  return groups.a != groups.b && !breaks_inside(model, groups.a) && !breaks_inside(model, groups.b);
}

/// Share of the process zone that elements should have, so that several lie across it.
constexpr double kWanted = 1.0 / 3;

/// Finer elements or shorter steps than this are not advised: elements would be 8,000 times as many.
constexpr double kWorthRefining = 20;

bool beyond_refining(double h, double zone) { return h > kWorthRefining * kWanted * zone; }

/// States the dependence on the mesh and the remedy: the same target size for all element sizes.
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
  if (edges.graded() && fine <= kWanted * zone) {
    return fmt::format(
        "{} are larger than a third of its fracture process zone ({:.3g} m), but for the finest tenth (below {:.3g} "
        "m): trust fracture in that part alone.",
        elements, zone, fine);
  }
  if (beyond_refining(h, zone)) {
    return fmt::format(
        "{} are far larger than its fracture process zone, which no practicable mesh resolves: the failure of these "
        "joints depends on the mesh. This is acceptable for a group made soft for an excavation and for a thin soft "
        "layer; otherwise check young, tensile_strength and energy_mode_1.",
        elements);
  }
  const bool larger = h > kClearlyLarger * zone;
  const std::string share = larger            ? "larger than"
                            : h < 0.95 * zone ? fmt::format("{:.2g} of", h / zone)
                                              : "as large as";
  const std::string finest = edges.graded() ? fmt::format(", in the finest tenth {:.2g} of it", fine / zone) : "";
  return fmt::format("{} are {} its fracture process zone ({:.3g} m){}: {}", elements, share, zone, finest,
                     refine(h / (kWanted * zone), larger, given));
}

/// What is advised on the joints of a pair of groups; empty: nothing.
struct Finding {
  double weight = 0;
  std::string advice;
};

/// Of the findings on joints that follow one entry of the case the heaviest, in the order of the first of each.
class Heaviest {
 public:
  void add(const std::string& key, Finding finding) {
    const auto [known, fresh] = place_.emplace(key, findings_.size());
    if (fresh) findings_.emplace_back();
    Finding& heaviest = findings_[known->second];
    if (!finding.advice.empty() && finding.weight > heaviest.weight) heaviest = std::move(finding);
  }
  [[nodiscard]] Sentences sentences() {
    Sentences advice;
    for (Finding& finding : findings_) add_to(advice, std::move(finding.advice));
    return advice;
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

}  // namespace

Sentences soft_joints(const Model& model, const AllJointMeasures& joints) {
  constexpr double kSoftness = 0.05, kWorthRaising = 1.1;  // wanted; reported from this multiple on
  Heaviest soft;
  for (std::size_t l = 0; l < model.joint_law_names.size(); ++l) {
    const JointMeasures& m = joints[l];
    if (m.softest <= kWorthRaising * kSoftness) continue;
    soft.add(model.joint_law_keys[l],
             {m.softest, fmt::format("The joints of {} make it {:.1f} % softer{}{}. For 5 % raise joint.penalty (or "
                                     "joint.penalty_factor, whichever the case has) by a factor of {:.2g}{}; the time "
                                     "step falls with its root.",
                                     advised_name(model, l), 100 * m.softest, m.softness.where(),
                                     m.edges.graded() ? " where it is meshed finest" : "", m.softest / kSoftness,
                                     m.edges.graded() ? ", or give joint.size the edges of that part" : "")});
  }
  return soft.sentences();
}

Sentences coarse_for_process_zone(const Model& model, const AllJointMeasures& joints) {
  Heaviest zones;
  for (std::size_t l = 0; l < model.joint_law_names.size(); ++l) {
    if (!model.joint_laws[l].breakable()) continue;
    const JointMeasures& m = joints[l];
    zones.add(model.joint_law_keys[l],
              {m.edges.mean / m.zone, zone_advice(advised_name(model, l), m.zone, m.edges, path_is_given(model, l))});
  }
  return zones.sentences();
}

Sentences sudden_softening(const Model& model, const AllJointMeasures& joints, double dt) {
  // Measured on a glass bar that breaks in tension, with 3.8, 7.6, 10, 15 and 30 steps: residual 6.0, 2.0, 1.25, 0.5
  // and 0.13 %; damping of damaged joints 54, 45, 43, 32 and 18 % of the work; fracture 20 % with 3.8, 27 % with 15.
  constexpr double kEnough = 10;
  Heaviest sudden;
  for (std::size_t l = 0; l < model.joint_law_names.size(); ++l) {
    const JointLawParams& law = model.joint_laws[l];
    const JointMeasures& m = joints[l];
    const Index group = m.sides.softer;
    if (!law.breakable() || group < 0) continue;
    const double impedance = std::sqrt(young(model.elastic[at(group)]) * model.density[at(group)]);
    const double steps = law.width_normal * impedance / (2 * law.tensile_strength * dt);
    if (steps >= kEnough) continue;
    // coarse_for_process_zone reports that no mesh resolves these.
    if (kEnough / steps > kWorthRefining && beyond_refining(m.edges.mean, m.zone)) continue;
    sudden.add(model.joint_law_keys[l],
               {1 / steps, fmt::format("The joints of {} soften within {:.2g} steps, too few to follow: of a glass bar "
                                       "6 % of the energy was lost "
                                       "with 3.8 steps, 1.3 % with 10, and damping took more than fracture "
                                       "(time.residual_limit ends a run that loses "
                                       "too much). With a time.safety {:.2g} times smaller it is 10 steps.",
                                       advised_name(model, l), steps, kEnough / steps)});
  }
  return sudden.sentences();
}

}  // namespace breccia
