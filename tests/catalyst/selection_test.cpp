// The cells and arrays that a pipeline gets of an instant.

#include "catalyst/selection.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace breccia::insitu {
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
  BrecciaGrid grid{BRECCIA_TRIANGLE, 4, points.data(), 2, corners.data(), 77, 3, arrays.data()};
  BrecciaGrid table{BRECCIA_TABLE, 0, nullptr, 2, nullptr, 1, 3, arrays.data()};
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
  SelectedInstant part({{}, {"stress", "body"}});
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
  SelectedInstant part({std::array<double, 6>{0.5, 0, -1, 1, 1, 1}, {}});
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
  SelectedInstant part({std::array<double, 6>{-9, -9, -9, 9, 9, 9}, {}});
  EXPECT_EQ(part.of(example.instant).channels[BRECCIA_SURFACE]->num_cells, 1);
}

}  // namespace
}  // namespace breccia::insitu
