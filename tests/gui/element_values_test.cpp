#include "render/element_values.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <cmath>

namespace breccia::gui::element_values_test {
namespace {

constexpr double kRounding = 1e-12;

/// One element with a right angle at its first corner, and its velocity.
FrameData right_angled(double edge, const std::array<double, 3>& velocity) {
  FrameData frame;
  frame.elements = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(edge, 0, 0);
  points->InsertNextPoint(0, edge, 0);
  points->InsertNextPoint(0, 0, edge);
  const std::array<vtkIdType, 4> corners{0, 1, 2, 3};
  frame.elements->Allocate(1);
  frame.elements->InsertNextCell(10, 4, corners.data());
  frame.elements->SetPoints(points);
  vtkNew<vtkDoubleArray> speeds;
  speeds->SetName("velocity");
  speeds->SetNumberOfComponents(3);
  speeds->InsertNextTuple(velocity.data());
  frame.elements->GetCellData()->AddArray(speeds);
  return frame;
}

TEST(ElementValues, OfATetrahedronWithARightAngledCornerAreThoseByHand) {
  const FrameData frame = right_angled(2e-3, {3, 0, -4});
  // r_in = a / (3 + sqrt 3), r_circumscribed = a sqrt 3 / 2.
  EXPECT_NEAR(values_of(frame, Measure::radius_ratio).values.at(0), 6 / (std::sqrt(3.0) * (3 + std::sqrt(3.0))),
              kRounding);
  EXPECT_NEAR(values_of(frame, Measure::min_dihedral).values.at(0), std::acos(1 / std::sqrt(3.0)) * 180 / M_PI, 1e-9);
  EXPECT_NEAR(values_of(frame, Measure::mean_edge).values.at(0), 1 + std::sqrt(2.0), kRounding);
  EXPECT_NEAR(values_of(frame, measure_of(Quantity::speed)).values.at(0), 5, kRounding);
}

TEST(ElementValues, WhatAFrameDoesNotTellHasNoBars) {
  EXPECT_TRUE(values_of(right_angled(1, {}), measure_of(Quantity::von_mises)).bars.counts.empty());
  EXPECT_TRUE(values_of(right_angled(1, {}), Measure::opening).bars.counts.empty());
  EXPECT_TRUE(values_of({}, Measure::radius_ratio).bars.counts.empty());
}

TEST(ElementValues, ThatAreEqualButForRoundingAreInOneBar) {
  const ElementValues one = values_of(right_angled(1, {1, 0, 0}), Measure::mean_edge);
  int filled = 0;
  for (const double x : {one.values[0], one.values[0] * (1 + 1e-14), one.values[0] * (1 - 1e-14)})
    filled += one.bars.bar_of(x) == one.bars.bar_of(one.values[0]) ? 1 : 0;
  EXPECT_EQ(filled, 3);
}

}  // namespace
}  // namespace breccia::gui::element_values_test
