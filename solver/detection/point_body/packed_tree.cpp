#include "detection/point_body/packed_tree.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace breccia::detection {

namespace {

constexpr std::size_t lanes = 8;               ///< points of a leaf, boxes of a group
constexpr std::size_t group_size = 6 * lanes;  ///< floats
constexpr std::size_t leaf_size = 3 * lanes;   ///< doubles
constexpr std::size_t look_ahead = 24;         ///< positions whose memory is prefetched
constexpr std::size_t contactors_ahead = 6;

static_assert(std::is_same_v<Index, std::int32_t>, "the kernels write numbers of points");

std::size_t in_groups(std::size_t count) { return (count + lanes - 1) / lanes; }

/// Never decreases with x, for any round-off.
float narrow(double x) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -largest, largest));
}

const PackedKernel& best_kernel() { return __builtin_cpu_supports("avx2") ? packed_kernel_avx2 : packed_kernel_sse2; }

Vec3 centre_of(const Corners& x) { return 0.25 * x[0] + 0.25 * x[1] + (0.25 * x[2] + 0.25 * x[3]); }

void prefetch(const Corners& corners) {
  const auto* const bytes = reinterpret_cast<const char*>(&corners);
  __builtin_prefetch(bytes);
  __builtin_prefetch(bytes + sizeof(Corners) / 2);
}

}  // namespace

PackedTree::PackedTree() : PackedTree(best_kernel()) {}

void PackedTree::fill_leaves(std::span<const Vec3> points, std::span<const CurveOrder::Record> order) {
  num_points_ = order.size();
  const std::size_t padded = in_groups(num_points_) * lanes;
  leaves_.resize(3 * padded);
  numbers_.resize(padded);
  for (std::size_t i = 0; i < padded; ++i) {
    double* const x = leaves_.data() + i / lanes * leaf_size + i % lanes;
    if (i + look_ahead < num_points_) __builtin_prefetch(&points[order[i + look_ahead].number]);
    const bool empty = i >= num_points_;
    numbers_[i] = empty ? 0 : static_cast<Index>(order[i].number);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      x[lanes * axis] =
          empty ? std::numeric_limits<double>::quiet_NaN() : points[order[i].number][static_cast<Eigen::Index>(axis)];
    }
  }
}

void PackedTree::lay_out_levels(std::size_t num_leaves) {
  level_.assign(1, 0);
  for (std::size_t children = num_leaves; children > 0;) {
    const std::size_t groups = in_groups(children);
    level_.push_back(level_.back() + groups);
    children = groups > 1 ? groups : 0;
  }
  // Boxes that nothing meets stand where a group has less than eight children.
  boxes_.resize(level_.back() * group_size);
  now_.resize(num_leaves + lanes);
  next_.resize(num_leaves + lanes);
}

/// The box of a leaf's points into its place in the lowest level.
void PackedTree::set_leaf_box(std::size_t leaf) {
  float* const box = boxes_.data() + leaf / lanes * group_size + leaf % lanes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double* const x = leaves_.data() + leaf * leaf_size + axis * lanes;
    double low = x[0], high = x[0];
    for (std::size_t k = 1; k < lanes; ++k) {  // a NaN, which stands for no point, is never less nor more
      low = x[k] < low ? x[k] : low;
      high = x[k] > high ? x[k] : high;
    }
    const double centre = centre_[static_cast<Eigen::Index>(axis)];
    box[axis * lanes] = narrow(low - centre);
    box[(axis + 3) * lanes] = narrow(high - centre);
  }
}

/// Boxes around the children's groups; behind the last child boxes that nothing meets.
void PackedTree::set_group_boxes(std::size_t level, std::size_t num_children) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  float* const boxes = boxes_.data() + level_[level] * group_size;
  for (std::size_t child = 0; child < in_groups(num_children) * lanes; ++child) {
    float* const box = boxes + child / lanes * group_size + child % lanes;
    const float* const inner = boxes_.data() + (level == 0 ? 0 : level_[level - 1] + child) * group_size;
    for (std::size_t side = 0; side < 6; ++side) {
      const bool is_low = side < 3;
      float outermost = is_low ? infinity : -infinity;
      if (level == 0) {
        if (child >= num_children) box[side * lanes] = outermost;
        continue;
      }
      for (std::size_t k = 0; child < num_children && k < lanes; ++k) {
        const float x = inner[side * lanes + k];
        outermost = is_low ? std::min(outermost, x) : std::max(outermost, x);
      }
      box[side * lanes] = outermost;
    }
  }
}

PackedQuery PackedTree::query_of(const CoupleTest& test) const {
  PackedQuery query;
  for (int axis = 0; axis < 3; ++axis) {
    query.box_low[axis] = test.low()[axis];
    query.box_high[axis] = test.high()[axis];
    query.low[axis] = narrow(test.low()[axis] - centre_[axis]);
    query.high[axis] = narrow(test.high()[axis] - centre_[axis]);
    query.origin[axis] = test.origin()[axis];
  }
  query.has_planes = test.has_planes();
  for (std::size_t a = 0; a < 4; ++a) {
    const CoupleTest::Plane& plane = test.planes()[a];
    std::copy(plane.normal.begin(), plane.normal.end(), query.normal[a]);
    query.limit[a] = plane.limit;
  }
  return query;
}

void PackedTree::search_contactor(const CoupleTest& test, Index contactor) {
  const PackedQuery query = query_of(test);
  const PackedTreeView tree{boxes_.data(), level_.data(), static_cast<int>(level_.size()) - 1, leaves_.data(),
                            numbers_.data()};
  PackedFrontier frontier{now_.data(), next_.data()};
  const std::size_t num_leaves = kernel_.leaves(tree, query, frontier);
  if (num_leaves == 0) return;
  const std::size_t room = lanes * (num_leaves + 1);
  if (hits_.size() < room) hits_.resize(2 * room);
  const std::size_t num_hits = kernel_.points(tree, query, frontier.now, num_leaves, hits_.data());
  if (found_.size() < num_found_ + num_hits) found_.resize(2 * (num_found_ + num_hits));
  for (std::size_t k = 0; k < num_hits; ++k) found_[num_found_++] = {hits_[k], contactor};
}

void PackedTree::search(std::span<const Vec3> points, std::span<const Corners> contactors, double buffer,
                        std::vector<Couple>& couples) {
  demand_searchable(points.size(), contactors.size(), buffer);
  const CurveFrame frame = frame_of(points);
  centre_ = frame.centre;
  fill_leaves(points, order_.arrange(points.size(), frame, [&](std::size_t p) { return points[p]; }));
  const std::size_t num_leaves = in_groups(num_points_);
  lay_out_levels(num_leaves);
  for (std::size_t leaf = 0; leaf < num_leaves; ++leaf) set_leaf_box(leaf);
  std::size_t num_children = num_leaves;
  for (std::size_t level = 0; level + 1 < level_.size(); ++level) {
    set_group_boxes(level, num_children);
    num_children = level_[level + 1] - level_[level];
  }

  num_found_ = 0;
  const auto order = order_.arrange(contactors.size(), frame, [&](std::size_t c) { return centre_of(contactors[c]); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + contactors_ahead < order.size()) prefetch(contactors[order[i + contactors_ahead].number]);
    const CoupleTest test(contactors[order[i].number], buffer);
    if (!test.skipped()) search_contactor(test, static_cast<Index>(order[i].number));
  }
  sorter_.sort({found_.data(), num_found_}, points.size(), couples);
}

}  // namespace breccia::detection
