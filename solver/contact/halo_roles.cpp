#include "contact/halo_roles.hpp"

#include "contact/cell_marks.hpp"

namespace breccia {

void find_halo_roles(const ContactState& contact, std::span<const Extent> extents, double buffer, double cell,
                     std::vector<HaloRole>& roles) {
  const auto evaluated = [&](std::size_t s) { return contact.evaluated(static_cast<Index>(s)); };
  roles.assign(extents.size(), HaloRole::none);
  Extent ours, region;
  for (std::size_t s = 0; s < extents.size(); ++s) {
    if (evaluated(s)) ours.add(extents[s]);
  }
  for (std::size_t s = 0; s < extents.size(); ++s) {
    if (evaluated(s) || !extents[s].near(ours, kContactorReach * buffer)) continue;
    roles[s] = HaloRole::contactor;
    region.add(extents[s]);
  }
  CellMarks near(region, cell), nearest(region, cell);
  for (std::size_t s = 0; s < extents.size(); ++s) {
    if (!evaluated(s) || !extents[s].near(region, kContactorReach * buffer)) continue;
    near.mark(extents[s], kContactorReach * buffer);
    nearest.mark(extents[s], kPointReach * buffer);
  }
  for (std::size_t s = 0; s < extents.size(); ++s) {
    if (roles[s] == HaloRole::none) continue;
    roles[s] = nearest.any(extents[s]) ? HaloRole::contactor_and_points
               : near.any(extents[s])  ? HaloRole::contactor
                                       : HaloRole::none;
  }
}

}  // namespace breccia
