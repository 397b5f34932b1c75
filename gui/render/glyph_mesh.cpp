#include "render/glyph_mesh.hpp"

#include <array>
#include <cmath>

namespace breccia::gui {
namespace {

constexpr int kSides = 10;
/// Shares of the length of an arrow.
constexpr double kShaft = 0.035, kHead = 0.1, kHeadLength = 0.35;

/// Any direction across another one.
Vector across(const Vector& along) {
  return unit(cross(along, std::abs(along[0]) < 0.8 ? Vector{1, 0, 0} : Vector{0, 1, 0}));
}

}  // namespace

void GlyphMesh::add(const Vector& begin, const Vector& end, double from, double to) {
  const Vector along = unit(end - begin), side = across(along), third = cross(along, side);
  std::array<std::array<vtkIdType, kSides>, 2> ring{};
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * M_PI * k / kSides;
    const Vector out = std::cos(angle) * side + std::sin(angle) * third;
    ring[0][static_cast<std::size_t>(k)] = points_->InsertNextPoint((begin + from * out).data());
    ring[1][static_cast<std::size_t>(k)] = points_->InsertNextPoint((end + to * out).data());
  }
  const std::array<vtkIdType, 2> middle{points_->InsertNextPoint(begin.data()), points_->InsertNextPoint(end.data())};
  for (std::size_t k = 0; k < kSides; ++k) {
    const std::size_t n = (k + 1) % kSides;
    triangle(ring[0][k], ring[0][n], ring[1][n]);
    triangle(ring[0][k], ring[1][n], ring[1][k]);
    triangle(middle[0], ring[0][n], ring[0][k]);
    triangle(middle[1], ring[1][k], ring[1][n]);
  }
}

void GlyphMesh::add_arrow(const Vector& begin, const Vector& end, int heads) {
  const Vector way = end - begin;
  const double size = length(way);
  add(begin, end - kHeadLength * way, kShaft * size, kShaft * size);
  for (int head = 0; head < heads; ++head) {
    const Vector tip = end - (0.8 * kHeadLength * head) * way;
    add(tip - kHeadLength * way, tip, kHead * size, 0);
  }
}

void GlyphMesh::add_disc(const Vector& centre, const Vector& along, double radius, double thickness) {
  add(centre - (0.5 * thickness) * along, centre + (0.5 * thickness) * along, radius, radius);
}

Vector GlyphMesh::add_turn(const Vector& centre, const Vector& axis, double radius, double width) {
  constexpr int kPieces = 30;
  constexpr double kAngle = 1.5 * M_PI, kHeadWidth = 3, kHeadSize = 8;  // the last two in widths
  const Vector side = across(axis), third = cross(axis, side);
  const auto at = [&](double angle) {
    return centre + (radius * std::cos(angle)) * side + (radius * std::sin(angle)) * third;
  };
  for (int i = 0; i < kPieces; ++i) add(at(kAngle * i / kPieces), at(kAngle * (i + 1) / kPieces), width, width);
  const Vector forward = cross(axis, unit(at(kAngle) - centre));
  add(at(kAngle), at(kAngle) + (kHeadSize * width) * forward, kHeadWidth * width, 0);
  return at(0);
}

vtkSmartPointer<vtkPolyData> GlyphMesh::take() {
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points_);
  mesh->SetPolys(triangles_);
  return mesh;
}

void GlyphMesh::triangle(vtkIdType a, vtkIdType b, vtkIdType c) {
  const std::array<vtkIdType, 3> corners{a, b, c};
  triangles_->InsertNextCell(3, corners.data());
}

}  // namespace breccia::gui
