/// Time of a contact search, ns a point and ns a couple, for every algorithm on scenes of contact in a run.
/// Usage: bench_detection [cell as a share of the contactors' box width, default 0: chosen by the algorithm]

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "detection/point_body/search.hpp"

namespace {

using breccia::Index;
using breccia::Vec3;
using breccia::detection::Algorithm;
using breccia::detection::Corners;
using breccia::detection::Couple;

struct Scene {
  std::string name;
  double buffer;
  std::vector<Vec3> points;
  std::vector<Corners> contactors;
};

/// Every second corner of the cube of edge 1 / sqrt(2): a regular tetrahedron of edge 1.
Corners regular_tetrahedron(const Vec3& centre, const Eigen::Matrix3d& turn) {
  const double a = std::sqrt(0.125);
  return {centre + turn * Vec3(a, a, a), centre + turn * Vec3(-a, a, -a), centre + turn * Vec3(a, -a, -a),
          centre + turn * Vec3(-a, -a, a)};
}

void add_with_face_centres(Scene& scene, const Corners& c) {
  scene.contactors.push_back(c);
  for (std::size_t a = 0; a < 4; ++a) scene.points.push_back((c[(a + 1) % 4] + c[(a + 2) % 4] + c[(a + 3) % 4]) / 3);
}

/// n^3 tetrahedra on a raster, each turned and moved at random by up to `shake` of the spacing, with their face centres.
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

/// Best of `repeats` searches, ns.
double best_time(breccia::detection::PointBodySearch& search, const Scene& scene, std::vector<Couple>& couples,
                 int repeats) {
  using Clock = std::chrono::steady_clock;
  double best = 1e300;
  for (int k = 0; k < repeats; ++k) {
    const auto start = Clock::now();
    search.search(scene.points, scene.contactors, scene.buffer, couples);
    best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
  return best;
}

void measure(const Scene& scene, double cell_share) {
  std::printf("%s: %zu points, %zu contactors, buffer %g\n", scene.name.c_str(), scene.points.size(),
              scene.contactors.size(), scene.buffer);
  Vec3 width = Vec3::Zero();
  for (const Corners& c : scene.contactors) {
    width += c[0].cwiseMax(c[1]).cwiseMax(c[2].cwiseMax(c[3])) - c[0].cwiseMin(c[1]).cwiseMin(c[2].cwiseMin(c[3]));
  }
  const double mean = width.sum() / 3 / static_cast<double>(scene.contactors.size()) + 2 * scene.buffer;
  constexpr std::array names{"ms", "ms_slices", "sorted_grid", "brute_force"};
  std::vector<Couple> reference;
  for (const Algorithm algorithm :
       {Algorithm::sorted_grid, Algorithm::ms, Algorithm::ms_slices, Algorithm::brute_force}) {
    const bool brute = algorithm == Algorithm::brute_force;
    if (brute && scene.points.size() > 50000) continue;
    const auto search = breccia::detection::make_search(algorithm, cell_share * mean);
    std::vector<Couple> couples;
    const double time = best_time(*search, scene, couples, brute ? 1 : 15);
    if (reference.empty()) reference = couples;
    std::printf("  %-12s %9.3f ms %9.1f ns/point %8.1f ns/couple  %zu couples%s\n",
                names[static_cast<std::size_t>(algorithm)], time * 1e-6,
                time / static_cast<double>(scene.points.size()), time / static_cast<double>(couples.size()),
                couples.size(), couples == reference ? "" : "  DIFFERENT LIST");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const double cell_share = argc > 1 ? std::atof(argv[1]) : 0;
  measure(raster("raster of spaced regular tetrahedra", 20, 1.5, 0, 0.1), cell_share);
  measure(raster("the same packed, turned and shaken", 20, 0.7, 0.3, 0.1), cell_share);
  measure(block("solid block of 24,000, its surface", 10, false, 0.1), cell_share);
  measure(block("the same block, every joint broken", 10, true, 0.05), cell_share);
}
