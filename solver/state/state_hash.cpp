#include "state/state_hash.hpp"

namespace breccia {

std::string StateHash::text() const {
  std::string digits(16, '0');
  std::uint64_t rest = sum_;
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, rest >>= 4)
    *digit = "0123456789abcdef"[rest & 15];
  return digits;
}

StateHash hash_elements(const LocalMesh& mesh, const State& state) {
  StateHash sum;
  for (const Index slot : mesh.slot_of_element) {
    if (!mesh.is_original(slot)) continue;
    SequenceHash hash;
    hash.add(static_cast<std::uint64_t>(mesh.element_of_slot[static_cast<std::size_t>(slot)]));
    for (int c = 0; c < 4; ++c) {
      const Index node = mesh.corner_node(slot, c);
      for (int axis = 0; axis < 3; ++axis) hash.add(state.position[nodal(node, axis)]);
      for (int axis = 0; axis < 3; ++axis) hash.add(state.velocity[nodal(node, axis)]);
    }
    sum.add(hash);
  }
  return sum;
}

}  // namespace breccia
