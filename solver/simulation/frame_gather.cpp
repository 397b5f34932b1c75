#include "simulation/frame_gather.hpp"

#include <algorithm>
#include <numeric>

namespace breccia {
namespace {

/// Appends what all ranks have, by rank.
template <class T>
void collect(const Communicator& communicator, std::vector<T>& values) {
  std::vector<T> all;
  for (const std::vector<T>& part : communicator.gather(std::span<const T>(values))) all.insert(all.end(), part.begin(), part.end());
  values = std::move(all);
}

/// Order that makes the ids ascend; equal ones keep theirs.
std::vector<std::size_t> ascending(const std::vector<std::int64_t>& ids) {
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  return order;
}

/// @param width  values an entry
template <class T>
void arrange(const std::vector<std::size_t>& order, std::size_t width, std::vector<T>& values) {
  if (values.empty()) return;
  std::vector<T> arranged(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(order[i] * width), width, arranged.begin() + static_cast<std::ptrdiff_t>(i * width));
  }
  values = std::move(arranged);
}

template <class... Arrays>
void gather_arrays(const Communicator& communicator, std::vector<std::int64_t>& ids, Arrays&&... arrays) {
  collect(communicator, ids);
  (collect(communicator, arrays.values), ...);
  const std::vector<std::size_t> order = ascending(ids);
  arrange(order, 1, ids);
  (arrange(order, arrays.width, arrays.values), ...);
}

template <class T>
struct Array {
  std::vector<T>& values;
  std::size_t width;
};

}  // namespace

Frame gather_frame(const Communicator& communicator, Frame mine) {
  if (communicator.size() == 1) return mine;
  Frame::Elements& e = mine.elements;
  gather_arrays(communicator, e.id, Array{e.points, 12}, Array{e.body, 1}, Array{e.material, 1}, Array{e.rank, 1},
                Array{e.fragment, 1}, Array{e.stress, 6}, Array{e.von_mises, 1}, Array{e.principal, 3}, Array{e.velocity, 3},
                Array{e.displacement, 3});
  Frame::Joints& j = mine.joints;
  gather_arrays(communicator, j.id, Array{j.points, 9}, Array{j.damage, 1}, Array{j.mode, 1}, Array{j.opening, 1}, Array{j.slip, 1},
                Array{j.broken, 1});
  Frame::Contacts& c = mine.contacts;
  gather_arrays(communicator, c.id, Array{c.points, 3}, Array{c.force, 3}, Array{c.body, 1}, Array{c.other_body, 1});
  return mine;
}

}  // namespace breccia
