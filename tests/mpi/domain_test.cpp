#include <gtest/gtest.h>

#include <random>

#include "mpi/world.hpp"
#include "parallel/domain_topology.hpp"

namespace breccia::domain_test {
namespace {

struct Cloud {
  std::vector<Vec3> centroid;
  std::vector<double> weight;
};

/// Half of it in the planes of a lattice, as in regular meshes.
Cloud cloud(std::size_t elements) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(0.0, 10.0), weight(0.5, 1.5);
  Cloud c;
  for (std::size_t e = 0; e < elements; ++e) {
    Vec3 x(place(random), place(random), place(random));
    if (e % 2 == 0) x = x.array().floor();
    c.centroid.push_back(x);
    c.weight.push_back(weight(random));
  }
  return c;
}

class DomainsOverRanks : public testing::TestWithParam<DomainKind> {};

TEST_P(DomainsOverRanks, DoNotDependOnWhereTheElementsLie) {
  const Communicator& communicator = test::world();
  const Cloud all = cloud(3000);
  DomainSpec spec;
  spec.kind = GetParam();
  constexpr int kParts = 6;
  const std::vector<int> expected = assign_domains(Communicator(), spec, kParts, all.centroid, all.weight, 0.1);

  for (const bool scattered : {true, false}) {
    Cloud mine;
    std::vector<int> mine_expected;
    for (std::size_t e = 0; e < all.centroid.size(); ++e) {
      const int holder = scattered ? static_cast<int>(e * e) % communicator.size() : 0;
      if (holder != communicator.rank()) continue;
      mine.centroid.push_back(all.centroid[e]);
      mine.weight.push_back(all.weight[e]);
      mine_expected.push_back(expected[e]);
    }
    EXPECT_EQ(assign_domains(communicator, spec, kParts, mine.centroid, mine.weight, 0.1), mine_expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, DomainsOverRanks, testing::Values(DomainKind::grid, DomainKind::rcb),
                         [](const auto& kind) { return kind.param == DomainKind::grid ? "grid" : "rcb"; });

}  // namespace
}  // namespace breccia::domain_test
