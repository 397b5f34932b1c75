#include "synthetic_plate.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace breccia::test {
namespace {

constexpr double kWidth = 0.1, kThickness = 0.005, kBlockWidth = 0.012;
constexpr double kDensity = 2500;    // kg/m3
constexpr double kCrackEnd = 0.075;  // m, where the cracks are at the end
constexpr double kTwoPi = 2 * std::numbers::pi;

/// Twice the cell coordinates: corners are even, face and cube centres have odd entries.
using Lattice = std::array<int, 3>;

/// A number in -1..1 that depends on the arguments alone.
double noise(int a, int b) {
  const double x = std::sin(12.9898 * a + 78.233 * b) * 43758.5453;
  return 2 * (x - std::floor(x)) - 1;
}

struct Raster {
  std::array<int, 3> cells;
  Vec3 origin, cell;
  double jitter;  ///< of inner corners along x and z, share of a cell

  [[nodiscard]] Vec3 corner(const Lattice& at) const {
    Vec3 x = origin;
    for (int k = 0; k < 3; ++k) x[k] += cell[k] * at[static_cast<std::size_t>(k)] / 2;
    for (const int k : {0, 2}) {
      const int index = at[static_cast<std::size_t>(k)] / 2;
      const bool inner = index > 0 && index < cells[static_cast<std::size_t>(k)];
      if (inner) x[k] += jitter * cell[k] * noise(at[0] + k, at[2] - k);
    }
    return x;
  }

  /// Corner, or mean of the corners around a centre of a face or cube.
  [[nodiscard]] Vec3 node(const Lattice& at) const {
    Vec3 sum{0, 0, 0};
    for (int i = 0; i < 8; ++i) {
      Lattice near = at;
      for (std::size_t k = 0; k < 3; ++k) near[k] += (at[k] % 2) * ((i >> k) % 2 == 0 ? -1 : 1);
      sum += corner(near);
    }
    return sum / 8;
  }
};

struct Element {
  std::array<Lattice, 4> at;
  std::array<Vec3, 4> x;
  Vec3 centre;
  int body;
};

/// Six times the volume.
double edge_product(const std::array<Vec3, 4>& x) { return (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]); }

/// 24 tetrahedra a cube: cube centre, face centre and one edge of the face each.
void add_cubes(const Raster& raster, int body, std::vector<Element>& elements) {
  const auto add = [&](const std::array<Lattice, 4>& at) {
    Element e{at, {}, {0, 0, 0}, body};
    for (std::size_t i = 0; i < 4; ++i) e.x[i] = raster.node(at[i]);
    if (edge_product(e.x) < 0) {
      std::swap(e.x[2], e.x[3]);
      std::swap(e.at[2], e.at[3]);
    }
    e.centre = (e.x[0] + e.x[1] + e.x[2] + e.x[3]) / 4;
    elements.push_back(e);
  };
  for (int i = 0; i < raster.cells[0] * raster.cells[1] * raster.cells[2]; ++i) {
    const Lattice centre{2 * (i % raster.cells[0]) + 1, 2 * (i / raster.cells[0] % raster.cells[1]) + 1,
                         2 * (i / raster.cells[0] / raster.cells[1]) + 1};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Lattice face = centre;
        face[axis] += side;
        constexpr std::array<std::array<int, 2>, 4> around{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
        for (std::size_t edge = 0; edge < 4; ++edge) {
          std::array<Lattice, 4> at{centre, face, face, face};
          for (std::size_t end = 0; end < 2; ++end) {
            at[2 + end][(axis + 1) % 3] += around[(edge + end) % 4][0];
            at[2 + end][(axis + 2) % 3] += around[(edge + end) % 4][1];
          }
          add(at);
        }
      }
    }
  }
}

/// Number of the piece in which x lies when the cracks have reached `front`; 0 is the part outside.
int piece_of(const Vec3& x, double front) {
  const double radius = std::hypot(x.x(), x.z());
  if (radius > front) return 0;
  const double wobble = 0.15 * std::sin(90 * radius) + 0.08 * std::sin(5 + 260 * radius);
  const double angle = std::atan2(x.z(), x.x()) / kTwoPi + 0.5 + wobble / 6;
  const double ring_radius = radius * (1 + 0.08 * std::sin(7 * kTwoPi * angle));
  const int ring = ring_radius < 0.006 ? 0 : ring_radius < 0.014 ? 1 : ring_radius < 0.028 ? 2 : 3;
  const int sectors = ring == 0 ? 5 : 11;
  const int sector = static_cast<int>(std::floor(angle * sectors)) % sectors;
  return 1 + 20 * ring + sector;
}

