#include "output/frames/vtkhdf_layout.hpp"

#include <algorithm>
#include <numeric>
#include <type_traits>

#include "base/error.hpp"

namespace breccia {
namespace {

struct Shape {
  std::size_t points_per_cell;
  std::uint8_t vtk_type;
};

Shape shape_of(CellKind kind) {
  switch (kind) {
    case CellKind::tetrahedra:
      return {4, 10};
    case CellKind::triangles:
      return {3, 5};
    case CellKind::vertices:
      break;
  }
  return {1, 1};
}

template <class T>
constexpr NumberType type_of() {
  if constexpr (std::is_same_v<T, double>) return NumberType::float64;
  if constexpr (std::is_same_v<T, float>) return NumberType::float32;
  if constexpr (std::is_same_v<T, std::int64_t>) return NumberType::int64;
  if constexpr (std::is_same_v<T, std::int32_t>) return NumberType::int32;
  if constexpr (std::is_same_v<T, std::uint8_t>) return NumberType::uint8;
}

class Columns {
 public:
  std::vector<Column> list;

  /// Values that stand somewhere.
  template <class T>
  void add(const std::string& group, const std::string& name, std::span<const T> values, int components,
           const Rows& rows, bool deflates) {
    list.push_back({group, name, type_of<T>(), components, rows, deflates,
                    [values](std::vector<std::byte>&) { return std::as_bytes(values); }});
  }
  /// Values to be made: value(i) for i < count.
  template <class T, class Value>
  void add_made(const std::string& group, const std::string& name, std::size_t count, Value value, int components,
                const Rows& rows, bool deflates) {
    list.push_back(
        {group, name, type_of<T>(), components, rows, deflates, [count, value](std::vector<std::byte>& space) {
           space.resize(count * sizeof(T));
           T* const out = reinterpret_cast<T*>(space.data());
           for (std::size_t i = 0; i < count; ++i) out[i] = value(i);
           return std::span<const std::byte>(space);
         }});
  }
};

void add_cells(const GridView& grid, const Pieces& pieces, Columns& columns) {
  const auto [n, vtk_type] = shape_of(grid.kind);
  const std::size_t points = grid.points.size() / 3, cells = num_cells(grid);
  const Rows a_piece = pieces.rows(0, 1), a_point = pieces.rows(n, 0);
  const auto count = [&](const char* name, std::size_t number) {
    columns.add_made<std::int64_t>(
        "", name, 1, [number](std::size_t) { return static_cast<std::int64_t>(number); }, 1, a_piece, false);
  };
  count("NumberOfPoints", points);
  count("NumberOfCells", cells);
  count("NumberOfConnectivityIds", points);
  columns.add("", "Points", grid.points, 3, a_point, false);
  columns.add_made<std::int64_t>(
      "", "Connectivity", points, [](std::size_t i) { return static_cast<std::int64_t>(i); }, 1, a_point, true);
  columns.add_made<std::int64_t>(
      "", "Offsets", cells + 1, [corners = n](std::size_t i) { return static_cast<std::int64_t>(corners * i); }, 1,
      pieces.rows(1, 1), true);
  columns.add_made<std::uint8_t>(
      "", "Types", cells, [type = vtk_type](std::size_t) { return type; }, 1, pieces.rows(1, 0), true);
}

void add_cell_arrays(const GridView& grid, const Pieces& pieces, Columns& columns) {
  const Rows a_cell = pieces.rows(1, 0);
  for (const CellArray& array : grid.arrays) {
    std::visit(
        [&](auto values) {
          if constexpr (std::is_same_v<decltype(values), std::span<const double>>) {
            if (array.in_64_bits) {
              columns.add("CellData", array.name, values, array.components, a_cell, false);
              return;
            }
            const auto single = [values](std::size_t i) { return static_cast<float>(values[i]); };
            columns.add_made<float>("CellData", array.name, values.size(), single, array.components, a_cell, false);
          } else {
            columns.add("CellData", array.name, values, array.components, a_cell, true);
          }
        },
        array.values);
  }
}

}  // namespace

std::size_t size_of(NumberType type) {
  switch (type) {
    case NumberType::float64:
    case NumberType::int64:
      return 8;
    case NumberType::float32:
    case NumberType::int32:
      return 4;
    case NumberType::int8:
    case NumberType::uint8:
      break;
  }
  return 1;
}

Pieces::Pieces(const Communicator& communicator, std::size_t cells)
    : rank_(static_cast<std::size_t>(communicator.rank())) {
  const auto mine = static_cast<std::uint64_t>(cells);
  for (const std::vector<std::uint64_t>& list : communicator.all_gather(std::span(&mine, 1)))
    cells_.push_back(list.at(0));
}

Rows Pieces::rows(std::uint64_t a_cell, std::uint64_t a_piece) const {
  const auto up_to = [&](std::size_t end) {
    return a_cell *
               std::accumulate(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(end), std::uint64_t{0}) +
           a_piece * end;
  };
  return {up_to(rank_ + 1) - up_to(rank_), up_to(rank_), up_to(cells_.size())};
}

std::vector<Column> vtkhdf_columns(const GridView& grid, const Pieces& pieces) {
  Columns columns;
  add_cells(grid, pieces, columns);
  add_cell_arrays(grid, pieces, columns);
  const Rows single = pieces.single();
  columns.add("FieldData", "time", std::span(&grid.time, single.mine), 1, single, false);
  columns.add("FieldData", "step", std::span(&grid.step, single.mine), 1, single, false);
  return std::move(columns.list);
}

std::size_t num_cells(const GridView& grid) { return grid.points.size() / 3 / shape_of(grid.kind).points_per_cell; }

void check_sizes(const GridView& grid) {
  const std::size_t cells = num_cells(grid);
  DEMAND(grid.points.size() == 3 * cells * shape_of(grid.kind).points_per_cell,
         "points " + std::to_string(grid.points.size()));
  for (const CellArray& array : grid.arrays) {
    const std::size_t size = std::visit([](auto values) { return values.size(); }, array.values);
    DEMAND(size == cells * static_cast<std::size_t>(array.components),
           array.name + " has " + std::to_string(size) + " values for " + std::to_string(cells) + " cells");
  }
}

}  // namespace breccia
