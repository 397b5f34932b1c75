#include "catalyst/selection.hpp"

#include <algorithm>
#include <cstring>

#include "catalyst/channel_names.hpp"

namespace breccia::insitu {
namespace {

std::size_t bytes_of(const BrecciaArray& array) {
  const std::size_t one = array.type == BRECCIA_I32 ? sizeof(std::int32_t) : sizeof(std::int64_t);
  return one * static_cast<std::size_t>(array.components);
}

/// The point of a cell's corner.
const double* point(const BrecciaGrid& grid, std::int64_t cell, int corners, int corner) {
  const std::int64_t place = cell * corners + corner;
  return grid.points + 3 * (grid.corners == nullptr ? place : std::int64_t{grid.corners[place]});
}

bool is_within(const BrecciaGrid& grid, std::int64_t cell, int corners, const std::array<double, 6>& region) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (int corner = 0; corner < corners; ++corner) sum += point(grid, cell, corners, corner)[axis];
    const double centre = sum / corners;
    if (!(centre >= region[axis] && centre <= region[axis + 3])) return false;
  }
  return true;
}

}  // namespace

const BrecciaInstant& SelectedInstant::of(const BrecciaInstant& whole) {
  instant_ = whole;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (whole.channels[i] == nullptr || whole.channels[i]->cell == BRECCIA_TABLE) continue;
    Channel& channel = channels_[i];
    channel.grid = *whole.channels[i];
    channel.arrays.assign(channel.grid.arrays, channel.grid.arrays + channel.grid.num_arrays);
    if (!selection_.fields.empty()) select_fields(channel);
    if (selection_.region) select_cells(channel);
    channel.grid.num_arrays = static_cast<std::int32_t>(channel.arrays.size());
    channel.grid.arrays = channel.arrays.data();
    instant_.channels[i] = &channel.grid;
  }
  return instant_;
}

void SelectedInstant::select_fields(Channel& channel) const {
  std::erase_if(channel.arrays, [this](const BrecciaArray& array) {
    return std::find(selection_.fields.begin(), selection_.fields.end(), array.name) == selection_.fields.end();
  });
}

void SelectedInstant::select_cells(Channel& channel) const {
  const BrecciaGrid& whole = channel.grid;
  const int corners = corners_of(whole.cell);
  std::vector<std::int64_t> cells;
  for (std::int64_t cell = 0; cell < whole.num_cells; ++cell) {
    if (is_within(whole, cell, corners, *selection_.region)) cells.push_back(cell);
  }
  channel.points.clear();
  for (const std::int64_t cell : cells) {
    for (int corner = 0; corner < corners; ++corner) {
      const double* const at = point(whole, cell, corners, corner);
      channel.points.insert(channel.points.end(), at, at + 3);
    }
  }
  channel.values.resize(channel.arrays.size());
  for (std::size_t i = 0; i < channel.arrays.size(); ++i) {
    BrecciaArray& array = channel.arrays[i];
    const std::size_t size = bytes_of(array);
    std::vector<std::byte>& values = channel.values[i];
    values.resize(size * cells.size());
    const auto* const from = static_cast<const std::byte*>(array.values);
    for (std::size_t k = 0; k < cells.size(); ++k)
      std::memcpy(values.data() + k * size, from + static_cast<std::size_t>(cells[k]) * size, size);
    array.values = values.data();
  }
  channel.grid.num_cells = static_cast<std::int64_t>(cells.size());
  channel.grid.num_points = channel.grid.num_cells * corners;
  channel.grid.points = channel.points.data();
  channel.grid.corners = nullptr;
  channel.grid.topology = cells.size();  // each cell has its own points: their number is all there is
}

}  // namespace breccia::insitu
