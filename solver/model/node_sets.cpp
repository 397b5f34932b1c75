#include "model/node_sets.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "base/index.hpp"
#include "case/joint_entries.hpp"
#include "case/problem_at.hpp"

namespace breccia {
namespace {

bool shares(const std::vector<Discretisation>& kinds, Index group) {
  return group >= 0 && kinds[at(group)] == Discretisation::shared_nodes;
}

/// Pairs of groups of shared nodes between which the case has joints, and the entry.
std::vector<std::pair<GroupPair, const case_::Joint*>> parted_pairs(const case_::Case& input,
                                                                    const std::vector<std::string>& names,
                                                                    const std::vector<Discretisation>& kinds) {
  std::vector<std::pair<GroupPair, const case_::Joint*>> pairs;
  if (std::all_of(input.joints.begin(), input.joints.end(), [](const case_::Joint& joint) { return joint.inside(); }))
    return pairs;
  const auto end = static_cast<Index>(names.size());
  for (Index a = 0; a < end; ++a) {
    for (Index b = a + 1; b < end && shares(kinds, a); ++b) {
      const case_::Joint* joint =
          shares(kinds, b) ? case_::joint_entry(input, names[at(a)], names[at(b)]).ruling : nullptr;
      if (joint != nullptr) pairs.emplace_back(GroupPair{a, b}, joint);
    }
  }
  return pairs;
}

/// Every pair of different groups of shared nodes that have a face in common.
std::set<GroupPair> meeting_pairs(const Mesh& mesh, const Topology& topology,
                                  const std::vector<Discretisation>& kinds) {
  std::set<GroupPair> pairs;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const Index group = mesh.element_group[at(e)];
    if (!shares(kinds, group)) continue;
    for (const FaceLink& link : topology.links[at(e)]) {
      const Index other = link.inner() ? mesh.element_group[at(link.neighbour)] : group;
      if (group < other && shares(kinds, other)) pairs.emplace(group, other);
    }
  }
  return pairs;
}

Problem cannot_part(const case_::Case& input, const case_::Joint& joint, const std::string& what,
                    const std::string& allowed) {
  return case_::problem_at(input, joint.origin, "between", what, allowed,
                           "\"" + joint.groups[0] + "\" and \"" + joint.groups[1] + "\"");
}

}  // namespace

std::vector<Index> node_sets(const case_::Case& input, const Mesh& mesh, const Topology& topology,
                             const std::vector<Discretisation>& kinds) {
  const auto parted = parted_pairs(input, mesh.volume_groups, kinds);
  if (parted.empty()) return {};
  std::vector<Index> sets(kinds.size());
  std::iota(sets.begin(), sets.end(), 0);
  const std::set<GroupPair> meeting = meeting_pairs(mesh, topology, kinds);
  for (const GroupPair& pair : meeting) {
    const auto is_pair = [&](const auto& entry) { return entry.first == pair; };
    if (std::any_of(parted.begin(), parted.end(), is_pair)) continue;
    const auto [kept, gone] = std::minmax(sets[at(pair.first)], sets[at(pair.second)]);
    std::replace(sets.begin(), sets.end(), Index{gone}, Index{kept});
  }
  std::vector<Problem> problems;
  for (const auto& [pair, joint] : parted) {
    if (!meeting.contains(pair) || sets[at(pair.first)] != sets[at(pair.second)]) continue;
    problems.push_back(cannot_part(input, *joint,
                                   "the elements of both groups share their nodes with another group that lies beside "
                                   "both, so that no joints can part the two",
                                   "a [[joint]] between one of them and that group as well, or joints = "
                                   "\"unbreakable\" in the [[material]] of one"));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return sets;
}

std::vector<Problem> joints_without_effect(const case_::Case& input, const std::vector<std::string>& names,
                                           const std::vector<Discretisation>& kinds, const std::vector<Index>& sets) {
  std::vector<Problem> problems;
  for (const auto& [pair, joint] : parted_pairs(input, names, kinds)) {
    const bool by_name = joint->groups[0] != case_::every_group && joint->groups[1] != case_::every_group;
    if (!by_name || !share_nodes(kinds, sets, pair.first, pair.second)) continue;
    problems.push_back(cannot_part(input, *joint,
                                   "the elements of both groups share their nodes in the state that this case starts "
                                   "from: no joints can part them any more",
                                   "no [[joint]] between them, or a run from the beginning"));
  }
  return problems;
}

Index node_set(const std::vector<Discretisation>& kinds, const std::vector<Index>& sets, Index group) {
  if (!shares(kinds, group)) return -1;
  return sets.empty() ? 0 : sets[at(group)];
}

bool share_nodes(const std::vector<Discretisation>& kinds, const std::vector<Index>& sets, Index group, Index other) {
  const Index set = node_set(kinds, sets, group);
  return set >= 0 && set == node_set(kinds, sets, other);
}

}  // namespace breccia
