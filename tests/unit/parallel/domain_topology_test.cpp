#include "parallel/domain_topology.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "base/error.hpp"

namespace breccia::domain_topology_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const Communicator alone;

DomainSpec grid(std::array<int, 3> n = {0, 0, 0}) { return {DomainKind::grid, n, "case.toml", 3, {}}; }

std::vector<Vec3> lattice(int nx, int ny, int nz) {
  std::vector<Vec3> points;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) points.emplace_back(x, y, z);
    }
  }
  return points;
}

std::vector<Vec3> random_points(std::size_t count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(2 * place(random), place(random), 3 * place(random));
  return points;
}

std::vector<int> bisected(int parts, const std::vector<Vec3>& points, const std::vector<double>& weight) {
  return assign_domains(alone, DomainSpec{}, parts, points, weight, 1e-3);
}

std::vector<double> weights_of_domains(const std::vector<int>& domain, const std::vector<double>& weight, int parts) {
  std::vector<double> sum(static_cast<std::size_t>(parts), 0.0);
  for (std::size_t e = 0; e < domain.size(); ++e) sum.at(static_cast<std::size_t>(domain[e])) += weight[e];
  return sum;
}

std::string message_of(const DomainSpec& spec, int parts, double longest_edge) {
  try {
    (void)grid_of(spec, parts, {{0, 0, 0}, {3, 2, 1}}, longest_edge);
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Grid, ChosenByItselfCutsTheLeastArea) {
  const double edge = 1e-3;
  const DomainBox box{{0, 0, 0}, {3 - edge, 2 - edge, 1 - edge}};  // of centroids; the elements fill 3 x 2 x 1
  for (const int parts : {2, 6, 8, 12, 60, 64, 97, 512}) {
    const auto area = [](double x, double y, double z) { return (x - 1) * 2 * 1 + (y - 1) * 3 * 1 + (z - 1) * 3 * 2; };
    double least = 1e300;
    for (int x = 1; x <= parts; ++x) {
      for (int y = 1; y <= parts; ++y) {
        const int z = parts / x / y;
        if (x * y * z == parts) least = std::min(least, area(x, y, z));
      }
    }
    const auto n = grid_of(grid(), parts, box, edge);
    EXPECT_EQ(n[0] * n[1] * n[2], parts);
    constexpr double kSame = 1e-9;  // relative: areas that differ by round-off are equal
    EXPECT_LE(area(n[0], n[1], n[2]), least * (1 + kSame)) << parts;
  }
}

TEST(Grid, IsTheOneAskedFor) {
  const DomainBox box{{0, 0, 0}, {3, 2, 1}};
  EXPECT_EQ(grid_of(grid({1, 1, 8}), 8, box, 0.01), (std::array{1, 1, 8}));
  EXPECT_EQ(grid_of(grid({0, 4, 0}), 4, box, 0.01), (std::array{1, 4, 1}));
}

TEST(Grid, OfAnotherNumberOfDomainsIsRefusedWithAllThatAreAllowed) {
  EXPECT_THAT(message_of(grid({2, 2, 1}), 3, 0.01),
              AllOf(HasSubstr("case.toml:3: domains.n: "),
                    HasSubstr("ranks, 3; allowed: [1, 1, 3], [1, 3, 1], [3, 1, 1]"), HasSubstr("given: [2, 2, 1]")));
}

TEST(Grid, OfDomainsSmallerThanAnElementIsRefusedWithTheLargestThatFits) {
  // Centroids fill 3 x 2 x 1 and elements half an edge more on every side: 3.5 x 2.5 x 1.5.
  EXPECT_THAT(message_of(grid({8, 1, 1}), 8, 0.5),
              AllOf(HasSubstr("at most [7, 5, 3]"), HasSubstr("given: [8, 1, 1]")));
  EXPECT_THAT(message_of(grid(), 11, 0.5), AllOf(HasSubstr("at most [7, 5, 3]"), HasSubstr("given: 11 domains")));
  EXPECT_EQ(message_of(grid({7, 1, 1}), 7, 0.5), "not refused");
}

TEST(Grid, GivesEachElementToTheCuboidItLiesIn) {
  std::vector<Vec3> points = random_points(2000);
  points.emplace_back(0, 0, 0);
  points.emplace_back(2, 1, 3);
  const std::vector<double> weight(points.size(), 1.0);
  const auto domain = assign_domains(alone, grid({4, 2, 3}), 24, points, weight, 0.1);
  for (std::size_t e = 0; e < points.size(); ++e) {
    const int x = domain[e] % 4, y = domain[e] / 4 % 2, z = domain[e] / 8;
    EXPECT_TRUE(points[e][0] >= 0.5 * x && points[e][0] <= 0.5 * (x + 1)) << points[e].transpose();
    EXPECT_TRUE(points[e][1] >= 0.5 * y && points[e][1] <= 0.5 * (y + 1)) << points[e].transpose();
    EXPECT_TRUE(points[e][2] >= 1.0 * z && points[e][2] <= 1.0 * (z + 1)) << points[e].transpose();
  }
}

TEST(Grid, OnceSettledStaysWhileElementsGatherInACorner) {
  std::vector<Vec3> points = lattice(4, 4, 4);
  const std::vector<double> weight(points.size(), 1.0);
  const DomainSpec spec = settled(alone, grid({2, 2, 2}), 8, points, 1.0);
  EXPECT_EQ(assign_domains(alone, spec, 8, points, weight, 1.0),
            assign_domains(alone, grid({2, 2, 2}), 8, points, weight, 1.0));
  for (Vec3& x : points) x *= 0.1;
  EXPECT_EQ(assign_domains(alone, spec, 8, points, weight, 1.0), std::vector<int>(points.size(), 0));
  for (Vec3& x : points) x += Vec3(100, -100, 1e30);
  EXPECT_EQ(assign_domains(alone, spec, 8, points, weight, 1.0), std::vector<int>(points.size(), 5));
}

TEST(Bisection, OfALatticeIntoEightGivesEightCubes) {
  const std::vector<Vec3> points = lattice(8, 8, 8);
  const auto domain = bisected(8, points, std::vector<double>(points.size(), 1.0));
  std::map<int, std::set<int>> octants;
  for (std::size_t e = 0; e < points.size(); ++e) {
    octants[domain[e]].insert((points[e][0] > 3.5) + 2 * (points[e][1] > 3.5) + 4 * (points[e][2] > 3.5));
  }
  EXPECT_EQ(octants.size(), 8U);
  for (const auto& [d, in] : octants) EXPECT_EQ(in.size(), 1U) << d;
}

TEST(Bisection, DividesElementsThatLieInOnePlane) {
  const std::vector<Vec3> points = lattice(10, 10, 10);
  const std::vector<double> weight(points.size(), 1.0);
  for (const int parts : {2, 3, 7, 16, 100}) {
    for (const double sum : weights_of_domains(bisected(parts, points, weight), weight, parts)) {
      const double one_a_level = std::ceil(std::log2(parts));  // each cut may round to the next element
      EXPECT_NEAR(sum, 1000.0 / parts, one_a_level) << parts;
    }
  }
}

TEST(Bisection, GivesAllDomainsTheSameWeight) {
  const std::vector<Vec3> points = random_points(20000);
  std::mt19937_64 random(5);
  std::exponential_distribution<double> cost(1.0);
  std::vector<double> weight;
  for (std::size_t e = 0; e < points.size(); ++e) weight.push_back(cost(random));
  const double total = std::accumulate(weight.begin(), weight.end(), 0.0),
               heaviest = *std::max_element(weight.begin(), weight.end());
  for (const int parts : {1, 2, 5, 64, 512}) {
    for (const double sum : weights_of_domains(bisected(parts, points, weight), weight, parts)) {
      // A cut is off by at most one element, half of which each further cut passes on.
      EXPECT_NEAR(sum, total / parts, 2 * heaviest) << parts;
    }
  }
}

TEST(Bisection, MovesOnlyAsManyElementsAsTheWeightAsksFor) {
  const std::vector<Vec3> points = lattice(400, 5, 5);
  std::vector<double> weight(points.size(), 1.0);
  const auto before = bisected(2, points, weight);
  for (std::size_t e = 0; e < points.size(); ++e) weight[e] = points[e][0] < 200 ? 1.1 : 1.0;
  const auto after = bisected(2, points, weight);
  int moved = 0;
  for (std::size_t e = 0; e < points.size(); ++e) moved += before[e] != after[e];
  // Half the weight, (0.55 + 0.5) / 2, is reached after 0.525 / 1.1 of the elements instead of 0.5.
  EXPECT_NEAR(moved, (0.5 - 0.525 / 1.1) * 10000, 1.0);
}

TEST(Domains, MoreThanElementsAreRefused) {
  const std::vector<Vec3> points = lattice(3, 1, 1);
  const std::vector<double> weight(3, 1.0);
  EXPECT_NO_THROW((void)bisected(3, points, weight));
  try {
    (void)bisected(4, points, weight);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("at most 3 ranks"));
  }
}

}  // namespace
}  // namespace breccia::domain_topology_test
