#include "render/mesh_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace breccia::gui {
namespace {

constexpr int kBars = 10;
/// Values that differ by less than this share are one: coordinates may be written in single precision; bars reach that far to both sides of it.
constexpr double kEqual = 1e-5, kAround = 0.05;
using Vector = std::array<double, 3>;
using Corners = std::array<Vector, 4>;

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Twice the area of each face, outwards where the element is positive.
Corners face_normals(const Corners& x) {
  Corners normals;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto corner = [&](std::size_t i) { return x[static_cast<std::size_t>(kTetraFaces[f][i])]; };
    normals[f] = cross(corner(1) - corner(0), corner(2) - corner(0));
  }
  return normals;
}

/// r_in = 3 V / sum of areas; r_circumscribed = |a2 (b x c) + b2 (c x a) + c2 (a x b)| / (12 V).
double radius_ratio(const Corners& x, const Corners& normals) {
  const Vector a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  const double six_volumes = std::abs(dot(a, cross(b, c)));
  double areas = 0;
  for (const Vector& n : normals) areas += 0.5 * length(n);
  const double inner = 0.5 * six_volumes / areas;
  const double outer =
      length(dot(a, a) * cross(b, c) + dot(b, b) * cross(c, a) + dot(c, c) * cross(a, b)) / (2 * six_volumes);
  return six_volumes > 0 ? 3 * inner / outer : 0;
}

double min_dihedral(const Corners& normals) {
  double least = 180;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double cosine = -dot(normals[i], normals[j]) / (length(normals[i]) * length(normals[j]));
      least = std::min(least, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / M_PI);
    }
  return least;
}

double mean_edge(const Corners& x) {
  constexpr double kMilli = 1e3;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) sum += length(x[i] - x[j]);
  return kMilli * sum / 6;
}

Corners corners_of(vtkUnstructuredGrid& grid, vtkIdType c) {
  Corners x;
  for (int i = 0; i < 4; ++i) grid.GetPoint(4 * c + i, x[static_cast<std::size_t>(i)].data());
  return x;
}

double shape(const Corners& x, ShapeMeasure measure) {
  switch (measure) {
    case ShapeMeasure::radius_ratio:
      return radius_ratio(x, face_normals(x));
    case ShapeMeasure::min_dihedral:
      return min_dihedral(face_normals(x));
    case ShapeMeasure::mean_edge:
      return mean_edge(x);
  }
  return 0;
}

Histogram histogram_of(const std::vector<double>& values, ShapeMeasure measure) {
  Histogram bars;
  if (values.empty()) return bars;
  double high = 1;
  if (measure != ShapeMeasure::radius_ratio) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    bars.low = *least;
    high = *most;
    if (const double size = std::max(std::abs(bars.low), std::abs(high)); high - bars.low <= kEqual * size) {
      bars.low -= kAround * size;  // they differ by rounding alone
      high += kAround * size;
    }
  }
  bars.counts.assign(kBars, 0);
  bars.width = (high - bars.low) / kBars;
  for (const double value : values) ++bars.counts[static_cast<std::size_t>(bars.bar_of(value))];
  return bars;
}

}  // namespace

ElementValues measure_shapes(vtkUnstructuredGrid* elements, ShapeMeasure measure) {
  ElementValues told;
  told.counted_by = std::this_thread::get_id();
  if (elements == nullptr) return told;
  told.values.reserve(static_cast<std::size_t>(elements->GetNumberOfCells()));
  for (vtkIdType c = 0; c < elements->GetNumberOfCells(); ++c)
    told.values.push_back(shape(corners_of(*elements, c), measure));
  told.bars = histogram_of(told.values, measure);
  return told;
}

int Histogram::bar_of(double value) const {
  if (!(width > 0)) return 0;
  return std::clamp(static_cast<int>((value - low) / width), 0, static_cast<int>(counts.size()) - 1);
}

vtkSmartPointer<vtkPolyData> elements_of_bar(const FrameData& frame, const ElementValues& of, int bar) {
  std::vector<bool> chosen(of.values.size());
  for (std::size_t e = 0; e < chosen.size(); ++e) chosen[e] = of.bars.bar_of(of.values[e]) == bar;
  return frame.faces->draw_part(*frame.elements, chosen);
}

}  // namespace breccia::gui
