#include "physics/nodal_load.hpp"

#include <utility>

namespace breccia {

NodalLoad::NodalLoad(std::vector<NodeShare> nodes, std::array<TimeFunction, 3> force)
    : nodes_(std::move(nodes)), force_(std::move(force)) {}

template <class Account>
void NodalLoad::for_each_power(const LocalMesh& mesh, const Field<double>& velocity, Account&& account) const {
  for (const NodeShare& one : nodes_) {
    if (mesh.counted[static_cast<std::size_t>(one.node)] != 0)
      account(one.share * now_.dot(load_node(velocity.data(), one.node)));
  }
}

void NodalLoad::apply(const LocalMesh& mesh, const NodalState& state, double time, double dt_before,
                      NodalForces& forces) {
  now_ = Vec3(force_[0](time), force_[1](time), force_[2](time));
  for (const NodeShare& one : nodes_) forces.add(one.node, one.share * now_);
  for_each_power(mesh, state.velocity, [&](double power) { work_.add_before(power, dt_before); });
}

void NodalLoad::account_after(const LocalMesh& mesh, const NodalState& state, double dt_after) {
  for_each_power(mesh, state.velocity, [&](double power) { work_.add_after(power, dt_after); });
}

}  // namespace breccia
