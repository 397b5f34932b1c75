#include "render/load_glyphs.hpp"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>

#include "render/body_centres.hpp"
#include "render/vectors.hpp"

namespace breccia::gui::load_glyphs_test {
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
const SurfaceGroups kSurfaces{{"edge"}, {{4 * 1 + 2, 4 * 2 + 2}}, {}, {}};

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

/// The element of three corners on the axes and one in the origin, in a group of its own, as one body.
vtkSmartPointer<vtkUnstructuredGrid> corner_of(double edge, int element, int body) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  for (const std::array<double, 3>& x :
       std::array<std::array<double, 3>, 4>{{{0, 0, 0}, {edge, 0, 0}, {0, edge, 0}, {0, 0, edge}}})
    points->InsertNextPoint(x.data());
  grid->SetPoints(points);
  const std::array<vtkIdType, 4> corners{0, 1, 2, 3};
  grid->InsertNextCell(10, 4, corners.data());
  const std::array<std::pair<const char*, int>, 3> values{{{"id", element}, {"body", body}, {"material", 0}}};
  for (const auto& [name, value] : values) {
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    grid->GetCellData()->AddArray(array);
  }
  return grid;
}

/// What is drawn on the element of edge 4, whose centre is (1, 1, 1).
LoadGlyphs drawn_on_corner(const Load& load) {
  const auto element = corner_of(4, 0, 7);
  return draw_load(*Skin(*element).draw(*element), element, {"corner"}, {}, load);
}

/// All arrows of a stretching used to point the same way, as if the body flew.
TEST(LoadGlyphs, OfAStretchingPointAwayFromTheCentreOfTheBodyAndOfACompressionTowardsIt) {
  const Vector centre{1, 1, 1};
  for (const double rate : {2.0, -2.0}) {
    const LoadGlyphs glyphs = drawn_on_corner({LoadShape::stretch, "corner", {rate, rate, rate}, {}, {}});
    ASSERT_EQ(glyphs.count(), 4) << "one on each face";
    // The head of an arrow ends in its tip: the one point of a radius of nought, next to the middle of its foot.
    for (const Vector& end : glyphs.places) {
      double furthest = 0;
      for (vtkIdType i = 0; i < glyphs.mesh->GetNumberOfPoints(); ++i) {
        Vector x{};
        glyphs.mesh->GetPoint(i, x.data());
        furthest = std::max(furthest, length(x - centre));
      }
      EXPECT_LE(length(end - centre), furthest + 1e-6);
      EXPECT_GT(length(end - centre), 0.5) << "the end that is away from the model";
    }
    // Of the face across (1, 1, 1) the wide foot is at the face where it is stretched, else the head is.
    const Vector out = unit({1, 1, 1});
    double widest = 0, height = 0;
    for (vtkIdType i = 0; i < glyphs.mesh->GetNumberOfPoints(); ++i) {
      Vector x{};
      glyphs.mesh->GetPoint(i, x.data());
      const double along = dot(x, out);
      if (along < dot({4.0 / 3, 4.0 / 3, 4.0 / 3}, out) - 0.1) continue;  // glyphs of other faces
      const double radius = length(x - along * out);
      if (radius <= widest) continue;
      widest = radius;
      height = along - dot({4.0 / 3, 4.0 / 3, 4.0 / 3}, out);
    }
    EXPECT_EQ(height<0.05, rate> 0) << height;
  }
}

TEST(LoadGlyphs, OfAStretchingAlongOneAxisLieAlongItAndAreLongestAtItsEnds) {
  const LoadGlyphs glyphs = drawn_on_corner({LoadShape::stretch, "corner", {3, 0, 0}, {}, {}});
  ASSERT_EQ(glyphs.count(), 4);
  const Vector kFaces[] = {
      {4.0 / 3, 4.0 / 3, 4.0 / 3}, {0, 4.0 / 3, 4.0 / 3}, {4.0 / 3, 0, 4.0 / 3}, {4.0 / 3, 4.0 / 3, 0}};
  for (const Vector& end : glyphs.places) {
    double nearest = 10, shift = 0;
    for (const Vector& face : kFaces) {
      const Vector way = end - face;
      if (std::hypot(way[1], way[2]) >= nearest) continue;
      nearest = std::hypot(way[1], way[2]);
      shift = way[0];
    }
    EXPECT_NEAR(nearest, 0, 1e-6) << "along x alone";
    EXPECT_NE(shift, 0);
  }
}

