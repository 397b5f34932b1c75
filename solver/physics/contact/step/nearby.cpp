#include "physics/contact/step/nearby.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {
namespace {

using Patch = ContactPatch;

/// A body meets itself where faces have come so much closer together than they were at rest; turning alone can make
/// the box around something larger by 1.73.
constexpr double kFolded = 2.0;

constexpr std::int64_t kSeveral = -1;  // groups, which have different laws

/// Square of the distance of two boxes, m2.
double gap_squared(const Patch& p, const Patch& q, std::size_t first) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double gap = std::max({0.0, q.low(first, i) - p.high(first, i), p.low(first, i) - q.high(first, i)});
    square += gap * gap;
  }
  return square;
}

double diagonal_of_both(const Patch& p, const Patch& q, std::size_t first) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = std::max(p.high(first, i), q.high(first, i)) - std::min(p.low(first, i), q.low(first, i));
    square += length * length;
  }
  return std::sqrt(square);
}

double relative_speed(const Patch& p, const Patch& q) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double v = std::max(p.high(Patch::velocity, i) - q.low(Patch::velocity, i),
                              q.high(Patch::velocity, i) - p.low(Patch::velocity, i));
    square += v * v;
  }
  return std::sqrt(square);
}

/// Whether two patches belong to different bodies, or to parts of one that can meet.
bool apart(const Patch& p, const Patch& q) {
  if (p.body != q.body) return true;
  if (p.largest[Patch::torn] > 0 || q.largest[Patch::torn] > 0) return true;
  return diagonal_of_both(p, q, Patch::reference_box) > kFolded * diagonal_of_both(p, q, Patch::box);
}

bool may_meet(const ContactParams& params, const Patch& p, const Patch& q, double time) {
  const auto felt = [&](const Patch& points, const Patch& other) {
    return points.largest[Patch::weight] > 0 &&
           params.law(static_cast<Index>(points.group), static_cast<Index>(other.group)).active();
  };
  if (!felt(p, q) && !felt(q, p)) return false;
  const double reach =
      kSpeedMargin * relative_speed(p, q) * time + kSizeMargin * std::min(p.face_size(), q.face_size());
  return gap_squared(p, q, Patch::box) <= reach * reach && apart(p, q);
}

/// Boxes that overlap where patches may meet: grown by their speeds against one that all share, and half the margin of
/// their size, as two halves are no less than the smaller whole.
std::vector<PatchTree::Box> grown_boxes(std::span<const Patch> patches, double time) {
  Patch all = patches.front();
  for (const Patch& p : patches) {
    for (std::size_t k = Patch::velocity; k < Patch::velocity + 6; ++k) all.raise(k, p.largest[k]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double middle = 0.5 * (all.low(Patch::velocity, i) + all.high(Patch::velocity, i));
    all.largest[Patch::velocity + i] = -middle;
    all.largest[Patch::velocity + 3 + i] = middle;
  }
  std::vector<PatchTree::Box> boxes;
  boxes.reserve(patches.size());
  for (const Patch& p : patches) {
    const double grown = 1.001 * (kSpeedMargin * relative_speed(p, all) * time + 0.5 * kSizeMargin * p.face_size());
    PatchTree::Box& box = boxes.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      box.low[i] = p.low(Patch::box, i) - grown;
      box.high[i] = p.high(Patch::box, i) + grown;
    }
  }
  return boxes;
}

/// What holds for both.
Patch joined(Patch p, const Patch& q) {
  p.raise_all(q);
  if (p.group != q.group) p.group = kSeveral;
  return p;
}

/// One a group.
std::vector<Patch> joined_by_group(std::span<const Patch> patches) {
  std::vector<Patch> groups;
  for (const Patch& p : patches) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Patch& g) { return g.group == p.group; });
    if (same == groups.end())
      groups.push_back(p);
    else
      same->raise_all(p);
  }
  std::sort(groups.begin(), groups.end(), [](const Patch& p, const Patch& q) { return p.group < q.group; });
  return groups;
}

}  // namespace

PatchesNearby::Tree::Tree(std::span<const Patch> patches, double time)
    : boxes(grown_boxes(patches, time)),
      tree(boxes),
      largest(tree.by_node<Patch>([&](std::int32_t i) { return patches[static_cast<std::size_t>(i)]; }, joined)) {}

PatchesNearby::PatchesNearby(const ContactParams& params, std::span<const Patch> patches, double time)
    : params_(params), patches_(patches), time_(time), of_groups_(joined_by_group(patches)) {}

std::vector<ContactBound> PatchesNearby::bounds_anywhere(const Patch& patch) const {
  std::vector<ContactBound> found;
  for (const Patch& group : of_groups_) add_bounds(contact_bounds(params_, patch, group), found);
  return found;
}

std::vector<ContactBound> PatchesNearby::bounds(std::size_t p) {
  if (!tree_) tree_ = std::make_unique<Tree>(patches_, time_);
  const Patch& mine = patches_[p];
  std::vector<ContactBound> found;
  const auto adds_nothing = [&](const Patch& other) {
    return !found.empty() && other.group != kSeveral && dominated(contact_bounds(params_, mine, other), found);
  };
  tree_->tree.query(
      tree_->boxes[p], [&](std::size_t node) { return adds_nothing(tree_->largest[node]); },
      [&](std::int32_t place) {
        const Patch& other = patches_[static_cast<std::size_t>(place)];
        if (!adds_nothing(other) && may_meet(params_, mine, other, time_))
          add_bounds(contact_bounds(params_, mine, other), found);
      });
  return found;
}

}  // namespace breccia
