// The cells and arrays that a pipeline gets of an instant.

#include "catalyst/selection.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "catalyst/pipeline_error.hpp"

namespace breccia::insitu::selection_test {
namespace {

/// Two triangles that share an edge, by corners, and a table.
struct Example {
  std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  std::vector<std::int32_t> corners{0, 1, 2, 1, 3, 2};
  std::vector<std::int32_t> body{4, 5};
  std::vector<std::int64_t> id{8, 9};
  std::vector<double> stress{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  std::vector<BrecciaArray> arrays{{"id", BRECCIA_I64, 1, id.data()},
                                   {"body", BRECCIA_I32, 1, body.data()},
                                   {"stress", BRECCIA_F64, 6, stress.data()}};
  BrecciaGrid grid{BRECCIA_TRIANGLE, 4, points.data(), 2, corners.data(), 77, 3, arrays.data(), 0, nullptr};
  BrecciaGrid table{BRECCIA_TABLE, 0, nullptr, 2, nullptr, 1, 3, arrays.data(), 0, nullptr};
  BrecciaInstant instant{12, 0.5, {}};
  Example() {
    instant.channels[BRECCIA_SURFACE] = &grid;
    instant.channels[BRECCIA_HISTORY] = &table;
  }
};

template <class T>
T value(const BrecciaArray& array, std::size_t i) {
  T out{};
  std::memcpy(&out, static_cast<const char*>(array.values) + i * sizeof(T), sizeof(T));
  return out;
}

TEST(SelectedInstant, OfFieldsHasThemAloneAndCopiesNothing) {
  Example example;
  SelectedInstant part(Selection{{}, {"stress", "body"}, {}});
  const BrecciaInstant& instant = part.of(example.instant);
  EXPECT_EQ(instant.step, 12);
  const BrecciaGrid& grid = *instant.channels[BRECCIA_SURFACE];
  ASSERT_EQ(grid.num_arrays, 2);
  EXPECT_STREQ(grid.arrays[0].name, "body");
  EXPECT_EQ(grid.arrays[1].values, example.stress.data());
  EXPECT_EQ(grid.points, example.points.data());
  EXPECT_EQ(grid.topology, 77U);
  EXPECT_EQ(instant.channels[BRECCIA_HISTORY], &example.table) << "its columns are no fields";
  EXPECT_EQ(instant.channels[BRECCIA_ELEMENTS], nullptr);
}

TEST(SelectedInstant, OfABoxHasTheCellsWhoseCentreLiesInItWithAllValues) {
  Example example;
  SelectedInstant part({std::array<double, 6>{0.5, 0, -1, 1, 1, 1}, {}, {}});
  const BrecciaGrid grid = *part.of(example.instant).channels[BRECCIA_SURFACE];
  ASSERT_EQ(grid.num_cells, 1);
  EXPECT_EQ(grid.num_points, 3);
  EXPECT_EQ(grid.corners, nullptr);
  EXPECT_EQ(std::vector<double>(grid.points, grid.points + 9), (std::vector<double>{1, 0, 0, 1, 1, 0, 0, 1, 0}));
  ASSERT_EQ(grid.num_arrays, 3);
  EXPECT_EQ(value<std::int64_t>(grid.arrays[0], 0), 9);
  EXPECT_EQ(value<std::int32_t>(grid.arrays[1], 0), 5);
  EXPECT_EQ(value<double>(grid.arrays[2], 5), 11);
  // Another number of cells is another topology.
  example.points[0] = example.points[3] = example.points[6] = 2;
  const BrecciaGrid all = *part.of(example.instant).channels[BRECCIA_SURFACE];
  EXPECT_EQ(all.num_cells, 0);
  EXPECT_EQ(all.num_arrays, 3);
  EXPECT_NE(all.topology, grid.topology);
}

TEST(SelectedInstant, OfABoxTakesNoCellWhoseCentreIsNoNumber) {
  Example example;
  example.points[0] = std::numeric_limits<double>::quiet_NaN();
  SelectedInstant part({std::array<double, 6>{-9, -9, -9, 9, 9, 9}, {}, {}});
  EXPECT_EQ(part.of(example.instant).channels[BRECCIA_SURFACE]->num_cells, 1);
}

/// The same with two arrays at its four points.
struct PointExample : Example {
  std::vector<double> von_mises{10, 11, 12, 13}, velocity{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  std::vector<BrecciaArray> at_points{{"von_mises", BRECCIA_F64, 1, von_mises.data()},
                                      {"velocity", BRECCIA_F64, 3, velocity.data()}};
  PointExample() {
    grid.num_point_arrays = 2;
    grid.point_arrays = at_points.data();
  }
};

TEST(SelectedInstant, HasNoValuesAtPointsThatWereNotAskedFor) {
  PointExample example;
  SelectedInstant part{Selection{}};
  EXPECT_EQ(part.of(example.instant).channels[BRECCIA_SURFACE]->num_point_arrays, 0);
  SelectedInstant one(Selection{{}, {}, {"velocity"}});
  const BrecciaGrid& grid = *one.of(example.instant).channels[BRECCIA_SURFACE];
  ASSERT_EQ(grid.num_point_arrays, 1);
  EXPECT_EQ(grid.point_arrays[0].values, example.velocity.data());
  EXPECT_EQ(grid.num_arrays, 3);
}

TEST(SelectedInstant, OfABoxHasTheValuesAtThePointsOfItsCells) {
  PointExample example;
  SelectedInstant part(Selection{std::array<double, 6>{0.5, 0, -1, 1, 1, 1}, {}, {"velocity", "von_mises"}});
  const BrecciaGrid& grid = *part.of(example.instant).channels[BRECCIA_SURFACE];
  ASSERT_EQ(grid.num_point_arrays, 2);
  for (std::size_t point = 0; point < 3; ++point) {
    const auto from = static_cast<std::size_t>(example.corners[3 + point]);
    EXPECT_EQ(value<double>(grid.point_arrays[1], point), example.von_mises[from]);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(value<double>(grid.point_arrays[0], 3 * point + k), example.velocity[3 * from + k]);
  }
}

TEST(SelectedInstant, RefusesValuesAtPointsThatTheRunDoesNotHave) {
  PointExample example;
  SelectedInstant part(Selection{{}, {}, {"compaction"}});
  EXPECT_THROW(static_cast<void>(part.of(example.instant)), PipelineError);
}

}  // namespace
}  // namespace breccia::insitu::selection_test
