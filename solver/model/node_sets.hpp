#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"
#include "discretisation/local_mesh.hpp"
#include "mesh/topology.hpp"

namespace breccia {

/// Two volume groups, the lower index first.
using GroupPair = std::pair<Index, Index>;

/// Which volume groups of elements that share nodes have those in common at which they meet: groups of one number do.
/// Two with a [[joint]] between them do not, their interface has joints. Empty where the case has none such: all do.
/// @param kinds  (volume groups)
/// Throws InputError where both of a pair with joints between them share nodes with a third, or with a row of others
/// from one to the other. O(elements)
[[nodiscard]] std::vector<Index> node_sets(const case_::Case& input, const Mesh& mesh, const Topology& topology,
                                           const std::vector<Discretisation>& kinds);

/// Every [[joint]] of a case between groups that share nodes all the same, in the state from which it starts.
/// @param names  of the groups;  @param sets  of the state
[[nodiscard]] std::vector<Problem> joints_without_effect(const case_::Case& input,
                                                         const std::vector<std::string>& names,
                                                         const std::vector<Discretisation>& kinds,
                                                         const std::vector<Index>& sets);

/// Number of a group's set, -1: its elements have nodes of their own. @param sets  as above
[[nodiscard]] Index node_set(const std::vector<Discretisation>& kinds, const std::vector<Index>& sets, Index group);

/// Whether elements of two groups that meet share the nodes there, so that no joint lies between them.
[[nodiscard]] bool share_nodes(const std::vector<Discretisation>& kinds, const std::vector<Index>& sets, Index group,
                               Index other);

}  // namespace breccia
