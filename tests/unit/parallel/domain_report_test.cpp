#include "parallel/domain_report.hpp"
#include "base/index.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "mesh/raster.hpp"

namespace breccia::domain_report_test {
namespace {

constexpr Index kJoints = -1, kNone = 0;

Mesh block(std::array<int, 3> cells) { return make_raster({.cells = cells}).mesh; }

int common_nodes(const Mesh& mesh, std::size_t a, std::size_t b) {
  int common = 0;
  for (const Index node : mesh.elements[a]) {
    common += static_cast<int>(std::count(mesh.elements[b].begin(), mesh.elements[b].end(), node));
  }
  return common;
}

/// Domain and all else by all against all.
std::vector<DomainLoad> brute_force(const Mesh& mesh, bool joints, const std::vector<int>& owner, int parts,
                                    const std::vector<double>& reach) {
  std::vector<DomainLoad> loads(static_cast<std::size_t>(parts));
  std::vector<std::array<Vec3, 2>> boxes(mesh.elements.size());
  for (std::size_t e = 0; e < boxes.size(); ++e) {
    boxes[e] = {mesh.nodes[at(mesh.elements[e][0])], mesh.nodes[at(mesh.elements[e][0])]};
    for (const Index node : mesh.elements[e]) {
      boxes[e][0] = boxes[e][0].cwiseMin(mesh.nodes[at(node)]);
      boxes[e][1] = boxes[e][1].cwiseMax(mesh.nodes[at(node)]);
    }
  }
  for (int d = 0; d < parts; ++d) {
    DomainLoad& load = loads[static_cast<std::size_t>(d)];
    Vec3 lower = Vec3::Constant(1e300), upper = -lower;
    for (std::size_t e = 0; e < owner.size(); ++e) {
      if (owner[e] != d) continue;
      ++load.elements;
      lower = lower.cwiseMin(boxes[e][0]);
      upper = upper.cwiseMax(boxes[e][1]);
      for (std::size_t o = 0; o < owner.size(); ++o) {
        if (o == e || common_nodes(mesh, e, o) != 3) continue;
        load.joints += joints && e < o;
        load.shared += joints && owner[o] != d;
        load.cut_faces += owner[o] != d;
      }
    }
    std::set<int> neighbours;
    for (std::size_t e = 0; e < owner.size(); ++e) {
      if (owner[e] == d) continue;
      load.held +=
          ((boxes[e][0] - upper).array() <= reach[e]).all() && ((lower - boxes[e][1]).array() <= reach[e]).all();
      bool gathered = false;
      for (std::size_t o = 0; o < owner.size() && !gathered; ++o) {
        gathered = owner[o] == d && common_nodes(mesh, e, o) >= (joints ? 3 : 1);
      }
      load.gathered += gathered;
      if (gathered) neighbours.insert(owner[e]);
    }
    load.neighbours = static_cast<int>(neighbours.size());
  }
  return loads;
}

class ReportOfScatteredDomains : public testing::TestWithParam<Index> {};

TEST_P(ReportOfScatteredDomains, CountsWhatAllAgainstAllCounts) {
  const Mesh mesh = block({3, 2, 2});
  constexpr int kParts = 5;
  std::mt19937_64 random(11);
  std::vector<int> owner;
  // Mostly by place, so that domains are parts of the block, but not all are neighbours.
  for (const auto& corners : mesh.elements) {
    const double x = mesh.nodes[at(corners[0])][0];
    owner.push_back(random() % 8 == 0 ? static_cast<int>(random() % 3)
                                      : std::min(kParts - 1, static_cast<int>(x * 1.8)));
  }
  std::vector<double> reach;
  for (std::size_t e = 0; e < owner.size(); ++e) reach.push_back(e % 3 == 0 ? 0.5 : 0.3);
  const auto expected = brute_force(mesh, GetParam() == kJoints, owner, kParts, reach);
  const std::vector<Index> node_sets(mesh.volume_groups.size(), GetParam());
  const DomainReport report = report_domains(mesh, build_topology(mesh), node_sets, owner, kParts, reach);
  ASSERT_EQ(report.domains.size(), expected.size());
  for (std::size_t d = 0; d < expected.size(); ++d) {
    EXPECT_EQ(report.domains[d].elements, expected[d].elements) << d;
    EXPECT_EQ(report.domains[d].joints, expected[d].joints) << d;
    EXPECT_EQ(report.domains[d].shared, expected[d].shared) << d;
    EXPECT_EQ(report.domains[d].cut_faces, expected[d].cut_faces) << d;
    EXPECT_EQ(report.domains[d].held, expected[d].held) << d;
    EXPECT_EQ(report.domains[d].gathered, expected[d].gathered) << d;
    EXPECT_EQ(report.domains[d].neighbours, expected[d].neighbours) << d;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, ReportOfScatteredDomains, testing::Values(kJoints, kNone),
                         [](const auto& kind) { return kind.param == kJoints ? "joints" : "shared_nodes"; });

/// Two cubes of 24 elements side by side, a domain each; a cube has (4 x 24 - 24) / 2 = 36 inner faces, they share
/// four.
TEST(DomainReport, OfTwoCubesIsThatOfAHandCalculation) {
  const Mesh mesh = block({2, 1, 1});
  std::vector<int> owner;
  for (const auto& corners : mesh.elements) {
    double x = 0;
    for (const Index node : corners) x += mesh.nodes[at(node)][0];
    owner.push_back(x / 4 > 1 ? 1 : 0);
  }
  const DomainReport report = report_domains(mesh, build_topology(mesh), std::vector<Index>{kJoints}, owner, 2,
                                             std::vector<double>(owner.size(), 0.0));
  EXPECT_EQ(report.domains[0].joints + report.domains[1].joints, 36 + 36 + 4);
  for (const DomainLoad& load : report.domains) {
    EXPECT_EQ(load.elements, 24);
    EXPECT_EQ(load.shared, 4);
    EXPECT_EQ(load.gathered, 4);
    EXPECT_EQ(load.bytes(), 4 * 192);
    EXPECT_EQ(load.neighbours, 1);
  }
  EXPECT_EQ(report.exchange_steps, 1);
  EXPECT_EQ(report.imbalance, 1.0);
  const double step = 24 * kSecondsAnElement + kSecondsAMessage + 4 * 192 / kBytesASecond;
  EXPECT_DOUBLE_EQ(report.efficiency, 24 * kSecondsAnElement / step);
}

TEST(DomainReport, OfTwoBondedCubesWithoutJointsInsideHasThoseOfTheBond) {
  Mesh mesh = block({2, 1, 1});
  mesh.volume_groups = {"left", "right"};
  std::vector<int> owner;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    double x = 0;
    for (const Index node : mesh.elements[e]) x += mesh.nodes[at(node)][0];
    mesh.element_group[e] = owner.emplace_back(x / 4 > 1 ? 1 : 0);
  }
  const DomainReport report = report_domains(mesh, build_topology(mesh), std::vector<Index>{0, 1}, owner, 2,
                                             std::vector<double>(owner.size(), 0.0));
  EXPECT_EQ(report.domains[0].joints + report.domains[1].joints, 4);
  for (const DomainLoad& load : report.domains) {
    EXPECT_EQ(load.shared, 4);
    EXPECT_EQ(load.gathered, 4);
  }
}

TEST(DomainReport, OfUnequalDomainsNamesTheLargestOverTheMean) {
  const Mesh mesh = block({2, 1, 1});
  std::vector<int> owner(mesh.elements.size(), 0);
  for (std::size_t e = 0; e < 12; ++e) owner[e] = 2;  // 36, 0 and 12 of 48 elements
  const DomainReport report = report_domains(mesh, build_topology(mesh), std::vector<Index>{kJoints}, owner, 3,
                                             std::vector<double>(owner.size(), 1.0));
  EXPECT_DOUBLE_EQ(report.imbalance, 36.0 / 16.0);
  EXPECT_EQ(report.domains[1].elements + report.domains[1].held + report.domains[1].neighbours, 0);
}

}  // namespace
}  // namespace breccia::domain_report_test
