#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <cmath>
#include <limits>

#include "peers.hpp"

namespace breccia::lab {
namespace {

/// The number of a body in the pointer that a leaf carries.
void* tag(std::size_t body) { return reinterpret_cast<void*>(body); }
std::size_t body_of(const btDbvtNode* leaf) { return reinterpret_cast<std::size_t>(leaf->data); }

template <class Take>
struct Policy : btDbvt::ICollide {
  explicit Policy(Take chosen) : take(chosen) {}
  void Process(const btDbvtNode* a, const btDbvtNode* b) override { take(body_of(a), body_of(b)); }
  void Process(const btDbvtNode* leaf) override { take(body_of(leaf), body_of(leaf)); }
  Take take;
};

class BulletCells final : public Contender {
 public:
  std::string name() const override { return "bullet_dbvt"; }
  /// As the broad phase uses its tree: leaves are put in once and moved afterwards.
  Tally detect(const Cells& cells) override {
    if (leaves_.size() != cells.size()) {
      tree_.clear();
      leaves_.clear();
      for (std::size_t i = 0; i < cells.size(); ++i) leaves_.push_back(tree_.insert(volume(cells[i]), tag(i)));
    } else {
      for (std::size_t i = 0; i < cells.size(); ++i) {
        btDbvtVolume moved = volume(cells[i]);
        if (moved.Mins() != leaves_[i]->volume.Mins()) tree_.update(leaves_[i], moved);
      }
    }
    Tally tally;
    Policy policy([&](std::size_t a, std::size_t b) { tally.add(a, b); });
    tree_.collideTT(tree_.m_root, tree_.m_root, policy);
    return tally;
  }
  std::size_t bytes() const override { return 2 * leaves_.size() * sizeof(btDbvtNode); }

 private:
  static btDbvtVolume volume(const BodyCell& cell) {
    const btVector3 low(static_cast<float>(cell[0]), static_cast<float>(cell[1]), static_cast<float>(cell[2]));
    return btDbvtVolume::FromMM(low, low + btVector3(1, 1, 1));
  }
  btDbvt tree_;
  std::vector<btDbvtNode*> leaves_;
};

class BulletPoints final : public PointContender {
 public:
  std::string name() const override { return "bullet_dbvt"; }
  Tally detect(const std::vector<Vec3>& points, const std::vector<detection::Corners>& contactors,
               double buffer) override {
    const auto tests = couple_tests(contactors, buffer);
    btDbvt tree;
    for (std::size_t c = 0; c < tests.size(); ++c) tree.insert(volume(tests[c].low(), tests[c].high()), tag(c));
    Tally tally;
    for (std::size_t p = 0; p < points.size(); ++p) {
      Policy policy([&](std::size_t c, std::size_t) {
        if (tests[c].holds(points[p])) tally.add(p, c);
      });
      tree.collideTV(tree.m_root, volume(points[p], points[p]), policy);
    }
    return tally;
  }

 private:
  /// Rounded outwards to single precision.
  static btDbvtVolume volume(const Vec3& low, const Vec3& high) {
    constexpr float far = std::numeric_limits<float>::max();
    const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -far); };
    const auto up = [](double x) { return std::nextafter(static_cast<float>(x), far); };
    return btDbvtVolume::FromMM({down(low[0]), down(low[1]), down(low[2])}, {up(high[0]), up(high[1]), up(high[2])});
  }
};

}  // namespace

void add_bullet(Contenders& searches, PointContenders& point_searches) {
  searches.push_back(std::make_unique<BulletCells>());
  point_searches.push_back(std::make_unique<BulletPoints>());
}

}  // namespace breccia::lab