/// Rigid motion of a piece, m.
Vec3 shift_of(int piece, const Vec3& centre, double time_share) {
  if (piece == 0) return {0, 0, 0};
  const Vec3 outwards = Vec3(centre.x(), 0, centre.z()).normalized();
  const double fall = 0.004 * std::exp(-centre.norm() / 0.02) * time_share;
  return 0.0008 * time_share * outwards * (1 + 0.5 * noise(piece, 3)) - Vec3(0, fall * (1.2 + noise(piece, 1)), 0);
}

/// The element across the face opposite to each corner, -1: none.
std::vector<std::int64_t> neighbours_of(const std::vector<Element>& elements) {
  std::vector<std::int64_t> neighbour(4 * elements.size(), -1);
  std::map<std::pair<int, std::array<Lattice, 3>>, std::size_t> sides;  // those seen once so far
  for (std::size_t side = 0; side < neighbour.size(); ++side) {
    const Element& element = elements[side / 4];
    std::array<Lattice, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = element.at[(side + 1 + i) % 4];
    std::sort(corners.begin(), corners.end());
    const auto [other, first] = sides.try_emplace({element.body, corners}, side);
    if (first) continue;
    neighbour[side] = static_cast<std::int64_t>(other->second / 4);
    neighbour[other->second] = static_cast<std::int64_t>(side / 4);
  }
  return neighbour;
}

void derive_stress_fields(Frame::Elements& elements) {
  for (std::size_t e = 0; e < elements.id.size(); ++e) {
    const double* s = &elements.stress[6 * e];
    Mat3 stress;
    stress << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    const Vec3 ascending = Eigen::SelfAdjointEigenSolver<Mat3>(stress, Eigen::EigenvaluesOnly).eigenvalues();
    for (int k = 2; k >= 0; --k) elements.principal.push_back(ascending[k]);
    const Mat3 deviator = stress - stress.trace() / 3 * Mat3::Identity();
    elements.von_mises.push_back(std::sqrt(1.5) * deviator.norm());
  }
}

}  // namespace

