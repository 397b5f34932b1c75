#include "catalyst/selection.hpp"

#include <algorithm>
#include <cstring>
#include <span>

#include "catalyst/channel_names.hpp"

namespace breccia::insitu {
namespace {

/// Which point a cell's corner is.
std::int64_t place_of(const BrecciaGrid& grid, std::int64_t cell, int corners, int corner) {
  const std::int64_t place = cell * corners + corner;
  return grid.corners == nullptr ? place : std::int64_t{grid.corners[place]};
}

/// Makes arrays those of some entries alone. @param values  out: what they point to
void pick(std::vector<BrecciaArray>& arrays, const std::vector<std::int64_t>& entries,
          std::vector<std::vector<std::byte>>& values) {
  values.resize(arrays.size());
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const std::size_t size = bytes_of(arrays[i]);
    values[i].resize(size * entries.size());
    const auto* const from = static_cast<const std::byte*>(arrays[i].values);
    for (std::size_t k = 0; k < entries.size(); ++k)
      std::memcpy(values[i].data() + k * size, from + static_cast<std::size_t>(entries[k]) * size, size);
    arrays[i].values = values[i].data();
  }
}

bool is_within(const BrecciaGrid& grid, std::int64_t cell, int corners, const std::array<double, 6>& region) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (int corner = 0; corner < corners; ++corner)
      sum += grid.points[3 * place_of(grid, cell, corners, corner) + static_cast<std::int64_t>(axis)];
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
    select_point_fields(channel, static_cast<int>(i));
    if (selection_.region) select_cells(channel);
    channel.grid.num_arrays = static_cast<std::int32_t>(channel.arrays.size());
    channel.grid.arrays = channel.arrays.data();
    channel.grid.num_point_arrays = static_cast<std::int32_t>(channel.point_arrays.size());
    channel.grid.point_arrays = channel.point_arrays.data();
    instant_.channels[i] = &channel.grid;
  }
  return instant_;
}

void SelectedInstant::select_fields(Channel& channel) const {
  std::erase_if(channel.arrays, [this](const BrecciaArray& array) {
    return std::find(selection_.fields.begin(), selection_.fields.end(), array.name) == selection_.fields.end();
  });
}

void SelectedInstant::select_point_fields(Channel& channel, int index) const {
  channel.point_arrays.clear();
  if (index != BRECCIA_ELEMENTS && index != BRECCIA_SURFACE) return;
  const std::span given(channel.grid.point_arrays, static_cast<std::size_t>(channel.grid.num_point_arrays));
  for (const std::string& name : selection_.point_fields) {
    const auto found = std::find_if(given.begin(), given.end(), [&](const BrecciaArray& a) { return a.name == name; });
    if (found == given.end())
      throw PipelineError(std::string("channel ") + kChannelNames[static_cast<std::size_t>(index)] +
                          " has no values '" + name + "' at points in this run");
    channel.point_arrays.push_back(*found);
  }
}

void SelectedInstant::select_cells(Channel& channel) const {
  const BrecciaGrid& whole = channel.grid;
  const int corners = corners_of(whole.cell);
  std::vector<std::int64_t> cells;
  for (std::int64_t cell = 0; cell < whole.num_cells; ++cell) {
    if (is_within(whole, cell, corners, *selection_.region)) cells.push_back(cell);
  }
  std::vector<std::int64_t> places;
  for (const std::int64_t cell : cells) {
    for (int corner = 0; corner < corners; ++corner) places.push_back(place_of(whole, cell, corners, corner));
  }
  channel.points.clear();
  for (const std::int64_t place : places)
    channel.points.insert(channel.points.end(), whole.points + 3 * place, whole.points + 3 * place + 3);
  pick(channel.arrays, cells, channel.values);
  pick(channel.point_arrays, places, channel.point_values);
  channel.grid.num_cells = static_cast<std::int64_t>(cells.size());
  channel.grid.num_points = channel.grid.num_cells * corners;
  channel.grid.points = channel.points.data();
  channel.grid.corners = nullptr;
  channel.grid.topology = cells.size();  // each cell has its own points: their number is all there is
}

}  // namespace breccia::insitu
