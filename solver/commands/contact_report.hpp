#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "commands/advice.hpp"
#include "model/model.hpp"

/// What `check` says of contact beside overlaps.
namespace breccia {

/// A line for each group with a law: H, m, of its finest body, the stiffness penalty/H, Pa/m, of its laws, and the
/// recommended penalty.
[[nodiscard]] std::string stiffness_report(const Model& model);

/// A line for each [[contact]] that keeps groups from interacting, with the pairs of groups that it rules.
[[nodiscard]] std::string separation_report(const case_::Case& input, const std::vector<std::string>& groups);

/// Groups with curved surfaces whose contact points, inside the faces, lie so far behind the corners that bodies come
/// noticeably nearer before they feel each other. Edges and corners proper, flat surfaces: nothing. O(elements).
[[nodiscard]] Advice late_contact_advice(const Model& model);

/// Pairs that both press with their points where those of one lie far apart beside the faces of the other, inside the
/// faces. O(elements + groups^2).
[[nodiscard]] Advice coarse_points_advice(const Model& model);

}  // namespace breccia