Frame SyntheticPlate::frame(std::int64_t number, double time) const {
  std::vector<Element> elements;
  const double cell = kWidth / cubes;
  add_cubes({{cubes, 1, cubes}, {-kWidth / 2, 0, -kWidth / 2}, {cell, kThickness, cell}, 0.25}, 0, elements);
  const double block_cell = kBlockWidth / 2;
  const double fall = 0.003 * (1 - time / end);
  add_cubes({{2, 2, 2}, {-kBlockWidth / 2, kThickness, -kBlockWidth / 2}, Vec3::Constant(block_cell), 0}, 1, elements);

  const double share = time / end, front = kCrackEnd * share;
  const auto n = static_cast<Index>(elements.size());
  std::vector<int> piece(elements.size());
  std::map<int, Vec3> centre_sum;
  std::map<int, int> members;
  std::map<int, std::int64_t> first;
  for (Index e = 0; e < n; ++e) {
    const auto i = static_cast<std::size_t>(e);
    piece[i] = elements[i].body == 1 ? -1 : piece_of(elements[i].centre, front);
    centre_sum.try_emplace(piece[i], 0, 0, 0).first->second += elements[i].centre;
    ++members[piece[i]];
    first.try_emplace(piece[i], e);
  }

  Frame frame;
  frame.number = number;
  frame.time = time;
  frame.step = static_cast<std::int64_t>(std::lround(time / 1e-8));
  frame.elements.neighbour = neighbours_of(elements);
  std::map<std::array<Lattice, 3>, std::pair<std::size_t, std::array<std::size_t, 3>>> open_faces;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Element& element = elements[e];
    const Vec3 mean = centre_sum[piece[e]] / members[piece[e]];
    const Vec3 shift = element.body == 1 ? Vec3(0, fall, 0) : shift_of(piece[e], mean, share);
    auto& out = frame.elements;
    for (const Vec3& x : element.x) {
      for (int k = 0; k < 3; ++k) out.points.push_back(x[k] + shift[k]);
    }
    out.id.push_back(static_cast<std::int64_t>(e));
    out.body.push_back(element.body);
    out.material.push_back(element.body);
    out.rank.push_back(0);
    out.mass.push_back(kDensity / 6 * edge_product(element.x));
    out.cost.push_back(1.0 + 0.5 * noise(static_cast<int>(e), 3));
    out.fragment.push_back(first[piece[e]]);
    const double radius = std::hypot(element.centre.x(), element.centre.z());
    const double wave = 2e7 * std::exp(-std::abs(radius - front) / 0.015) * (1 + 0.2 * noise(static_cast<int>(e), 7));
    const std::array<double, 6> stress{wave, -0.2 * wave, 0.6 * wave, 0.1 * wave, 0.05 * wave, -0.1 * wave};
    out.stress.insert(out.stress.end(), stress.begin(), stress.end());
    for (int k = 0; k < 3; ++k) {
      out.displacement.push_back(shift[k]);
      out.velocity.push_back(element.body == 1 ? (k == 1 ? -30.0 : 0.0) : shift[k] / end);
    }
  }
  derive_stress_fields(frame.elements);

  std::int64_t inner_face = 0;
  for (std::size_t e = 0; e < elements.size() && elements[e].body == 0; ++e) {
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      std::array<std::size_t, 3> corner{};
      for (std::size_t i = 0; i < 3; ++i) corner[i] = (opposite + 1 + i) % 4;
      const auto& at = elements[e].at;
      std::sort(corner.begin(), corner.end(), [&](std::size_t a, std::size_t b) { return at[a] < at[b]; });
      const std::array<Lattice, 3> key{at[corner[0]], at[corner[1]], at[corner[2]]};
      const auto [found, is_new] = open_faces.try_emplace(key, e, corner);
      if (is_new) continue;
      ++inner_face;
      const auto& [other, other_corner] = found->second;
      const Vec3& centre = elements[e].centre;
      const Vec3& beyond = elements[other].centre;
      const double radius = std::hypot(centre.x(), centre.z()), ahead = radius - front;
      const bool broken = piece[e] != piece[other];
      const bool weak = !broken && front > 0 && ahead > 0 && ahead < 0.01 && piece_of(centre, 1) != piece_of(beyond, 1);
      if (!broken && !weak) continue;
      Vec3 gap{0, 0, 0};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          const double a = frame.elements.points[12 * e + 3 * corner[i] + k];
          const double b = frame.elements.points[12 * other + 3 * other_corner[i] + k];
          frame.joints.points.push_back((a + b) / 2);
          gap[static_cast<Index>(k)] += (a - b) / 3;
        }
      }
      frame.joints.id.push_back(inner_face);
      frame.joints.energy.push_back(broken ? 1.0 : 0.5);
      frame.joints.damage.push_back(broken ? 1.0 : 0.9 - 60 * ahead);
      frame.joints.mode.push_back(broken ? 1 : 3);
      frame.joints.opening.push_back(gap.norm());
      frame.joints.slip.push_back(0);
      frame.joints.broken.push_back(broken ? 1 : 0);
      frame.joints.time_of_failure.push_back(
          broken ? end * std::min(radius, std::hypot(beyond.x(), beyond.z())) / kCrackEnd : -1.0);
      frame.joints.state.push_back(broken ? Frame::Joints::apart : Frame::Joints::softening);
    }
  }

  for (int i = 0; i < (share > 0.2 ? 9 : 0); ++i) {
    const Vec3 x{0.004 * (i % 3 - 1), kThickness, 0.004 * (i / 3 - 1)};
    for (int k = 0; k < 3; ++k) {
      frame.contacts.points.push_back(x[k]);
      frame.contacts.force.push_back(k == 1 ? -10.0 * share : 0.0);
      frame.contacts.normal_force.push_back(frame.contacts.force.back());
      frame.contacts.tangential_force.push_back(0.0);
      frame.contacts.slip_velocity.push_back(0.0);
    }
    frame.contacts.id.push_back(static_cast<std::int64_t>(frame.contacts.body.size()));
    frame.contacts.point.push_back(24 * frame.contacts.id.back());
    frame.contacts.body.push_back(0);
    frame.contacts.other_body.push_back(1);
    frame.contacts.other_element.push_back(n - 1);
  }
  return frame;
}

namespace {

/// The rows of a piece, of `rows` in all.
template <class T>
void cut(std::vector<T>& values, std::size_t rows, int number, int count) {
  if (values.empty()) return;
  const std::size_t width = values.size() / rows, n = static_cast<std::size_t>(number),
                    all = static_cast<std::size_t>(count);
  const auto at = [&](std::size_t piece) {
    return values.begin() + static_cast<std::ptrdiff_t>(rows * piece / all * width);
  };
  values = std::vector<T>(at(n), at(n + 1));
}

}  // namespace

Frame piece_of(const Frame& whole, int number, int count) {
  Frame piece = whole;
  const auto cut_all = [&](std::size_t rows, auto&... arrays) { (cut(arrays, rows, number, count), ...); };
  auto& e = piece.elements;
  cut_all(e.id.size(), e.points, e.body, e.material, e.rank, e.fragment, e.stress, e.von_mises, e.principal, e.velocity,
          e.displacement, e.cost, e.mass, e.neighbour, e.id);
  auto& j = piece.joints;
  cut_all(j.id.size(), j.points, j.damage, j.mode, j.opening, j.slip, j.broken, j.time_of_failure, j.state, j.energy,
          j.id);
  auto& c = piece.contacts;
  cut_all(c.body.size(), c.id, c.point, c.points, c.force, c.normal_force, c.tangential_force, c.slip_velocity,
          c.other_body, c.other_element, c.body);
  return piece;
}

}  // namespace breccia::test
