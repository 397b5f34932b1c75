#include "catalyst/probe_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace breccia::insitu {
namespace {

/// Share of a tetrahedron's height by which a point may lie outside; far above the round-off of its corners, which is
/// 1e-13 where a body of a metre is cut into millimetres.
constexpr double kOutside = 1e-9;

Point minus(const double* a, const double* b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double triple(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// By barycentric coordinates, of which the fourth is what is left of 1.
bool is_inside(const double* corners, const Point& point) {
  const Point a = minus(corners + 3, corners), b = minus(corners + 6, corners), c = minus(corners + 9, corners);
  const double volume = triple(a, b, c);
  if (volume == 0.0 || !std::isfinite(volume)) return false;
  const Point p = minus(point.data(), corners);
  const double u = triple(p, b, c) / volume, v = triple(a, p, c) / volume, w = triple(a, b, p) / volume;
  return u >= -kOutside && v >= -kOutside && w >= -kOutside && u + v + w <= 1 + kOutside;
}

/// Lower and upper corner of what some points fill.
struct Box {
  Point lower, upper;
};

template <class At>
Box box_of(std::size_t count, const At& at) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(box.lower[axis], at(i)[axis]);
      box.upper[axis] = std::max(box.upper[axis], at(i)[axis]);
    }
  }
  return box;
}

}  // namespace

std::vector<Point> points_of(const Probe& probe) {
  std::vector<Point> points;
  const auto share = [](int i, int count) { return count > 1 ? static_cast<double>(i) / (count - 1) : 0.0; };
  for (int row = 0; row < probe.rows; ++row) {
    for (int i = 0; i < probe.points; ++i) {
      Point& point = points.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] =
            probe.at[axis] + share(i, probe.points) * probe.along[axis] + share(row, probe.rows) * probe.across[axis];
    }
  }
  return points;
}

std::vector<Place> places_of(const std::vector<Point>& points, std::int64_t num_cells, const double* corners,
                             const std::int64_t* ids) {
  std::vector<Place> places(points.size());
  const Box all = box_of(points.size(), [&](std::size_t i) { return points[i].data(); });
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (all.upper[axis] - all.lower[axis] > all.upper[longest] - all.lower[longest]) longest = axis;
  }
  std::vector<std::size_t> order(points.size());  // along the longest axis
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return points[a][longest] < points[b][longest]; });
  for (std::int64_t cell = 0; cell < num_cells; ++cell) {
    const double* const own = corners + 12 * cell;
    Box box = box_of(4, [own](std::size_t i) { return own + 3 * i; });
    bool is_near = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double margin = kOutside * (box.upper[axis] - box.lower[axis]);
      box.lower[axis] -= margin;
      box.upper[axis] += margin;
      is_near = is_near && box.lower[axis] <= all.upper[axis] && box.upper[axis] >= all.lower[axis];
    }
    if (!is_near) continue;
    const auto first = std::lower_bound(order.begin(), order.end(), box.lower[longest],
                                        [&](std::size_t i, double value) { return points[i][longest] < value; });
    for (auto i = first; i != order.end() && points[*i][longest] <= box.upper[longest]; ++i) {
      if (ids[cell] < places[*i].id && is_inside(own, points[*i])) places[*i] = {ids[cell], cell};
    }
  }
  return places;
}

}  // namespace breccia::insitu
