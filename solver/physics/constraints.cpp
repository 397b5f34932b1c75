#include "physics/constraints.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace breccia {
namespace {

bool is_still(PrescribedMotion kind, const TimeFunction& value) {
  return kind == PrescribedMotion::velocity && value.is_zero();
}

}  // namespace

bool holds_still(const NodalConstraint& entry) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (entry.axes[axis] && !is_still(entry.kind, entry.value[axis])) return false;
  }
  return true;
}

Constraints::Constraints(const std::vector<NodalConstraint>& entries, const LocalMesh& mesh, const NodalState& state,
                         double mass_damping, double local_damping)
    : mesh_(&mesh), damping_{mass_damping, local_damping, 0.0} {
  std::map<Index, std::array<std::size_t, 3>> ruler;  // 1 + entry that rules an axis of a node
  for (std::size_t e = 0; e < entries.size(); ++e) {
    const NodalConstraint& given = entries[e];
    Entry& entry = entries_.emplace_back(Entry{given.kind, given.value, {}});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!given.axes[axis]) continue;
      entry.holds.push_back({static_cast<int>(axis), is_still(given.kind, given.value[axis]), false, {}, {}, {}, {}});
      for (const Index node : given.nodes) ruler[node][axis] = e + 1;
    }
  }
  for (const auto& [node, rules] : ruler) {
    nodes_.push_back(node);
    held_axes_.push_back({rules[0] != 0, rules[1] != 0, rules[2] != 0});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (rules[axis] == 0) continue;
      std::vector<Hold>& holds = entries_[rules[axis] - 1].holds;
      Hold& hold =
          *std::find_if(holds.begin(), holds.end(), [&](const Hold& h) { return h.axis == static_cast<int>(axis); });
      const std::size_t at = nodal(node, static_cast<int>(axis));
      hold.nodes.push_back(node);
      hold.start.push_back(state.position[at]);
      hold.velocity.push_back(state.velocity[at]);
      hold.free.push_back(state.velocity[at]);
    }
  }
}

bool Constraints::counts(Index node) const { return mesh_->counted[static_cast<std::size_t>(node)] != 0; }

double Constraints::reaction_of(const Hold& hold, std::size_t k) const {
  const double kick = damping_.kick;
  if (kick == 0) return 0.0;
  const double mass = mesh_->node_mass[static_cast<std::size_t>(hold.nodes[k])];
  return (1.0 + 0.5 * damping_.mass * kick) * (mass * (hold.velocity[k] - hold.free[k]) / kick);
}

double Constraints::change_by_local_damping(Index node, double before, double after) const {
  const double mass = mesh_->node_mass[static_cast<std::size_t>(node)];
  return damping_.kick * damping_.local_force(before, after, mass) /
         (mass * (1.0 + 0.5 * damping_.mass * damping_.kick));
}

void Constraints::apply(NodalState& state, double time, double dt_before, double dt) {
  damping_.kick = kick_length(dt_before, dt);
  for (Entry& entry : entries_) {
    for (Hold& hold : entry.holds) {
      if (hold.rests) {
        apply_still(hold, state);
      } else {
        apply_moving(entry, hold, state, time, dt_before, dt);
        hold.rests = hold.still;
      }
    }
  }
}

// Nodes that fill a block are consecutive, as all are if a whole body is constrained.
void Constraints::apply_still(Hold& hold, NodalState& state) const {
  const auto still = [&](std::size_t k, std::size_t at, std::size_t number) {
    for (std::size_t i = 0; i < number; ++i) {
      hold.free[k + i] = state.velocity[at + i];
      state.velocity[at + i] = 0.0;
      state.next_position[at + i] = state.position[at + i] + 0.0;  // the bits of x + dt v: never -0
    }
  };
  constexpr auto kBlock = static_cast<std::size_t>(kLanes);
  for (std::size_t k = 0; k < hold.nodes.size();) {
    const Index node = hold.nodes[k];
    const bool fills =
        node % kLanes == 0 && k + kBlock <= hold.nodes.size() && hold.nodes[k + kBlock - 1] == node + kLanes - 1;
    const std::size_t number = fills ? kBlock : 1;
    still(k, nodal(node, hold.axis), number);
    k += number;
  }
}

