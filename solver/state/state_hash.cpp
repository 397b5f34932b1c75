#include "state/state_hash.hpp"

namespace breccia {

std::string StateHash::text() const {
  std::string digits(16, '0');
  std::uint64_t rest = value();
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, rest >>= 4)
    *digit = "0123456789abcdef"[rest & 15];
  return digits;
}

StateHash hash_state(const LocalMesh& mesh, const State& state, std::span<const double> damage,
                     std::span<const double> contact) {
  StateHash hash;
  for (const Index slot : mesh.slot_of_element) {
    for (int c = 0; c < 4; ++c) {
      const Index node = mesh.corner_node(slot, c);
      for (int axis = 0; axis < 3; ++axis) hash.add(state.position[nodal(node, axis)]);
      for (int axis = 0; axis < 3; ++axis) hash.add(state.velocity[nodal(node, axis)]);
    }
  }
  hash.add(damage);
  hash.add(contact);
  return hash;
}

}  // namespace breccia
