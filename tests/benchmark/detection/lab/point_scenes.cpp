#include "point_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <Eigen/Geometry>

#include "detection/point_body/curve_order.hpp"

namespace breccia::lab {
namespace {

/// Every second corner of the cube of edge 1 / sqrt(2): a regular tetrahedron of edge 1.
detection::Corners regular_tetrahedron(const Vec3& centre, const Eigen::Matrix3d& turn) {
  const double a = std::sqrt(0.125);
  return {centre + turn * Vec3(a, a, a), centre + turn * Vec3(-a, a, -a), centre + turn * Vec3(a, -a, -a),
          centre + turn * Vec3(-a, -a, a)};
}

void add_with_face_centres(Scene& scene, const detection::Corners& c) {
  scene.contactors.push_back(c);
  for (std::size_t a = 0; a < 4; ++a) scene.points.push_back((c[(a + 1) % 4] + c[(a + 2) % 4] + c[(a + 3) % 4]) / 3);
}

/// n^3 tetrahedra on a raster, each turned and moved at random by up to `shake` of the spacing, with their face
/// centres.
Scene raster(const std::string& name, int n, double spacing, double shake, double buffer) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  Scene scene{name, buffer, {}, {}};
  for (int k = 0; k < n * n * n; ++k) {
    Vec3 centre = spacing * Vec3(k % n, k / n % n, k / n / n);
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    if (shake > 0) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) centre[axis] += shake * spacing * coordinate(random);
      Eigen::Quaterniond q(coordinate(random), coordinate(random), coordinate(random), coordinate(random));
      turn = q.normalized().toRotationMatrix();
    }
    add_with_face_centres(scene, regular_tetrahedron(centre, turn));
  }
  return scene;
}

/// Block of n^3 unit cubes of 24 tetrahedra: every edge of a cube's face with the face's centre and the cube's.
/// On its surface alone every face is free, with three points; broken, all faces of all elements are.
Scene block(const std::string& name, int n, bool broken, double buffer) {
  Scene scene{name, buffer, {}, {}};
  const auto add_face = [&](const Vec3& centre, int axis, int side, bool free) {
    Vec3 normal = Vec3::Zero(), u = Vec3::Zero(), v = Vec3::Zero();
    normal[axis] = 0.5 * side;
    u[(axis + 1) % 3] = 0.5 * side;
    v[(axis + 2) % 3] = 0.5;
    const Vec3 middle = centre + normal;
    const std::array<Vec3, 4> ring{middle - u - v, middle + u - v, middle + u + v, middle - u + v};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 &f = ring[k], &g = ring[(k + 1) % 4];
      if (broken) add_with_face_centres(scene, {centre, f, g, middle});
      if (broken || !free) continue;
      scene.contactors.push_back({centre, f, g, middle});
      for (const Vec3& corner : {f, g, middle}) scene.points.push_back((f + g + middle) / 6 + corner / 2);
    }
  };
  for (int k = 0; k < n * n * n; ++k) {
    const std::array<int, 3> cube{k % n, k / n % n, k / n / n};
    const Vec3 centre(cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5);
    for (int axis = 0; axis < 3; ++axis) {
      add_face(centre, axis, -1, cube[static_cast<std::size_t>(axis)] == 0);
      add_face(centre, axis, 1, cube[static_cast<std::size_t>(axis)] == n - 1);
    }
  }
  return scene;
}

/// `n` regular tetrahedra, turned at random, of edges between 1 and 1 / ratio (evenly in the logarithm), in a cube in
/// which their bounding boxes, end to end, would fill the volume 1.2 times; contact points at the centres of their
/// faces.
Scene mixture(int n, double ratio) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<double> edges;
  double volume = 0;
  for (int k = 0; k < n; ++k) {
    edges.push_back(std::pow(ratio, -0.5 * (1 + coordinate(random))));
    volume += edges.back() * edges.back() * edges.back();
  }
  const double half_side = 0.5 * std::cbrt(0.6 * volume);  // boxes hold 0.72 edge^3 in the mean
  Scene scene{"sizes 1:" + std::to_string(static_cast<int>(ratio)), 0.02 / ratio, {}, {}};
  for (const double edge : edges) {
    Vec3 centre;
    for (double& c : centre) c = half_side * coordinate(random);
    const Eigen::Quaterniond q(coordinate(random), coordinate(random), coordinate(random), coordinate(random));
    add_with_face_centres(scene, regular_tetrahedron(centre, edge * q.normalized().toRotationMatrix()));
  }
  return scene;
}

/// The same tetrahedra and points numbered along a curve through space, as elements of a mesh are.
Scene in_order(const Scene& scene) {
  std::vector<Vec3> centres;
  for (const detection::Corners& c : scene.contactors) centres.push_back((c[0] + c[1] + c[2] + c[3]) / 4);
  Scene ordered{"in order, " + scene.name, scene.buffer, {}, {}};
  detection::CurveOrder order;
  for (const auto& record :
       order.sort(centres.size(), detection::frame_of(centres), [&](std::size_t c) { return centres[c]; })) {
    ordered.contactors.push_back(scene.contactors[record.number]);
    for (std::size_t a = 0; a < 4; ++a) ordered.points.push_back(scene.points[4 * record.number + a]);
  }
  return ordered;
}

}  // namespace

std::vector<PointScene> point_scenes(std::size_t largest) {
  const int n = static_cast<int>(std::min<std::size_t>(largest, 1'000'000));
  return {[] { return raster("raster of spaced regular tetrahedra", 20, 1.5, 0, 0.1); },
          [] { return raster("the same packed, turned and shaken", 20, 0.7, 0.3, 0.1); },
          [] { return block("solid block of 24,000, its surface", 10, false, 0.1); },
          [] { return block("the same block, every joint broken", 10, true, 0.05); },
          [n] { return mixture(n, 1); },
          [n] { return mixture(n, 10); },
          [n] { return mixture(n, 100); },
          [n] { return in_order(mixture(n, 1)); },
          [n] { return in_order(mixture(n, 10)); },
          [n] { return in_order(mixture(n, 100)); }};
}

}  // namespace breccia::lab