void Constraints::apply_moving(const Entry& entry, Hold& hold, NodalState& state, double time, double dt_before,
                               double dt) {
  const bool displacement = entry.kind == PrescribedMotion::displacement;
  const double target = entry.value[static_cast<std::size_t>(hold.axis)](displacement ? time + dt : time + 0.5 * dt);
  for (std::size_t k = 0; k < hold.nodes.size(); ++k) {
    const std::size_t at = nodal(hold.nodes[k], hold.axis);
    const double x = state.position[at];
    const double before = hold.velocity[k], v = displacement ? (target - (x - hold.start[k])) / dt : target;
    hold.free[k] = state.velocity[at];
    if (damping_.local > 0) hold.free[k] -= change_by_local_damping(hold.nodes[k], before, state.velocity[at]);
    hold.velocity[k] = v;
    if (counts(hold.nodes[k])) work_.add_before(reaction_of(hold, k) * before, dt_before);
    state.velocity[at] = v;
    state.next_position[at] = x + dt * v;
  }
}

void Constraints::account_after(double dt) {
  for (const Entry& entry : entries_) {
    for (const Hold& hold : entry.holds) {
      if (hold.still) continue;
      for (std::size_t k = 0; k < hold.nodes.size(); ++k) {
        if (counts(hold.nodes[k])) work_.add_after(reaction_of(hold, k) * hold.velocity[k], dt);
      }
    }
  }
}

std::array<ExactSum, 3> Constraints::reaction(std::size_t entry) const {
  std::array<ExactSum, 3> sum;
  for (const Hold& hold : entries_[entry].holds) {
    for (std::size_t k = 0; k < hold.nodes.size(); ++k) {
      if (counts(hold.nodes[k])) sum[static_cast<std::size_t>(hold.axis)].add(reaction_of(hold, k));
    }
  }
  return sum;
}

std::array<ExactSum, 3> Constraints::reaction_on(std::span<const Index> nodes) const {
  std::array<ExactSum, 3> sum;
  for (const Entry& entry : entries_) {
    for (const Hold& hold : entry.holds) {
      for (std::size_t k = 0; k < hold.nodes.size(); ++k) {
        if (!counts(hold.nodes[k]) || !std::binary_search(nodes.begin(), nodes.end(), hold.nodes[k])) continue;
        sum[static_cast<std::size_t>(hold.axis)].add(reaction_of(hold, k));
      }
    }
  }
  return sum;
}

std::vector<NodeForce> Constraints::reactions() const {
  std::vector<NodeForce> forces;
  for (const Index node : nodes_) {
    if (mesh_->is_moved(node)) forces.push_back({node, Vec3::Zero()});
  }
  for (const Entry& entry : entries_) {
    for (const Hold& hold : entry.holds) {
      auto force = forces.begin();
      for (std::size_t k = 0; k < hold.nodes.size(); ++k) {
        if (!mesh_->is_moved(hold.nodes[k])) continue;
        while (force->node != hold.nodes[k]) ++force;
        force->force[hold.axis] = reaction_of(hold, k);
      }
    }
  }
  std::erase_if(forces, [](const NodeForce& f) { return f.force == Vec3::Zero(); });
  return forces;
}

std::vector<Constraints::Anchor> Constraints::anchors() const {
  std::vector<Anchor> anchors;
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    for (const Hold& h : entries_[e].holds) {
      for (std::size_t k = 0; k < h.nodes.size(); ++k)
        anchors.push_back({e, h.nodes[k], h.axis, h.start[k], h.velocity[k]});
    }
  }
  std::sort(anchors.begin(), anchors.end(), [](const Anchor& p, const Anchor& q) {
    return std::tie(p.entry, p.node, p.axis) < std::tie(q.entry, q.node, q.axis);
  });
  return anchors;
}

void Constraints::restore(std::span<const Anchor> anchors) {
  for (const Anchor& anchor : anchors) {
    if (anchor.entry >= entries_.size()) continue;
    for (Hold& hold : entries_[anchor.entry].holds) {
      if (hold.axis != anchor.axis) continue;
      const auto found = std::lower_bound(hold.nodes.begin(), hold.nodes.end(), anchor.node);
      if (found == hold.nodes.end() || *found != anchor.node) continue;
      const auto k = static_cast<std::size_t>(found - hold.nodes.begin());
      hold.start[k] = anchor.start;
      hold.velocity[k] = anchor.velocity;
    }
  }
}

}  // namespace breccia
