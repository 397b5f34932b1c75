#include "model/surfaces_to_break.hpp"

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/index.hpp"
#include "case/problem_at.hpp"

namespace breccia {
namespace {

/// What is wrong with breaking a surface; empty: nothing.
std::string fault_of(const SurfaceJoints& joints) {
  if (joints.unbreakable > 0) return "has joints that cannot break";
  return joints.breakable == 0 ? "has no joints to break" : "";
}

/// Elements of a bare model, originals of a piece: each is on one rank.
bool is_counted(const Model& model, Index element) {
  const std::vector<Index>& slots = model.local.slot_of_element;
  return slots.empty() || model.local.is_original(slots[at(element)]);
}

}  // namespace

std::vector<std::string> surfaces_to_break(const case_::Case& input) {
  std::set<std::string> surfaces;
  for (const case_::Stage& stage : input.stages)
    surfaces.insert(stage.broken_surfaces.begin(), stage.broken_surfaces.end());
  return {surfaces.begin(), surfaces.end()};
}

std::vector<SurfaceJoints> joints_on(const Model& model, std::span<const std::string> surfaces) {
  std::vector<SurfaceJoints> counts;
  for (const std::string& surface : surfaces) {
    SurfaceJoints& count = counts.emplace_back();
    for (std::size_t g = 0; g < model.mesh.surface_groups.size(); ++g) {
      if (model.mesh.surface_groups[g] != surface) continue;
      for (const Topology::Face& face : model.topology.surface_groups[g]) {
        if (!is_counted(model, face.element)) continue;
        const FaceLink& link = model.topology.links[at(face.element)][at(face.face)];
        // A piece has the neighbours of its originals, but for what has come apart from them.
        if (link.neighbour == FaceLink::kBeyond) ++count.breakable;
        if (!link.inner()) continue;
        const Index pair = model.whole.pair_of(model.mesh.element_group[at(face.element)],
                                               model.mesh.element_group[at(link.neighbour)]);
        if (pair >= 0) ++(model.joint_laws[at(pair)].breakable() ? count.breakable : count.unbreakable);
      }
    }
  }
  return counts;
}

void refuse_what_cannot_break(const case_::Case& input, std::span<const SurfaceJoints> joints) {
  const std::vector<std::string> surfaces = surfaces_to_break(input);
  DEMAND(surfaces.size() == joints.size(), "joints of other surfaces");
  std::vector<Problem> problems;
  for (const case_::Stage& stage : input.stages) {
    for (const std::string& surface : stage.broken_surfaces) {
      const auto place = std::lower_bound(surfaces.begin(), surfaces.end(), surface) - surfaces.begin();
      const std::string fault = fault_of(joints[static_cast<std::size_t>(place)]);
      if (fault.empty()) continue;
      problems.push_back(case_::problem_at(
          input, stage.origin, "broken", "the surface \"" + surface + "\" " + fault,
          "surfaces within groups with joints = \"breakable\", or between two groups with a breakable "
          "joint of their own",
          surface));
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace breccia
