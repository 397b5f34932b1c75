#include "render/load_glyphs.hpp"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

namespace breccia::gui {
namespace {

/// A floor of triangles, one beside the other in the plane z = 0, seen from above; the last is of another group.
vtkSmartPointer<vtkPolyData> floor_of(int triangles) {
  auto skin = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIntArray> material, id, side;
  material->SetName("material");
  id->SetName("id");
  side->SetName("side");
  for (int i = 0; i < triangles; ++i) {
    const vtkIdType first = points->InsertNextPoint(i, 0, 0);
    points->InsertNextPoint(i + 1, 0, 0);
    points->InsertNextPoint(i, 1, 0);
    const std::array<vtkIdType, 3> corners{first, first + 1, first + 2};
    cells->InsertNextCell(3, corners.data());
    material->InsertNextValue(i + 1 == triangles ? 1 : 0);
    id->InsertNextValue(i);
    side->InsertNextValue(2);
  }
  skin->SetPoints(points);
  skin->SetPolys(cells);
  for (vtkIntArray* array : {material.Get(), id.Get(), side.Get()}) skin->GetCellData()->AddArray(array);
  return skin;
}

const std::vector<std::string> kVolumes{"wall", "tool"};
const SurfaceGroups kSurfaces{{"edge"}, {{4 * 1 + 2, 4 * 2 + 2}}};

LoadGlyphs drawn(const Load& load, int triangles = 5) {
  return draw_load(*floor_of(triangles), nullptr, kVolumes, kSurfaces, load);
}

std::array<double, 6> box_of(const LoadGlyphs& glyphs) {
  std::array<double, 6> box{};
  glyphs.mesh->GetBounds(box.data());
  return box;
}

TEST(LoadGlyphs, StandOnTheFacesOfTheirGroupAndNowhereElse) {
  EXPECT_EQ(drawn({LoadShape::pressure, "wall", {1, 0, 0}, {}, {}}).count(), 4);
  EXPECT_EQ(drawn({LoadShape::pressure, "tool", {1, 0, 0}, {}, {}}).count(), 1);
  const LoadGlyphs edge = drawn({LoadShape::pressure, "edge", {1, 0, 0}, {}, {}});
  EXPECT_EQ(edge.count(), 2);
  EXPECT_GT(box_of(edge)[0], 1);
  EXPECT_LT(box_of(edge)[1], 3);
  EXPECT_EQ(drawn({LoadShape::pressure, "nothing", {1, 0, 0}, {}, {}}).count(), 0);
}

TEST(LoadGlyphs, AreFewHoweverManyFacesThereAre) {
  const LoadGlyphs glyphs = drawn({LoadShape::pressure, "wall", {1, 0, 0}, {}, {}}, 3000);
  EXPECT_GT(glyphs.count(), 10);
  EXPECT_LT(glyphs.count(), 50);
  EXPECT_GT(box_of(glyphs)[1] - box_of(glyphs)[0], 2900) << "they are spread over the group";
}

TEST(LoadGlyphs, ArrowsAreOutsideWhicheverWayTheyPoint) {
  for (const double z : {-2.0, 3.0}) {
    const LoadGlyphs glyphs = drawn({LoadShape::arrow, "edge", {0, 0, z}, {}, {}});
    EXPECT_EQ(glyphs.count(), 2);
    EXPECT_NEAR(box_of(glyphs)[4], 0, 1e-6);
    EXPECT_GT(box_of(glyphs)[5], 0.1);
  }
}

/// The heads, which are wide, are at the face or away from it.
TEST(LoadGlyphs, APressurePointsOntoItsFaceAndASuctionAwayFromIt) {
  const auto height_of_widest = [](const LoadGlyphs& glyphs) {
    double widest = 0, height = 0;
    for (vtkIdType i = 0; i < glyphs.mesh->GetNumberOfPoints(); ++i) {
      std::array<double, 3> x{};
      glyphs.mesh->GetPoint(i, x.data());
      if (x[1] <= widest) continue;
      widest = x[1];
      height = x[2];
    }
    return height / box_of(glyphs)[5];
  };
  EXPECT_LT(height_of_widest(drawn({LoadShape::pressure, "edge", {1, 0, 0}, {}, {}})), 0.5);
  EXPECT_GT(height_of_widest(drawn({LoadShape::pressure, "edge", {-1, 0, 0}, {}, {}})), 0.5);
}

TEST(LoadGlyphs, ASupportHasAConeForEachAxisThatItHolds) {
  const auto one = drawn({LoadShape::support, "tool", {}, {false, false, true}, {}});
  const auto three = drawn({LoadShape::support, "tool", {}, {true, true, true}, {}});
  EXPECT_EQ(three.mesh->GetNumberOfCells(), 3 * one.mesh->GetNumberOfCells());
  EXPECT_EQ(drawn({LoadShape::support, "tool", {}, {}, {}}).count(), 0);
}

TEST(LoadGlyphs, OfTheWholeModelIsOneArrowBesideItThatPointsAtIt) {
  const LoadGlyphs glyphs = drawn({LoadShape::arrow, "", {0, 0, -9.81}, {}, {}});
  EXPECT_EQ(glyphs.count(), 1);
  EXPECT_GT(box_of(glyphs)[4], 0);
  EXPECT_GT(glyphs.places.at(0)[2], box_of(glyphs)[4]);
}

TEST(LoadGlyphs, OfRandomVelocitiesPointInManyDirections) {
  const LoadGlyphs glyphs = drawn({LoadShape::random, "wall", {}, {}, {}}, 3000);
  EXPECT_GT(glyphs.count(), 10);
  EXPECT_FALSE(glyphs.inner);
  int left = 0;
  for (std::size_t i = 0; i < glyphs.places.size(); ++i) left += glyphs.places[i][1] < 0 ? 1 : 0;
  EXPECT_GT(left, 0);
  EXPECT_LT(left, glyphs.count());
}

/// The slit of a plate lies between elements of one body, so that the skin does not have its faces.
TEST(LoadGlyphs, OfAFaceWithinTheModelStandOnItsElements) {
  const auto element = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  for (const std::array<double, 3>& x :
       std::array<std::array<double, 3>, 4>{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}}})
    points->InsertNextPoint(x.data());
  element->SetPoints(points);
  const std::array<vtkIdType, 4> corners{0, 1, 2, 3};
  element->InsertNextCell(10, 4, corners.data());
  vtkNew<vtkIntArray> id;
  id->SetName("id");
  id->InsertNextValue(70);
  element->GetCellData()->AddArray(id);
  const SurfaceGroups slit{{"slit"}, {{4 * 70 + 3}}};  // the face in z = 0
  const LoadGlyphs glyphs =
      draw_load(*floor_of(5), element, kVolumes, slit, {LoadShape::pressure, "slit", {1, 0, 0}, {}, {}});
  ASSERT_EQ(glyphs.count(), 1);
  EXPECT_TRUE(glyphs.inner);
  EXPECT_NEAR(glyphs.places[0][0], 1, 1e-6);
  EXPECT_LT(glyphs.places[0][2], 0) << "it begins outside of the element, on which it presses";
}

}  // namespace
}  // namespace breccia::gui
