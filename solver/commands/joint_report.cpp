#include "commands/joint_report.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <numeric>
#include <vector>

#include "base/index.hpp"

namespace breccia {
namespace {

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

/// The joints of a pair of groups: penalty, softness, process zone.
std::string law_report(const Model& model, std::size_t l, const JointMeasures& m) {
  const JointLawParams& law = model.joint_laws[l];
  std::string text =
      fmt::format("joints of {}: k = p/h = {:.4g} Pa/m with h = {:.4g} m; they make the body {:.2g} % softer{}{}\n",
                  model.joint_law_names[l], law.stiffness, model.joint_sizes[l], 100 * m.softness.mean,
                  m.softness.is_even() ? "" : fmt::format(", {:.2g} %{}", 100 * m.softness.most, m.softness.where()),
                  m.edges.graded() ? fmt::format(", {:.2g} % where a tenth of them is finest", 100 * m.softest) : "");
  if (!law.breakable()) return text + glue_line(model, l);
  text += fmt::format("  fracture process zone at least {:.4g} m; mean joint edge {:.4g} m{}, a tenth below {:.4g} m\n",
                      m.zone, m.edges.mean, model.plane ? " in the plane" : "", m.edges.fine);
  return text + scatter_report(model, l);
}

}  // namespace

std::string joint_report(const Model& model, const AllJointMeasures& joints) {
  std::string text;
  for (std::size_t l = 0; l < model.joint_law_names.size(); ++l) text += law_report(model, l, joints[l]);
  return text;
}

}  // namespace breccia
