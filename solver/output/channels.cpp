#include "output/channels.hpp"

#include <algorithm>
#include <type_traits>

#include "base/error.hpp"

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

std::vector<BrecciaArray> arrays_of(const Frame::Elements& e) {
  return {array("id", e.id),
          array("body", e.body),
          array("material", e.material),
          array("rank", e.rank),
          array("fragment", e.fragment),
          array("stress", e.stress, 6),
          array("von_mises", e.von_mises),
          array("principal", e.principal, 3),
          array("velocity", e.velocity, 3),
          array("displacement", e.displacement, 3),
          array("cost", e.cost)};
}

std::vector<BrecciaArray> arrays_of(const Frame::Joints& j) {
  return {array("id", j.id),
          array("damage", j.damage),
          array("mode", j.mode),
          array("opening", j.opening),
          array("slip", j.slip),
          array("broken", j.broken),
          array("time_of_failure", j.time_of_failure),
          array("state", j.state)};
}

/// Entries [n i, n i + n) of a list, for the places i where `keep` is not 0.
template <class T>
std::vector<T> picked(const std::vector<T>& values, const std::vector<std::int32_t>& keep, std::size_t n = 1) {
  std::vector<T> out;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] != 0)
      out.insert(out.end(), values.begin() + static_cast<std::ptrdiff_t>(n * i),
                 values.begin() + static_cast<std::ptrdiff_t>(n * (i + 1)));
  }
  return out;
}

Frame::Joints broken_ones(const Frame::Joints& j) {
  return {picked(j.points, j.broken, 9), picked(j.id, j.broken),
          picked(j.damage, j.broken),    picked(j.mode, j.broken),
          picked(j.opening, j.broken),   picked(j.slip, j.broken),
          picked(j.broken, j.broken),    picked(j.time_of_failure, j.broken),
          picked(j.state, j.broken)};
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
          .domain = has(channels, BRECCIA_DOMAINS)};
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
    add(BRECCIA_CONTACTS, BRECCIA_VERTEX, c.points, c.id.size(),
        {array("id", c.id), array("normal_force", c.normal_force, 3), array("tangential_force", c.tangential_force, 3),
         array("force", c.force, 3), array("body", c.body), array("other_body", c.other_body)});
  }
  if (has(mask, BRECCIA_SURFACE)) {
    std::vector<BrecciaArray> arrays = arrays_of(frame.surface.cells);
    arrays.push_back(array("face", frame.surface.face));
    arrays.push_back(array("crack", frame.surface.crack));
    add(BRECCIA_SURFACE, BRECCIA_TRIANGLE, frame.surface.cells.points, frame.surface.face.size(), std::move(arrays));
  }
  if (has(mask, BRECCIA_DOMAINS)) {
    const Frame::Domain& d = frame.domain;
    add(BRECCIA_DOMAINS, BRECCIA_HEXAHEDRON, d.points, d.rank.size(),
        {array("rank", d.rank), array("elements", d.elements), array("joints", d.joints), array("couples", d.couples),
         array("load", d.load)});
  }
  if (has(mask, BRECCIA_HISTORY)) add_history(columns, row);
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
