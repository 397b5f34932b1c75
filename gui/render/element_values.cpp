#include "render/element_values.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/vectors.hpp"

namespace breccia::gui {
namespace {

constexpr int kBars = 10;
constexpr double kMilli = 1e3;  // m in mm
/// Share by which equal values may differ, written in single precision; how far the bars then reach to both sides.
constexpr double kEqual = 1e-5, kBelow = 0.055, kAbove = 0.045;
constexpr int kFirstQuantity = static_cast<int>(Measure::first_quantity);
using Corners = std::array<Vector, 4>;

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

/// Every row of an array by a function of it; none where it is not there.
template <class Function>
std::vector<double> of_array(vtkUnstructuredGrid* grid, const char* name, Function&& function) {
  std::vector<double> values;
  vtkDataArray* array = grid == nullptr ? nullptr : grid->GetCellData()->GetArray(name);
  for (vtkIdType c = 0; array != nullptr && c < array->GetNumberOfTuples(); ++c) values.push_back(function(*array, c));
  return values;
}

std::vector<double> of_quantity(vtkUnstructuredGrid* elements, Quantity quantity) {
  const QuantitySource& source = source_of(quantity);
  return of_array(elements, source.array, [&](vtkDataArray& array, vtkIdType row) {
    return source.scale * number_of(array, row, source.component);
  });
}

template <class Function>
std::vector<double> of_shape(vtkUnstructuredGrid* elements, Function&& function) {
  std::vector<double> values;
  for (vtkIdType c = 0; elements != nullptr && c < elements->GetNumberOfCells(); ++c)
    values.push_back(function(corners_of(*elements, c)));
  return values;
}

std::vector<double> numbers_of(const FrameData& frame, Measure measure) {
  constexpr double kMicro = 1e6;
  vtkUnstructuredGrid* elements = frame.elements;
  vtkUnstructuredGrid* joints = frame.joints;
  const auto scaled = [](double scale) {
    return [scale](vtkDataArray& array, vtkIdType row) { return scale * array.GetComponent(row, 0); };
  };
  switch (measure) {
    case Measure::radius_ratio:
      return of_shape(elements, [](const Corners& x) { return radius_ratio(x, face_normals(x)); });
    case Measure::min_dihedral:
      return of_shape(elements, [](const Corners& x) { return min_dihedral(face_normals(x)); });
    case Measure::mean_edge:
      return of_shape(elements, mean_edge);
    case Measure::opening:
      return of_array(joints, "opening", scaled(kMicro));
    case Measure::slip:
      return of_array(joints, "slip", scaled(kMicro));
    case Measure::damage:
      return of_array(joints, "damage", scaled(1));
    default:
      return of_quantity(elements, static_cast<Quantity>(static_cast<int>(measure) - kFirstQuantity));
  }
}

Histogram histogram_of(const std::vector<double>& values, Measure measure) {
  Histogram bars;
  if (values.empty()) return bars;
  double high = 1;
  if (measure != Measure::radius_ratio && measure != Measure::damage) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    bars.low = *least;
    high = *most;
    if (const double size = std::max(std::abs(bars.low), std::abs(high)); high - bars.low <= kEqual * size) {
      bars.low -= kBelow * size;  // they differ by rounding alone: the middle of a bar
      high += kAbove * size;
    }
  }
  bars.counts.assign(kBars, 0);
  bars.width = (high - bars.low) / kBars;
  for (const double value : values) ++bars.counts[static_cast<std::size_t>(bars.bar_of(value))];
  return bars;
}

vtkSmartPointer<vtkPolyData> triangles_of(vtkUnstructuredGrid& joints, const std::vector<bool>& chosen) {
  auto faces = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkCellArray> triangles;
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    if (!chosen[c]) continue;
    const auto first = static_cast<vtkIdType>(3 * c);
    const std::array<vtkIdType, 3> corners{first, first + 1, first + 2};
    triangles->InsertNextCell(3, corners.data());
  }
  faces->SetPoints(joints.GetPoints());
  faces->SetPolys(triangles);
  return faces;
}

}  // namespace

const std::vector<std::pair<Measure, std::string>>& measures() {
  static const auto list = [] {
    std::vector<std::pair<Measure, std::string>> all{{Measure::radius_ratio, "radius ratio, 1 is regular"},
                                                     {Measure::min_dihedral, "smallest dihedral angle [deg]"},
                                                     {Measure::mean_edge, "mean edge [mm]"}};
    for (int i = 0; i < kNumQuantities; ++i) {
      const auto quantity = static_cast<Quantity>(i);
      all.emplace_back(measure_of(quantity), title_of(quantity));
    }
    all.insert(all.end(), {{Measure::opening, "opening of damaged joints [um]"},
                           {Measure::slip, "slip of damaged joints [um]"},
                           {Measure::damage, "damage of damaged joints"}});
    return all;
  }();
  return list;
}

Measure measure_of(Quantity quantity) { return static_cast<Measure>(kFirstQuantity + static_cast<int>(quantity)); }

bool is_of_joints(Measure measure) { return measure >= Measure::opening; }

ElementValues values_of(const FrameData& frame, Measure measure) {
  ElementValues told{measure, numbers_of(frame, measure), {}, std::this_thread::get_id()};
  told.bars = histogram_of(told.values, measure);
  return told;
}

int Histogram::bar_of(double value) const {
  if (!(width > 0)) return 0;
  return std::clamp(static_cast<int>((value - low) / width), 0, static_cast<int>(counts.size()) - 1);
}

vtkSmartPointer<vtkPolyData> faces_of_bar(const FrameData& frame, const ElementValues& of, int bar) {
  std::vector<bool> chosen(of.values.size());
  for (std::size_t e = 0; e < chosen.size(); ++e) chosen[e] = of.bars.bar_of(of.values[e]) == bar;
  return is_of_joints(of.measure) ? triangles_of(*frame.joints, chosen) : frame.faces->draw_part(*frame.drawn, chosen);
}

}  // namespace breccia::gui
