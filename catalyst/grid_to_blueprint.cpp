#include "catalyst/grid_to_blueprint.hpp"

#include <array>
#include <cstddef>
#include <numeric>

#include "catalyst/channel_names.hpp"

namespace breccia::insitu {
namespace {

/// Views of no values need an address all the same.
alignas(64) std::array<std::byte, 64> nothing{};

constexpr std::int64_t kMachineEndianness = 0;  // Conduit's "as the machine has it"

template <class T>
struct Viewed {
  T* data;
  std::int64_t count;
  int components;
};

template <class T>
Viewed<T> viewed(const void* values, std::int64_t count, int components) {
  // Conduit has no read-only views; implementations copy before they write.
  void* const data = count == 0 || values == nullptr ? nothing.data() : const_cast<void*>(values);
  return {static_cast<T*>(data), count, components};
}

/// The component i of interleaved values, or all values where there is one.
template <class T>
void view(ConduitFunctions::View<T> function, ConduitNode* node, const std::string& path, const Viewed<T>& values,
          int component) {
  function(node, path.c_str(), values.data, values.count, component * static_cast<std::int64_t>(sizeof(T)),
           values.components * static_cast<std::int64_t>(sizeof(T)), sizeof(T), kMachineEndianness);
}

std::string component_name(int component, int components) {
  static constexpr std::array kVector{"x", "y", "z"};
  static constexpr std::array kTensor{"xx", "yy", "zz", "xy", "yz", "xz"};
  const auto i = static_cast<std::size_t>(component);
  if (components == 3) return kVector.at(i);
  if (components == 6) return kTensor.at(i);
  return std::to_string(component);
}

template <class T>
void view_array(ConduitFunctions::View<T> function, ConduitNode* field, const BrecciaArray& array, std::int64_t cells) {
  const Viewed<T> values = viewed<T>(array.values, cells, array.components);
  for (int i = 0; i < array.components; ++i) {
    const std::string below = array.components == 1 ? "" : "/" + component_name(i, array.components);
    view(function, field, "values" + below, values, i);
  }
}

void add_field(const ConduitFunctions& conduit, ConduitNode* fields, const BrecciaArray& array, std::int64_t cells) {
  ConduitNode* const field = conduit.add_child(fields, array.name);  // a name, not a path: it may hold a slash
  conduit.set_path_text(field, "association", "element");
  conduit.set_path_text(field, "topology", "mesh");
  switch (array.type) {
    case BRECCIA_F64:
      return view_array(conduit.view_float64, field, array, cells);
    case BRECCIA_I32:
      return view_array(conduit.view_int32, field, array, cells);
    case BRECCIA_I64:
      return view_array(conduit.view_int64, field, array, cells);
    default:
      throw PipelineError(std::string("array ") + array.name + " has the unknown type " + std::to_string(array.type));
  }
}

const char* shape_of(std::int32_t cell) {
  switch (cell) {
    case BRECCIA_TRIANGLE:
      return "tri";
    case BRECCIA_TETRAHEDRON:
      return "tet";
    case BRECCIA_HEXAHEDRON:
      return "hex";
    default:
      return "point";
  }
}

/// A table's rows are points.
int corners_of_row(std::int32_t cell) { return cell == BRECCIA_TABLE ? 1 : corners_of(cell); }

}  // namespace

void GridToBlueprint::reserve(const BrecciaGrid& grid) {
  const std::int64_t entries = grid.num_cells * corners_of_row(grid.cell);
  if (entries >= INT32_MAX) throw PipelineError("has more than 2^31 corners on a rank");
  const auto size = static_cast<std::size_t>(entries);
  if (grid.cell == BRECCIA_TABLE && origin_.size() < 3 * size) origin_.resize(3 * size);
  if (grid.corners != nullptr || in_turn_.size() >= size) return;
  in_turn_.resize(size);
  std::iota(in_turn_.begin(), in_turn_.end(), 0);
}

void GridToBlueprint::fill(const ConduitFunctions& conduit, ConduitNode* data, const BrecciaGrid& grid, int rank,
                           std::int64_t step, double time) {
  reserve(grid);
  const bool is_table = grid.cell == BRECCIA_TABLE;
  const std::int64_t entries = grid.num_cells * corners_of_row(grid.cell);
  const std::int64_t points = is_table ? grid.num_cells : grid.num_points;
  if (grid.corners == nullptr && entries != points)
    throw PipelineError("has " + std::to_string(points) + " points for " + std::to_string(grid.num_cells) +
                        " cells without corners");
  conduit.set_path_int64(data, "state/domain_id", rank);
  conduit.set_path_int64(data, "state/cycle", step);
  conduit.set_path_float64(data, "state/time", time);
  conduit.set_path_text(data, "coordsets/coords/type", "explicit");
  const auto places = viewed<double>(is_table ? origin_.data() : grid.points, points, 3);
  for (int i = 0; i < 3; ++i)
    view(conduit.view_float64, data, "coordsets/coords/values/" + component_name(i, 3), places, i);
  conduit.set_path_text(data, "topologies/mesh/type", "unstructured");
  conduit.set_path_text(data, "topologies/mesh/coordset", "coords");
  conduit.set_path_text(data, "topologies/mesh/elements/shape", shape_of(grid.cell));
  const auto corners = viewed<std::int32_t>(grid.corners == nullptr ? in_turn_.data() : grid.corners, entries, 1);
  view(conduit.view_int32, data, "topologies/mesh/elements/connectivity", corners, 0);
  ConduitNode* const fields = grid.num_arrays > 0 ? conduit.fetch(data, "fields") : nullptr;
  for (std::int32_t i = 0; i < grid.num_arrays; ++i) add_field(conduit, fields, grid.arrays[i], grid.num_cells);
}

EmptyGrid::EmptyGrid(const BrecciaGrid& like) : cell_(like.cell) {
  for (std::int32_t i = 0; i < like.num_arrays; ++i) {
    names_.emplace_back(like.arrays[i].name);
    arrays_.push_back({nullptr, like.arrays[i].type, like.arrays[i].components, nullptr});
  }
  for (std::size_t i = 0; i < arrays_.size(); ++i) arrays_[i].name = names_[i].c_str();
}

BrecciaGrid EmptyGrid::grid() const {
  BrecciaGrid empty{};
  empty.cell = cell_;
  empty.num_arrays = static_cast<std::int32_t>(arrays_.size());
  empty.arrays = arrays_.data();
  return empty;
}

}  // namespace breccia::insitu
