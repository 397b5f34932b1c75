#include "physics/constraints.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace breccia {

Constraints::Constraints(const std::vector<NodalConstraint>& entries, const LocalMesh& mesh, const NodalState& state) {
  std::map<Index, std::array<std::size_t, 3>> ruler;  // 1 + entry that rules an axis of a node
  for (std::size_t e = 0; e < entries.size(); ++e) {
    entries_.push_back({entries[e].kind, entries[e].value, {}});
    for (const Index node : entries[e].nodes) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (entries[e].axes[axis]) ruler[node][axis] = e + 1;
      }
    }
  }
  for (const auto& [node, rules] : ruler) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (rules[axis] == 0) continue;
      const std::size_t at = nodal(node, static_cast<int>(axis));
      entries_[rules[axis] - 1].holds.push_back({node, static_cast<int>(axis), state.position[at], state.velocity[at],
                                                 0.0, mesh.counted[static_cast<std::size_t>(node)] != 0});
    }
  }
}

void Constraints::apply(const LocalMesh& mesh, NodalState& state, double time, double dt_before, double dt) {
  for (Entry& entry : entries_) {
    const bool displacement = entry.kind == PrescribedMotion::displacement;
    const double when = displacement ? time + dt : time + 0.5 * dt;
    const std::array<double, 3> target{entry.value[0](when), entry.value[1](when), entry.value[2](when)};
    for (Hold& hold : entry.holds) {
      const std::size_t at = nodal(hold.node, hold.axis);
      const auto axis = static_cast<std::size_t>(hold.axis);
      const double x = state.position[at];
      const double v = displacement ? (target[axis] - (x - hold.start)) / dt : target[axis];
      hold.reaction = mesh.node_mass[static_cast<std::size_t>(hold.node)] * (v - state.velocity[at]) / dt;
      if (hold.counted) work_.add_before(hold.reaction * hold.velocity, dt_before);
      hold.velocity = v;
      state.velocity[at] = v;
      state.next_position[at] = x + dt * v;
    }
  }
}

void Constraints::book_after(double dt) {
  for (const Entry& entry : entries_) {
    for (const Hold& hold : entry.holds) {
      if (hold.counted) work_.add_after(hold.reaction * hold.velocity, dt);
    }
  }
}

std::array<ExactSum, 3> Constraints::reaction(std::size_t entry) const {
  std::array<ExactSum, 3> sum;
  for (const Hold& hold : entries_[entry].holds) {
    if (hold.counted) sum[static_cast<std::size_t>(hold.axis)].add(hold.reaction);
  }
  return sum;
}

std::vector<Constraints::Anchor> Constraints::anchors() const {
  std::vector<Anchor> anchors;
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    for (const Hold& h : entries_[e].holds) anchors.push_back({e, h.node, h.axis, h.start, h.velocity});
  }
  return anchors;
}

void Constraints::restore(std::span<const Anchor> anchors) {
  const auto place = [](const auto& h) { return std::pair(h.node, h.axis); };
  for (const Anchor& anchor : anchors) {
    std::vector<Hold>& holds = entries_[anchor.entry].holds;
    const auto found = std::lower_bound(holds.begin(), holds.end(), place(anchor),
                                        [&](const Hold& h, const auto& wanted) { return place(h) < wanted; });
    if (found == holds.end() || place(*found) != place(anchor)) continue;
    found->start = anchor.start;
    found->velocity = anchor.velocity;
  }
}

}  // namespace breccia
