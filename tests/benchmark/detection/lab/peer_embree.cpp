#include <embree3/rtcore.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "peers.hpp"

namespace breccia::lab {
namespace {

/// Boxes of single precision, rounded outwards, as one scene of user geometry. One thread.
class BoxScene {
 public:
  using Bounds = std::vector<RTCBounds>;
  explicit BoxScene(RTCDevice device, Bounds bounds) : bounds_(std::move(bounds)), scene_(rtcNewScene(device)) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(bounds_.size()));
    rtcSetGeometryUserData(geometry, &bounds_);
    rtcSetGeometryBoundsFunction(
        geometry,
        [](const RTCBoundsFunctionArguments* of) {
          *of->bounds_o = (*static_cast<const Bounds*>(of->geometryUserPtr))[of->primID];
        },
        nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~BoxScene() { rtcReleaseScene(scene_); }
  BoxScene(const BoxScene&) = delete;
  BoxScene& operator=(const BoxScene&) = delete;

  /// take(i, j) for every pair whose boxes may meet, at least once; a scene against itself tells both (i, j) and (j,
  /// i).
  template <class Take>
  static void collide(const BoxScene& a, const BoxScene& b, Take take) {
    rtcCollide(
        a.scene_, b.scene_,
        [](void* user, RTCCollision* found, unsigned count) {
          for (unsigned k = 0; k < count; ++k) (*static_cast<Take*>(user))(found[k].primID0, found[k].primID1);
        },
        &take);
  }

 private:
  Bounds bounds_;
  RTCScene scene_;
};

class Device {
 public:
  Device() : device_(rtcNewDevice("threads=1")) {
    if (device_ == nullptr) throw std::runtime_error("Embree does not start");
  }
  ~Device() { rtcReleaseDevice(device_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  RTCDevice get() const { return device_; }

 private:
  RTCDevice device_;
};

RTCBounds outward(const Vec3& low, const Vec3& high) {
  constexpr float far = std::numeric_limits<float>::max();
  const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -far); };
  const auto up = [](double x) { return std::nextafter(static_cast<float>(x), far); };
  return {down(low[0]), down(low[1]), down(low[2]), 0, up(high[0]), up(high[1]), up(high[2]), 0};
}

class EmbreeCells final : public Contender {
 public:
  std::string name() const override { return "embree"; }
  Tally detect(const Cells& cells) override {
    std::vector<RTCBounds> bounds;
    for (const BodyCell& cell : cells) {
      const Vec3 low(cell[0], cell[1], cell[2]);
      bounds.push_back(outward(low, low + Vec3::Ones()));
    }
    const BoxScene scene(device_.get(), std::move(bounds));
    Tally tally;
    BoxScene::collide(scene, scene, [&](std::size_t i, std::size_t j) {
      if (i < j && touch(cells[i], cells[j])) tally.add(i, j);
    });
    return tally;
  }

 private:
  static bool touch(const BodyCell& a, const BodyCell& b) {
    return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
  }
  Device device_;
};

class EmbreePoints final : public PointContender {
 public:
  std::string name() const override { return "embree"; }
  Tally detect(const std::vector<Vec3>& points, const std::vector<detection::Corners>& contactors,
               double buffer) override {
    const auto tests = couple_tests(contactors, buffer);
    std::vector<RTCBounds> point_bounds, contactor_bounds;
    for (const Vec3& p : points) point_bounds.push_back(outward(p, p));
    for (const auto& test : tests) contactor_bounds.push_back(outward(test.low(), test.high()));
    const BoxScene point_scene(device_.get(), std::move(point_bounds));
    const BoxScene contactor_scene(device_.get(), std::move(contactor_bounds));
    Tally tally;
    BoxScene::collide(point_scene, contactor_scene, [&](std::size_t p, std::size_t c) {
      if (tests[c].holds(points[p])) tally.add(p, c);
    });
    return tally;
  }

 private:
  Device device_;
};

}  // namespace

void add_embree(Contenders& searches, PointContenders& point_searches) {
  searches.push_back(std::make_unique<EmbreeCells>());
  point_searches.push_back(std::make_unique<EmbreePoints>());
}

}  // namespace breccia::lab