TEST(LoadGlyphs, OfASpinAreOneArcAroundEachBodyWhoseAxisGoesThroughItsCentre) {
  const LoadGlyphs glyphs = drawn_on_corner({LoadShape::spin, "corner", {0, 0, -5}, {}, {}});
  ASSERT_EQ(glyphs.count(), 1);
  double reach = 0;
  Vector middle{};
  for (vtkIdType i = 0; i < glyphs.mesh->GetNumberOfPoints(); ++i) {
    Vector x{};
    glyphs.mesh->GetPoint(i, x.data());
    reach = std::max(reach, std::hypot(x[0] - 1, x[1] - 1));
    if (x[2] < middle[2]) middle = x;
  }
  EXPECT_GT(reach, std::hypot(1.0 / 3, 1.0 / 3)) << "around the faces";
  EXPECT_NEAR(std::hypot(middle[0] - 1, middle[1] - 1), 0, 0.05) << "the axis sticks out below the centre";
  for (const double rate : {5.0, -5.0}) {  // the last two points are the middle of the foot of its head, and its tip
    const Vector turn{0, 0, rate};
    const auto mesh = drawn_on_corner({LoadShape::spin, "corner", turn, {}, {}}).mesh;
    Vector foot{}, tip{};
    mesh->GetPoint(mesh->GetNumberOfPoints() - 2, foot.data());
    mesh->GetPoint(mesh->GetNumberOfPoints() - 1, tip.data());
    const Vector velocity = cross(turn, foot - Vector{1, 1, 1});
    EXPECT_NEAR(dot(unit(velocity), unit(tip - foot)), 1, 1e-6) << "by the right hand";
  }
}

/// Two elements of one body, at x = 1/4 and 10 + 1/4, each of a group of its own.
TEST(BodyCentres, AreThoseOfAllGroupsThatABodyConsistsOfByTheirDensities) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  vtkNew<vtkIntArray> body, material;
  body->SetName("body");
  material->SetName("material");
  for (int e = 0; e < 2; ++e) {
    const double x = 10.0 * e;
    const vtkIdType first = points->InsertNextPoint(x, 0, 0);
    points->InsertNextPoint(x + 1, 0, 0);
    points->InsertNextPoint(x, 1, 0);
    points->InsertNextPoint(x, 0, 1);
    body->InsertNextValue(3);
    material->InsertNextValue(e);
    const std::array<vtkIdType, 4> corners{first, first + 1, first + 2, first + 3};
    if (e == 0) grid->Allocate(2);
    grid->InsertNextCell(10, 4, corners.data());
  }
  grid->SetPoints(points);
  grid->GetCellData()->AddArray(body);
  grid->GetCellData()->AddArray(material);
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(centres_of(grid, {1000, 3000}).at(3)[0], 0.25 + 7.5, kRounding);
  EXPECT_NEAR(centres_of(grid, {}).at(3)[0], 0.25 + 5, kRounding) << "alike where no density is known";
}

TEST(LoadGlyphs, OfMotionsAboutCentresAreNoneWhereTheModelIsNotKnown) {
  for (const LoadShape shape : {LoadShape::stretch, LoadShape::spin})
    EXPECT_EQ(drawn({shape, "wall", {1, 0, 0}, {}, {}}).count(), 0);
}

TEST(LoadGlyphs, OfAnAbsorbingFaceAreThreeDiscsThatShrinkAwayFromIt) {
  const LoadGlyphs waves = drawn({LoadShape::absorbing, "tool", {}, {}, {}});
  const LoadGlyphs one = drawn({LoadShape::support, "tool", {}, {false, false, true}, {}});
  ASSERT_EQ(waves.count(), 1);
  EXPECT_EQ(waves.mesh->GetNumberOfCells(), 3 * one.mesh->GetNumberOfCells());
  EXPECT_GT(box_of(waves)[4], 0) << "above the face";
}

/// Heads of arrows along one line lay over each other, as a chain of beads.
TEST(LoadGlyphs, AreApartByAGoodPartOfTheirLength) {
  EXPECT_EQ(drawn({LoadShape::pressure, "edge", {1, 0, 0}, {}, {}}, 5).count(), 2) << "long apart";
  EXPECT_EQ(drawn({LoadShape::pressure, "edge", {1, 0, 0}, {}, {}}, 300).count(), 1) << "a hundredth of an arrow";
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
  const SurfaceGroups slit{{"slit"}, {{4 * 70 + 3}}, {}, {}};  // the face in z = 0
  const LoadGlyphs glyphs =
      draw_load(*floor_of(5), element, kVolumes, slit, {LoadShape::pressure, "slit", {1, 0, 0}, {}, {}});
  ASSERT_EQ(glyphs.count(), 1);
  EXPECT_TRUE(glyphs.inner);
  EXPECT_NEAR(glyphs.places[0][0], 1, 1e-6);
  EXPECT_LT(glyphs.places[0][2], 0) << "it begins outside of the element, on which it presses";
}

}  // namespace
}  // namespace breccia::gui::load_glyphs_test
