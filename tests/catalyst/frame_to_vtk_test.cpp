// What becomes of the solver's arrays, looked at from inside.

#include "catalyst/frame_to_vtk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include "catalyst/synthetic.hpp"

namespace breccia::insitu::frame_to_vtk_test {
namespace {

constexpr int kNoRank = -1;

vtkFieldData* arrays_of(vtkDataObject* object) {
  if (auto* table = vtkTable::SafeDownCast(object)) return table->GetRowData();
  return vtkDataSet::SafeDownCast(object)->GetCellData();
}

TEST(FrameToVtk, WrapsPointsAndArraysWithoutCopyingThem) {
  test::SyntheticRun run(2, 0, 1, kNoRank);
  const BrecciaInstant& instant = run.at(5, kAllChannels);
  FrameToVtk to_vtk;
  const Frame frame = to_vtk.wrap(instant);
  for (std::size_t channel = 0; channel < kChannelNames.size(); ++channel) {
    SCOPED_TRACE(kChannelNames[channel]);
    const BrecciaGrid& grid = *instant.channels[channel];
    ASSERT_NE(frame.channels[channel], nullptr);
    if (auto* set = vtkPointSet::SafeDownCast(frame.channels[channel])) {
      EXPECT_EQ(set->GetPoints()->GetData()->GetVoidPointer(0), grid.points);
      EXPECT_EQ(set->GetNumberOfCells(), grid.num_cells);
    }
    ASSERT_EQ(arrays_of(frame.channels[channel])->GetNumberOfArrays(), grid.num_arrays);
    for (int i = 0; i < grid.num_arrays; ++i) {
      vtkDataArray* array = arrays_of(frame.channels[channel])->GetArray(i);
      EXPECT_STREQ(array->GetName(), grid.arrays[i].name);
      EXPECT_EQ(array->GetVoidPointer(0), grid.arrays[i].values);
      EXPECT_EQ(array->GetNumberOfComponents(), grid.arrays[i].components);
    }
  }
  EXPECT_NE(vtkUnstructuredGrid::SafeDownCast(frame.channels[BRECCIA_ELEMENTS]), nullptr);
  EXPECT_NE(vtkUnstructuredGrid::SafeDownCast(frame.channels[BRECCIA_DOMAINS]), nullptr);
  EXPECT_NE(vtkPolyData::SafeDownCast(frame.channels[BRECCIA_SURFACE]), nullptr);
  EXPECT_NE(vtkTable::SafeDownCast(frame.channels[BRECCIA_HISTORY]), nullptr);
}

TEST(FrameToVtk, KeepsConnectivityUntilTheTopologyChanges) {
  test::SyntheticRun run(4, 0, 1, kNoRank);
  FrameToVtk to_vtk;
  const Frame first = to_vtk.wrap(run.at(1, kAllChannels));
  // Held, so that what comes anew cannot lie at the same address.
  const vtkSmartPointer<vtkCellArray> elements = to_vtk.channel(BRECCIA_ELEMENTS).cells();
  const vtkSmartPointer<vtkCellArray> joints = to_vtk.channel(BRECCIA_JOINTS).cells();
  EXPECT_EQ(vtkUnstructuredGrid::SafeDownCast(first.channels[BRECCIA_ELEMENTS])->GetCells(), elements);
  const Frame second = to_vtk.wrap(run.at(2, kAllChannels));
  EXPECT_EQ(to_vtk.channel(BRECCIA_ELEMENTS).cells(), elements);
  EXPECT_NE(to_vtk.channel(BRECCIA_JOINTS).cells(), joints) << "joints have become more";
}

TEST(FrameToVtk, TakesConnectivityAnewWhenTheTopologyChangesThoughAllCountsStay) {
  const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::int32_t first[] = {0, 1, 2}, second[] = {1, 3, 2};
  BrecciaGrid grid{};
  grid.cell = BRECCIA_TRIANGLE;
  grid.num_points = 4;
  grid.points = points;
  grid.num_cells = 1;
  grid.corners = first;
  ChannelToVtk to_vtk;
  static_cast<void>(to_vtk.wrap(grid, 0, 0.0));
  grid.corners = second;
  ++grid.topology;
  static_cast<void>(to_vtk.wrap(grid, 1, 0.0));
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  to_vtk.cells()->GetCellAtId(0, count, ids);
  EXPECT_THAT(std::vector<vtkIdType>(ids, ids + count), testing::ElementsAre(1, 3, 2));
}

TEST(FrameToVtk, TakesCornersWhereCellsShareThem) {
  const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::int32_t corners[] = {0, 1, 2, 1, 3, 2};
  BrecciaGrid grid{};
  grid.cell = BRECCIA_TRIANGLE;
  grid.num_points = 4;
  grid.points = points;
  grid.num_cells = 2;
  grid.corners = corners;
  ChannelToVtk to_vtk;
  const auto object = to_vtk.wrap(grid, 3, 0.25);
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  to_vtk.cells()->GetCellAtId(1, count, ids);
  EXPECT_THAT(std::vector<vtkIdType>(ids, ids + count), testing::ElementsAre(1, 3, 2));
  EXPECT_EQ(object->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.25);
  EXPECT_EQ(object->GetFieldData()->GetArray("step")->GetComponent(0, 0), 3.0);
}

TEST(FrameToVtk, RefusesPointsThatDoNotMakeUpTheCells) {
  BrecciaGrid grid{};
  grid.cell = BRECCIA_TETRAHEDRON;
  grid.num_points = 5;
  grid.num_cells = 1;
  ChannelToVtk to_vtk;
  EXPECT_THROW(static_cast<void>(to_vtk.wrap(grid, 0, 0.0)), PipelineError);
  grid.cell = 77;
  EXPECT_THROW(static_cast<void>(to_vtk.wrap(grid, 0, 0.0)), PipelineError);
}

TEST(FrameToVtk, EmptyObjectsKeepNamesTypesAndComponentsOfTheirArrays) {
  test::SyntheticRun run(2, 0, 1, kNoRank);
  FrameToVtk to_vtk;
  const Frame frame = to_vtk.wrap(run.at(5, kAllChannels));
  for (const auto& object : frame.channels) {
    const auto empty = empty_like(object);
    EXPECT_STREQ(empty->GetClassName(), object->GetClassName());
    ASSERT_EQ(arrays_of(empty)->GetNumberOfArrays(), arrays_of(object)->GetNumberOfArrays());
    for (int i = 0; i < arrays_of(object)->GetNumberOfArrays(); ++i) {
      EXPECT_STREQ(arrays_of(empty)->GetArray(i)->GetName(), arrays_of(object)->GetArray(i)->GetName());
      EXPECT_EQ(arrays_of(empty)->GetArray(i)->GetDataType(), arrays_of(object)->GetArray(i)->GetDataType());
      EXPECT_EQ(arrays_of(empty)->GetArray(i)->GetNumberOfComponents(),
                arrays_of(object)->GetArray(i)->GetNumberOfComponents());
      EXPECT_EQ(arrays_of(empty)->GetArray(i)->GetNumberOfTuples(), 0);
    }
  }
}

}  // namespace
}  // namespace breccia::insitu::frame_to_vtk_test
