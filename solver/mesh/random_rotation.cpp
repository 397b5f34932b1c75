#include "mesh/random_rotation.hpp"

#include <cmath>

namespace breccia {
namespace {

std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;

}  // namespace

std::uint64_t random_bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t k) {
  const std::uint64_t start = mixed(mixed(seed + kGolden) ^ mixed(stream * kGolden + kGolden));
  return mixed(start + (k + 1) * kGolden);
}

Mat3 random_rotation(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t drawn = 0;
  const auto signed_unit = [&] {  // -1..1 in steps of 2^-52, exact
    return static_cast<double>(random_bits(seed, stream, drawn++) >> 11) * 0x1p-52 - 1.0;
  };
  struct DiscPoint {
    double x, y, square;
  };
  const auto in_disc = [&] {
    DiscPoint p{};
    do {
      p.x = signed_unit();
      p.y = signed_unit();
      p.square = p.x * p.x + p.y * p.y;
    } while (p.square >= 1.0 || p.square == 0.0);
    return p;
  };
  const DiscPoint p = in_disc(), q = in_disc();
  const double stretch = std::sqrt((1.0 - p.square) / q.square);
  const double w = p.x, x = p.y, y = q.x * stretch, z = q.y * stretch;

  Mat3 rotation;
  rotation << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),          //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return rotation;
}

}  // namespace breccia
