#include "domains/corner_tags.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "domains/piece_mesh.hpp"
#include "model/model.hpp"

namespace breccia {

void tag_corners_anew(const Communicator& communicator, const WholeModel& whole, const std::vector<std::string>& cut,
                      Records& mine) {
  std::vector<std::uint8_t> tagged(mine.elements.size(), 0);
  for (const CornerTag& tag : mine.corners) tagged[static_cast<std::size_t>(mine.place_of(tag.element))] = 1;
  const std::vector<std::byte> packed = pack(mine, tagged);
  Records on_surfaces;
  for (const std::vector<std::byte>& of_rank : communicator.all_gather(std::span<const std::byte>(packed))) {
    Records part;
    unpack(of_rank, part);
    merge(on_surfaces, std::move(part));
  }
  const Mesh mesh = mesh_of(on_surfaces, whole);
  const Topology topology = topology_of(on_surfaces, mesh);
  // Those of curves, points and element sets are where they were.
  std::erase_if(mine.corners, [&](const CornerTag& tag) { return tag.group < std::ssize(whole.surface_groups); });
  for (const CornerTag& tag : tag_corners(cut, mesh, topology)) {
    if (mine.place_of(tag.element) >= 0) mine.corners.push_back(tag);
  }
  std::sort(mine.corners.begin(), mine.corners.end(),
            [](const CornerTag& p, const CornerTag& q) { return p.comes_before(q); });
}

}  // namespace breccia
