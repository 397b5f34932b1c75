#include "output/insitu/channels.hpp"

#include <algorithm>
#include <type_traits>

#include "base/error.hpp"
#include "output/frames/frame_fields.hpp"

namespace breccia {
namespace {

template <class T>
BrecciaArray array(const char* name, const std::vector<T>& values, std::int32_t components = 1) {
  static_assert(std::is_same_v<T, double> || std::is_same_v<T, std::int32_t> || std::is_same_v<T, std::int64_t>);
  const int type = std::is_same_v<T, double>         ? BRECCIA_F64
                   : std::is_same_v<T, std::int32_t> ? BRECCIA_I32
                                                     : BRECCIA_I64;
  return {name, type, components, values.data()};
}

template <class Part>
std::vector<BrecciaArray> arrays_of(const Part& part) {
  std::vector<BrecciaArray> arrays;
  for_each_array(part, [&](const char* name, const auto& values, int components) {
    arrays.push_back(array(name, values, components));
  });
  return arrays;
}

/// Leaves the entries [n i, n i + n) of a list, for the places i where `keep` is not 0.
template <class T>
void pick(std::vector<T>& values, const std::vector<std::int32_t>& keep, std::size_t n) {
  auto end = values.begin();
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(n * i);
    if (keep[i] != 0) end = std::copy_n(first, n, end);
  }
  values.erase(end, values.end());
}

Frame::Joints broken_ones(Frame::Joints joints) {
  const std::vector<std::int32_t> broken = joints.broken;
  pick(joints.points, broken, 9);
  for_each_array(joints, [&](const char*, auto& values, int components) {
    pick(values, broken, static_cast<std::size_t>(components));
  });
  return joints;
}

bool has(std::uint32_t mask, int channel) { return (mask >> channel & 1U) != 0; }

}  // namespace

std::uint32_t channel_mask(const std::vector<std::string>& names) {
  std::uint32_t mask = 0;
  for (const std::string& name : names) {
    const auto found = std::find(kChannelNames.begin(), kChannelNames.end(), name);
    DEMAND(found != kChannelNames.end(), name);
    mask |= 1U << (found - kChannelNames.begin());
  }
  return mask;
}

FrameParts parts_of(std::uint32_t channels) {
  return {.elements = has(channels, BRECCIA_ELEMENTS),
          .joints = has(channels, BRECCIA_JOINTS) || has(channels, BRECCIA_FRACTURES),
          .contacts = has(channels, BRECCIA_CONTACTS),
          .surface = has(channels, BRECCIA_SURFACE),
          .domain = has(channels, BRECCIA_DOMAINS),
          .at_points = (channels & BRECCIA_POINT_VALUES) != 0};
}

Channels::Channels(const Frame& frame, std::uint32_t mask, const std::vector<std::string>& columns,
                   const std::optional<std::vector<double>>& row) {
  instant_.step = frame.step;
  instant_.time = frame.time;
  if (has(mask, BRECCIA_ELEMENTS))
    add(BRECCIA_ELEMENTS, BRECCIA_TETRAHEDRON, frame.elements.points, frame.elements.id.size(),
        arrays_of(frame.elements));
  if (has(mask, BRECCIA_JOINTS)) add_joints(BRECCIA_JOINTS, frame.joints);
  if (has(mask, BRECCIA_FRACTURES)) add_joints(BRECCIA_FRACTURES, fractures_ = broken_ones(frame.joints));
  if (has(mask, BRECCIA_CONTACTS)) {
    const Frame::Contacts& c = frame.contacts;
    add(BRECCIA_CONTACTS, BRECCIA_VERTEX, c.points, c.id.size(), arrays_of(c));
  }
  if (has(mask, BRECCIA_SURFACE)) {
    add(BRECCIA_SURFACE, BRECCIA_TRIANGLE, frame.surface.cells.points, frame.surface.face.size(),
        arrays_of(frame.surface));
  }
  if (has(mask, BRECCIA_DOMAINS)) {
    const Frame::Domain& d = frame.domain;
    add(BRECCIA_DOMAINS, BRECCIA_HEXAHEDRON, d.points, d.rank.size(), arrays_of(d));
  }
  if (has(mask, BRECCIA_HISTORY)) add_history(columns, row);
  if ((mask & BRECCIA_POINT_VALUES) == 0) return;
  if (has(mask, BRECCIA_ELEMENTS)) add_at_points(BRECCIA_ELEMENTS, frame.elements.at_points);
  if (has(mask, BRECCIA_SURFACE)) add_at_points(BRECCIA_SURFACE, frame.surface.cells.at_points);
}

void Channels::add(int channel, int32_t cell, const std::vector<double>& points, std::size_t cells,
                   std::vector<BrecciaArray> arrays) {
  Channel& c = channels_[static_cast<std::size_t>(channel)];
  c.arrays = std::move(arrays);
  c.grid.cell = cell;
  c.grid.num_points = static_cast<std::int64_t>(points.size() / 3);
  c.grid.points = points.data();
  c.grid.num_cells = static_cast<std::int64_t>(cells);
  c.grid.topology = cells;  // every cell has its own points, in turn: the number of cells is all there is
  c.grid.num_arrays = static_cast<std::int32_t>(c.arrays.size());
  c.grid.arrays = c.arrays.data();
  instant_.channels[channel] = &c.grid;
}

void Channels::add_at_points(int channel, const Frame::AtPoints& values) {
  Channel& c = channels_[static_cast<std::size_t>(channel)];
  c.point_arrays = arrays_of(values);
  c.grid.num_point_arrays = static_cast<std::int32_t>(c.point_arrays.size());
  c.grid.point_arrays = c.point_arrays.data();
}

void Channels::add_joints(int channel, const Frame::Joints& joints) {
  add(channel, BRECCIA_TRIANGLE, joints.points, joints.id.size(), arrays_of(joints));
}

void Channels::add_history(const std::vector<std::string>& columns, const std::optional<std::vector<double>>& row) {
  if (row) row_ = *row;
  std::vector<BrecciaArray> arrays;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    arrays.push_back({columns[i].c_str(), BRECCIA_F64, 1, row ? row_.data() + i : nullptr});
  }
  add(BRECCIA_HISTORY, BRECCIA_TABLE, {}, row ? 1 : 0, std::move(arrays));
}

}  // namespace breccia
