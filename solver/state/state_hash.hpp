#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>

#include "state/local_mesh.hpp"
#include "state/state.hpp"

namespace breccia {

/// 64-bit hash of a sequence of numbers, for "are these two runs the same bits?". Depends on every bit and on the
/// order. Not cryptographic.
class StateHash {
 public:
  void add(std::uint64_t word) {
    hash_ = (std::rotl(hash_, 27) ^ mixed(word)) * 0x9e3779b97f4a7c15ULL + 0x632be59bd9b4e019ULL;
  }
  /// By bit pattern: 0.0 and -0.0 differ.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::span<const double> values) {
    for (const double value : values) add(value);
  }

  [[nodiscard]] std::uint64_t value() const { return mixed(hash_); }
  /// 16 lower-case hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  /// Two rounds of xor-shift and multiplication: a bijection in which every bit reaches every other.
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93ULL;
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93ULL;
    return x ^ (x >> 32);
  }

  std::uint64_t hash_ = 0x243f6a8885a308d3ULL;
};

/// Positions and velocities of the four corners of every element by global id, corner and axis, then the histories. The
/// same for every layout of the same state.
/// @param damage, contact  histories in global order (joint, point; point, couple). O(elements), 10 ns an
///   element-corner.
[[nodiscard]] StateHash hash_state(const LocalMesh& mesh, const State& state, std::span<const double> damage,
                                   std::span<const double> contact);

}  // namespace breccia
