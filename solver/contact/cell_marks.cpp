#include "contact/cell_marks.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {

CellMarks::CellMarks(const Extent& region, double cell)
    : region_(region), bounded_((region.upper - region.lower).allFinite()) {
  if (!bounded_) return;
  std::size_t all = 1;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double width = region.upper[i] - region.lower[i];
    const auto k = static_cast<std::size_t>(i);
    cells_[k] = static_cast<std::int64_t>(std::clamp(std::ceil(width / cell), 1.0, static_cast<double>(kMostCells)));
    per_length_[i] = width > 0 ? static_cast<double>(cells_[k]) / width : 0.0;
    all *= static_cast<std::size_t>(cells_[k]);
  }
  marks_.assign(all, 0);
}

CellMarks::Cell CellMarks::cell_of(const Vec3& x) const {
  Cell cell;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double place = (x[i] - region_.lower[i]) * per_length_[i];
    cell[k] = place > 0 ? static_cast<std::int64_t>(std::min(place, static_cast<double>(cells_[k] - 1))) : 0;
  }
  return cell;
}

template <class Use>
void CellMarks::each(const Cell& low, const Cell& high, Use&& use) const {
  for (std::int64_t z = low[2]; z <= high[2]; ++z) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t x = low[0]; x <= high[0]; ++x)
        use(static_cast<std::size_t>((z * cells_[1] + y) * cells_[0] + x));
    }
  }
}

void CellMarks::mark(const Extent& box, double distance) {
  if (!bounded_ || !box.near(region_, distance)) return;
  const Vec3 more = Vec3::Constant(distance);
  each(cell_of(box.lower - more), cell_of(box.upper + more), [&](std::size_t cell) { marks_[cell] = 1; });
}

bool CellMarks::any(const Extent& box) const {
  if (!bounded_) return true;
  bool found = false;
  each(cell_of(box.lower), cell_of(box.upper), [&](std::size_t cell) { found = found || marks_[cell] != 0; });
  return found;
}

}  // namespace breccia
