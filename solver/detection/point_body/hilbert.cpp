#include "detection/point_body/hilbert.hpp"

#include <cstddef>

namespace breccia::detection {

namespace {

using Bits = std::uint32_t;

/// Where the curve enters a cube, a corner as three bits, and the axis along which it leaves it.
struct Orientation {
  Bits entry;
  Bits axis;
  constexpr bool operator==(const Orientation&) const = default;
};

/// What follows is [Hamilton 2006, section 2] for three axes.
constexpr Bits gray(Bits i) { return i ^ i >> 1; }
constexpr Bits gray_inverse(Bits g) { return (g ^ g >> 1 ^ g >> 2) & 7; }
constexpr Bits turned_left(Bits x, Bits by) { return (x << by % 3 | x >> (3 - by % 3)) & 7; }
constexpr Bits turned_right(Bits x, Bits by) { return (x >> by % 3 | x << (3 - by % 3)) & 7; }
constexpr Bits trailing_ones(Bits i) { return (i & 1) == 0 ? 0 : 1 + trailing_ones(i >> 1); }
constexpr Bits entry_of(Bits i) { return i == 0 ? 0 : gray(2 * ((i - 1) / 2)); }
constexpr Bits axis_of(Bits i) { return i == 0 ? 0 : trailing_ones(i % 2 == 0 ? i - 1 : i) % 3; }

struct Octant {
  Bits place;
  Orientation next;
};

/// The octant (bits of x, y, z) of a cube: its place on the curve and how the curve runs in it.
constexpr Octant octant_of(const Orientation& at, Bits octant) {
  const Bits place = gray_inverse(turned_right(octant ^ at.entry, at.axis + 1));
  return {place, {at.entry ^ turned_left(entry_of(place), at.axis + 1), (at.axis + axis_of(place) + 1) % 3}};
}

/// Number of an orientation in the order of first use from the first one; those found so far stand in `known`.
constexpr Bits number_of(const Orientation& wanted, std::array<Orientation, 24>& known, Bits& count) {
  for (Bits k = 0; k < count; ++k) {
    if (known[k] == wanted) return k;
  }
  known[count] = wanted;
  return count++;
}

}  // namespace

constexpr HilbertCurve::Steps HilbertCurve::make_steps() {
  Steps made{};
  std::array<Orientation, 24> known{};
  Bits count = 1;
  for (Bits from = 0; from < num_orientations; ++from) {
    for (Bits cell = 0; cell < 64; ++cell) {
      const Octant outer = octant_of(known[from], cell >> 3);
      const Octant inner = octant_of(outer.next, cell & 7);
      const Bits orientation = number_of(inner.next, known, count);
      made[from << 6 | cell] = static_cast<std::uint16_t>(orientation << 6 | outer.place << 3 | inner.place);
    }
  }
  return made;
}

constexpr HilbertCurve::Steps HilbertCurve::steps = make_steps();

}  // namespace breccia::detection
