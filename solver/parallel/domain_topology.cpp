#include "parallel/domain_topology.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "parallel/bisection.hpp"

namespace breccia {
namespace {

std::string text_of(const std::array<int, 3>& n) {
  return "[" + std::to_string(n[0]) + ", " + std::to_string(n[1]) + ", " + std::to_string(n[2]) + "]";
}

template <class Visit>
void for_each_factorisation(int parts, Visit&& visit) {
  for (int x = 1; x <= parts; ++x) {
    if (parts % x != 0) continue;
    for (int y = 1; y <= parts / x; ++y) {
      if (parts / x % y == 0) visit(std::array{x, y, parts / x / y});
    }
  }
}

/// Area of all planes between domains, m2.
double cut_area(const std::array<int, 3>& n, const std::array<double, 3>& edge) {
  return (n[0] - 1) * edge[1] * edge[2] + (n[1] - 1) * edge[2] * edge[0] + (n[2] - 1) * edge[0] * edge[1];
}

/// Differences below are round-off: the first of equals is taken.
constexpr double kSameArea = 1e-9;

/// Whether the given numbers agree; 0 agrees with everything.
bool agrees(const std::array<int, 3>& n, const std::array<int, 3>& asked) {
  return std::equal(n.begin(), n.end(), asked.begin(),
                    [](int given, int wanted) { return wanted == 0 || given == wanted; });
}

bool within(const std::array<int, 3>& n, const std::array<int, 3>& most) {
  return std::equal(n.begin(), n.end(), most.begin(), [](int given, int limit) { return given <= limit; });
}

DomainBox box_around(const Communicator& communicator, std::span<const Vec3> centroid) {
  std::array<double, 6> most;  // upper corner, negative lower corner
  most.fill(-std::numeric_limits<double>::infinity());
  for (const Vec3& x : centroid) {
    for (std::size_t i = 0; i < 3; ++i) {
      most[i] = std::max(most[i], x[static_cast<Eigen::Index>(i)]);
      most[3 + i] = std::max(most[3 + i], -x[static_cast<Eigen::Index>(i)]);
    }
  }
  communicator.max(most);
  return {{-most[3], -most[4], -most[5]}, {most[0], most[1], most[2]}};
}

std::vector<int> assign_grid(const std::array<int, 3>& n, const DomainBox& box, std::span<const Vec3> centroid) {
  std::vector<int> domain;
  domain.reserve(centroid.size());
  for (const Vec3& x : centroid) {
    std::array<int, 3> cell{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double edge = box.upper[i] - box.lower[i];
      const double share = edge > 0 ? (x[static_cast<Eigen::Index>(i)] - box.lower[i]) / edge : 0.0;
      cell[i] = static_cast<int>(std::clamp(share * n[i], 0.0, n[i] - 1.0));
    }
    domain.push_back((cell[2] * n[1] + cell[1]) * n[0] + cell[0]);
  }
  return domain;
}

}  // namespace

std::array<int, 3> grid_of(const DomainSpec& spec, int parts, const DomainBox& box, double longest_edge) {
  std::array<double, 3> edge{};
  std::array<int, 3> most{};
  for (std::size_t i = 0; i < 3; ++i) {
    edge[i] = box.upper[i] - box.lower[i] + longest_edge;  // the box is that of centroids
    most[i] = static_cast<int>(std::clamp(edge[i] / longest_edge, 1.0, 1e9));
  }
  std::optional<std::array<int, 3>> best;
  bool possible = false;
  std::string all;
  for_each_factorisation(parts, [&](const std::array<int, 3>& n) {
    all += (all.empty() ? "" : ", ") + text_of(n);
    if (!agrees(n, spec.n)) return;
    possible = true;
    if (!within(n, most)) return;
    if (!best || cut_area(n, edge) < (1 - kSameArea) * cut_area(*best, edge)) best = n;
  });
  if (best) return *best;
  if (!possible) {
    throw InputError(Problem{spec.file, spec.line, "domains.n",
                             "the grid does not have as many domains as there are ranks, " + std::to_string(parts), all,
                             text_of(spec.n)});
  }
  const std::string given = spec.n == std::array{0, 0, 0} ? std::to_string(parts) + " domains" : text_of(spec.n);
  throw InputError(Problem{spec.file, spec.line, "domains.n", "domains would be smaller than the largest element",
                           "at most " + text_of(most) + " domains along x, y and z", given});
}

DomainSpec settled(const Communicator& communicator, const DomainSpec& spec, int parts, std::span<const Vec3> centroid,
                   double longest_edge) {
  DomainSpec grid = spec;
  if (spec.kind != DomainKind::grid || spec.box) return grid;
  grid.box = box_around(communicator, centroid);
  grid.n = grid_of(spec, parts, *grid.box, longest_edge);
  return grid;
}

std::vector<int> assign_domains(const Communicator& communicator, const DomainSpec& spec, int parts,
                                std::span<const Vec3> centroid, std::span<const double> weight, double longest_edge) {
  const std::int64_t elements = communicator.sum(static_cast<std::int64_t>(centroid.size()));
  if (elements < parts) {
    throw InputError(Problem{spec.file, spec.line, "domains", "the model has fewer elements than there are ranks",
                             "at most " + std::to_string(elements) + " ranks", std::to_string(parts)});
  }
  if (parts == 1) return std::vector<int>(centroid.size(), 0);
  if (spec.kind == DomainKind::rcb) return bisect(communicator, parts, centroid, weight);
  if (spec.box) return assign_grid(spec.n, *spec.box, centroid);
  const DomainSpec grid = settled(communicator, spec, parts, centroid, longest_edge);
  return assign_grid(grid.n, *grid.box, centroid);
}

}  // namespace breccia
