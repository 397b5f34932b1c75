#include "render/frame_data.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <QProcess>
#include <algorithm>
#include <array>

#include "gui/block_case.hpp"

namespace breccia::gui::frame_data_test {
namespace {

using Corner = std::array<double, 3>;
struct Tetra {
  std::array<Corner, 4> corners;
  int id, body;
  Corner moved{};
};

/// Elements as the solver writes them: each with its own points.
vtkSmartPointer<vtkUnstructuredGrid> grid_of(const std::vector<Tetra>& tetras) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkLongLongArray> id;
  vtkNew<vtkIntArray> body;
  vtkNew<vtkDoubleArray> displacement;
  id->SetName("id");
  body->SetName("body");
  displacement->SetName("displacement");
  displacement->SetNumberOfComponents(3);
  grid->Allocate(static_cast<vtkIdType>(tetras.size()));
  for (const Tetra& t : tetras) {
    std::array<vtkIdType, 4> ids{};
    for (std::size_t i = 0; i < 4; ++i)
      ids[i] = points->InsertNextPoint(t.corners[i][0] + t.moved[0], t.corners[i][1] + t.moved[1],
                                       t.corners[i][2] + t.moved[2]);
    grid->InsertNextCell(10, 4, ids.data());
    id->InsertNextValue(t.id);
    body->InsertNextValue(t.body);
    displacement->InsertNextTuple(t.moved.data());
  }
  grid->SetPoints(points);
  grid->GetCellData()->AddArray(id);
  grid->GetCellData()->AddArray(body);
  grid->GetCellData()->AddArray(displacement);
  return grid;
}

const std::array<Corner, 4> kLeft{{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}}};
const std::array<Corner, 4> kRight{{{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}}};

TEST(Skin, TheFaceBetweenTwoElementsIsDrawnOnlyWhenTheyHaveComeApart) {
  const auto whole = grid_of({{kLeft, 0, 0}, {kRight, 1, 0}});
  const Skin skin(*whole);
  EXPECT_EQ(skin.num_outer(), 6U);
  EXPECT_EQ(skin.num_inner(), 1U);
  EXPECT_EQ(skin.draw(*whole)->GetNumberOfCells(), 6);
  const auto apart = grid_of({{kLeft, 0, 0}, {kRight, 1, 0, {0.5, 0, 0}}});
  EXPECT_EQ(skin.draw(*apart)->GetNumberOfCells(), 8);
}

TEST(Skin, BodiesThatOnlyTouchAreBothSeen) {
  const auto touching = grid_of({{kLeft, 0, 0}, {kRight, 1, 1}});
  EXPECT_EQ(Skin(*touching).draw(*touching)->GetNumberOfCells(), 8);
}

TEST(Skin, IsTheSameWhateverFrameItIsFoundFrom) {
  const auto apart = grid_of({{kLeft, 0, 0}, {kRight, 1, 0, {0.5, 0.25, 0}}});
  EXPECT_EQ(Skin(*apart).num_inner(), 1U);
}

TEST(Skin, ElementsAreKnownByTheirIdsInAnyOrder) {
  const Skin skin(*grid_of({{kLeft, 0, 0}, {kRight, 1, 0}}));
  const auto other = grid_of({{kRight, 1, 0}, {kLeft, 0, 0}});
  const auto drawn = skin.draw(*other);
  EXPECT_EQ(drawn->GetNumberOfCells(), 6);
  std::array<double, 6> box{};
  drawn->GetBounds(box.data());
  EXPECT_EQ(box[0], -1);
  EXPECT_EQ(box[1], 1);
}

TEST(Skin, OfAPartTheFacesAreSeenThatNoTwoOfItsElementsShare) {
  const auto whole = grid_of({{kLeft, 0, 0}, {kRight, 1, 0}});
  const Skin skin(*whole);
  EXPECT_EQ(skin.draw_part(*whole, {true, true})->GetNumberOfCells(), 6);
  EXPECT_EQ(skin.draw_part(*whole, {false, true})->GetNumberOfCells(), 4);
  EXPECT_EQ(skin.draw_part(*whole, {false, false})->GetNumberOfCells(), 0);
  const auto apart = grid_of({{kRight, 1, 0, {0.5, 0, 0}}, {kLeft, 0, 0}});
  EXPECT_EQ(skin.draw_part(*apart, {true, true})->GetNumberOfCells(), 8);
  std::array<double, 6> box{};
  const auto right = skin.draw_part(*apart, {true, false});
  right->GetBounds(box.data());
  EXPECT_EQ(box[0], 0.5) << "rows of the frame, not ids";
}

TEST(Skin, RanksAreThoseOfTheOwnersAndTheElementsOfOthersStayAsTheyAre) {
  const auto whole = grid_of({{kLeft, 0, 0}, {kRight, 1, 0}});
  FrameData frame;
  frame.skin = Skin(*whole).draw(*whole);
  frame.elements = whole;
  set_ranks(frame, {7, 9});
  for (vtkDataSet* cells : {static_cast<vtkDataSet*>(frame.skin), static_cast<vtkDataSet*>(frame.elements)}) {
    vtkDataArray* rank = cells->GetCellData()->GetArray("rank");
    vtkDataArray* id = cells->GetCellData()->GetArray("id");
    for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c)
      EXPECT_EQ(rank->GetTuple1(c), id->GetTuple1(c) == 0 ? 7 : 9);
  }
  EXPECT_FALSE(whole->GetCellData()->HasArray("rank"));
}

TEST(LoadFrame, AFileThatCannotBeReadGivesNothing) {
  EXPECT_EQ(load_frame("/no/such/file.vtkhdf", "", 0, nullptr).skin, nullptr);
}

TEST(LoadFrame, WhatNothingIsDrawnByIsNotRead) {
  const QTemporaryDir scratch;
  const QString out = scratch.filePath("mesh");
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM,
                              {"mesh", test::written_case(scratch, test::block_case(1, "1 ms")), "--json", "-o", out}),
            0);
  const FrameData frame = load_frame((out + "/elements_000000.vtkhdf").toStdString(), "", 0, nullptr);
  ASSERT_NE(frame.skin, nullptr);
  EXPECT_EQ(frame.skin->GetNumberOfCells(), 24);
  vtkCellData* arrays = frame.elements->GetCellData();
  for (const char* name : {"neighbour", "mass", "cost"}) EXPECT_FALSE(arrays->HasArray(name)) << name;
  for (const char* name :
       {"id", "body", "material", "rank", "fragment", "stress", "von_mises", "principal", "velocity", "displacement"})
    EXPECT_TRUE(arrays->HasArray(name)) << name;
}

}  // namespace
}  // namespace breccia::gui::frame_data_test
