#include <gtest/gtest.h>
#include <bit>
#include <set>

#include "mesh/raster.hpp"
#include "state/state_hash.hpp"

namespace breccia {
namespace {

struct Model {
  LocalMesh local;
  State state;

  explicit Model(Discretisation kind) {
    RasterSource source;
    source.cells = {2, 1, 1};
    local = build_local_mesh(make_raster(source).mesh, {kind}, {1000.0});
    state.position = local.reference;
    state.velocity.resize(local.reference.size());
    for (std::size_t i = 0; i < state.velocity.size(); ++i) state.velocity[i] = 3.0 * state.position[i];
  }
  [[nodiscard]] std::string hash(std::vector<double> damage = {}, std::vector<double> contact = {}) const {
    return hash_state(local, state, damage, contact).text();
  }
};

TEST(StateHash, IsSixteenHexadecimalDigitsOfItsValue) {
  StateHash hash;
  hash.add(1.5);
  EXPECT_EQ(hash.text().size(), 16U);
  EXPECT_EQ(std::stoull(hash.text(), nullptr, 16), hash.value());
}

TEST(StateHash, IsTheSameForTheSameStateWhateverItsLayout) {
  EXPECT_EQ(Model(Discretisation::own_nodes).hash(), Model(Discretisation::shared_nodes).hash());
}

TEST(StateHash, ChangesWithTheLastBitOfAnyNumber) {
  Model model(Discretisation::own_nodes);
  const std::string before = model.hash({0.5}, {0.25});
  for (Field<double>* field : {&model.state.position, &model.state.velocity}) {
    for (const Index e : {0, 13, 47}) {
      for (int c = 0; c < 4; ++c) {
        double& number =
            (*field)[nodal(model.local.corner_node(model.local.slot_of_element[static_cast<std::size_t>(e)], c), 1)];
        const double kept = number;
        number = std::bit_cast<double>(std::bit_cast<std::uint64_t>(kept) ^ 1);
        EXPECT_NE(model.hash({0.5}, {0.25}), before);
        number = kept;
      }
    }
  }
  EXPECT_EQ(model.hash({0.5}, {0.25}), before);
  EXPECT_NE(model.hash({0.75}, {0.25}), before);
  EXPECT_NE(model.hash({0.5}, {0.125}), before);
  EXPECT_NE(model.hash({0.5}, {}), before);
}

TEST(StateHash, DoesNotSeePadding) {
  Model model(Discretisation::own_nodes);
  const std::string before = model.hash();
  for (Index n = 0; n < model.local.num_nodes; ++n) {
    if (model.local.node_id[static_cast<std::size_t>(n)] < 0) store_node(model.state.position.data(), n, Vec3(1, 2, 3));
  }
  EXPECT_EQ(model.hash(), before);
}

TEST(StateHash, DependsOnTheOrderAndCountOfNumbers) {
  const auto of = [](std::vector<double> values) {
    StateHash hash;
    hash.add(values);
    return hash.value();
  };
  EXPECT_NE(of({1, 2}), of({2, 1}));
  EXPECT_NE(of({0}), of({0, 0}));
  EXPECT_NE(of({0.0}), of({-0.0}));
  EXPECT_EQ(of({1, 2}), of({1, 2}));
}

TEST(StateHash, SpreadsASingleBitOverHalfOfThem) {
  double flipped = 0;
  std::set<std::uint64_t> seen;
  const auto of = [](std::uint64_t word) {
    StateHash hash;
    hash.add(word);
    hash.add(std::uint64_t{77});
    return hash.value();
  };
  for (int bit = 0; bit < 64; ++bit) {
    const std::uint64_t changed = of(1ULL << bit);
    flipped += std::popcount(changed ^ of(0));
    seen.insert(changed);
  }
  EXPECT_EQ(seen.size(), 64U);
  EXPECT_NEAR(flipped / 64, 32, 2.5);  // five deviations of a mean of 64 binomials
}

}  // namespace
}  // namespace breccia
