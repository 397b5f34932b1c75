#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "detection/point_body/search.hpp"

namespace breccia::detection::scenes {

struct Scene {
  std::vector<Vec3> points;
  std::vector<Corners> contactors;
};

using Random = std::mt19937_64;

inline Vec3 uniform_vector(Random& random, double low, double high) {
  std::uniform_real_distribution<double> coordinate(low, high);
  const double x = coordinate(random), y = coordinate(random);
  return {x, y, coordinate(random)};
}

/// Regular tetrahedron, positively oriented, edge length `edge`.
inline Corners regular_tetrahedron(const Vec3& centre, double edge) {
  const double a = edge / std::sqrt(8.0);
  return {centre + a * Vec3(1, 1, 1), centre + a * Vec3(-1, 1, -1), centre + a * Vec3(1, -1, -1),
          centre + a * Vec3(-1, -1, 1)};
}

/// Corners drawn in a cube of width `size`, positively oriented; any shape, slivers included.
inline Corners random_tetrahedron(Random& random, const Vec3& centre, double size) {
  Corners c;
  for (Vec3& corner : c) corner = centre + uniform_vector(random, -size / 2, size / 2);
  if ((c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]) < 0) std::swap(c[2], c[3]);
  return c;
}

/// Point with barycentric coordinates drawn at random: inside the tetrahedron up to round-off.
inline Vec3 random_point_in(Random& random, const Corners& c) {
  std::exponential_distribution<double> part(1);
  double weights[4], sum = 0;
  for (double& w : weights) sum += w = part(random);
  Vec3 p = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) p += weights[k] / sum * c[k];
  return p;
}

inline Vec3 face_centre(const Corners& c, std::size_t opposite) {
  return (c[(opposite + 1) % 4] + c[(opposite + 2) % 4] + c[(opposite + 3) % 4]) / 3;
}

/// Tetrahedra of sizes spread evenly over `orders` decades below 1, each with its face centres and a point inside, in a
/// cube of width `width` about `centre`.
inline Scene cloud(std::uint64_t seed, int count, double width, double orders, const Vec3& centre = Vec3::Zero()) {
  Random random(seed);
  std::uniform_real_distribution<double> decade(-orders, 0);
  Scene scene;
  for (int k = 0; k < count; ++k) {
    const double size = std::pow(10.0, decade(random));
    const Vec3 place = centre + uniform_vector(random, -width / 2, width / 2);
    scene.contactors.push_back(random_tetrahedron(random, place, size));
    for (std::size_t a = 0; a < 4; ++a) scene.points.push_back(face_centre(scene.contactors.back(), a));
    scene.points.push_back(random_point_in(random, scene.contactors.back()));
  }
  return scene;
}

/// n^3 regular tetrahedra of edge 1 on a raster, with their face centres.
inline Scene raster(int n, double spacing) {
  Scene scene;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        scene.contactors.push_back(regular_tetrahedron(spacing * Vec3(x, y, z), 1));
        for (std::size_t a = 0; a < 4; ++a) scene.points.push_back(face_centre(scene.contactors.back(), a));
      }
    }
  }
  return scene;
}

/// Name of an algorithm in a test's name.
inline std::string name_of(Algorithm algorithm) {
  constexpr std::array names{"ms", "ms_slices", "sorted_grid", "packed_tree", "brute_force"};
  return names[static_cast<std::size_t>(algorithm)];
}

}  // namespace breccia::detection::scenes
