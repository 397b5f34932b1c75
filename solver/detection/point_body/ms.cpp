#include "detection/point_body/ms.hpp"

#include <cmath>

namespace breccia::detection {

namespace {

/// Cell size over the contactors' mean box width. Measured flat between 0.5 and 1 (tests/benchmark/detection): smaller
/// cells mean more tree searches, larger ones more points tested.
constexpr double cell_share = 0.7;

/// The whole cell box, in the form of Slices.
class WholeBox {
 public:
  WholeBox(const Cells& cells, const CoupleTest& test) : box_(cell_box(cells, test)) {}
  [[nodiscard]] const CellBox& box() const { return box_; }
  [[nodiscard]] CellRange y_range(std::int32_t) const { return {box_.low[1], box_.high[1]}; }
  [[nodiscard]] CellRange x_range(std::int32_t, std::int32_t) const { return {box_.low[0], box_.high[0]}; }

 private:
  CellBox box_;
};

}  // namespace

void Ms::load(std::span<const Vec3> points, const Cells& cells) {
  tree_.clear();
  tree_.reserve(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec3& x = points[p];
    if (!x.allFinite()) continue;
    tree_.add({cells.of(x[2]), cells.of(x[1]), cells.of(x[0])}, static_cast<Index>(p));
  }
}

template <class Slicing>
void Ms::search_box(std::span<const Vec3> points, const CoupleTest& test, Index contactor, const Slicing& slicing) {
  constexpr Index none = MsTree::none;
  const auto in_layer = [this](Index node, std::int32_t z) { return node != none && tree_.key(node).z == z; };
  const std::int32_t z_high = slicing.box().high[2];
  Index node = tree_.smallest_greater_z(slicing.box().low[2] - 1);
  while (node != none && tree_.key(node).z <= z_high) {
    const std::int32_t z = tree_.key(node).z;
    const CellRange in_y = slicing.y_range(z);
    if (tree_.key(node).y < in_y.low) node = tree_.smallest_greater_zy(z, in_y.low - 1);
    while (in_layer(node, z) && tree_.key(node).y <= in_y.high) {
      const std::int32_t y = tree_.key(node).y;
      const CellRange in_x = slicing.x_range(z, y);
      if (tree_.key(node).x < in_x.low) node = tree_.smallest_greater({z, y, in_x.low - 1});
      for (; node != none && tree_.key(node) <= CellKey{z, y, in_x.high}; node = tree_.next(node)) {
        const Index point = tree_.object(node);
        if (test.holds(points[static_cast<std::size_t>(point)])) found_.push_back({point, contactor});
      }
      if (in_layer(node, z) && tree_.key(node).y == y) node = tree_.smallest_greater_zy(z, y);
    }
    if (in_layer(node, z)) node = tree_.smallest_greater_z(z);
  }
}

void Ms::search(std::span<const Vec3> points, std::span<const Corners> contactors, double buffer,
                std::vector<Couple>& couples) {
  demand_searchable(points.size(), contactors.size(), buffer);
  const Cells cells(cell_ > 0 ? cell_ : choose_cell(contactors, buffer, cell_share));
  load(points, cells);
  found_.clear();
  for (std::size_t c = 0; c < contactors.size(); ++c) {
    const CoupleTest test(contactors[c], buffer);
    if (test.skipped()) continue;
    if (use_slices_) {
      search_box(points, test, static_cast<Index>(c), Slices(cells, test));
    } else {
      search_box(points, test, static_cast<Index>(c), WholeBox(cells, test));
    }
  }
  sorter_.sort(found_, points.size(), couples);
}

}  // namespace breccia::detection
