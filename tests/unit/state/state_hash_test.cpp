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
  [[nodiscard]] std::string hash() const { return hash_elements(local, state).text(); }
};

TEST(StateHash, IsSixteenHexadecimalDigitsOfItsValue) {
  SequenceHash number;
  number.add(1.5);
  StateHash hash;
  hash.add(number);
  EXPECT_EQ(hash.text().size(), 16U);
  EXPECT_EQ(std::stoull(hash.text(), nullptr, 16), hash.value());
}

TEST(StateHash, IsTheSameForTheSameStateWhateverItsLayout) {
  EXPECT_EQ(Model(Discretisation::own_nodes).hash(), Model(Discretisation::shared_nodes).hash());
}

TEST(StateHash, ChangesWithTheLastBitOfAnyNumber) {
  Model model(Discretisation::own_nodes);
  const std::string before = model.hash();
  for (Field<double>* field : {&model.state.position, &model.state.velocity}) {
    for (const Index e : {0, 13, 47}) {
      for (int c = 0; c < 4; ++c) {
        double& number =
            (*field)[nodal(model.local.corner_node(model.local.slot_of_element[static_cast<std::size_t>(e)], c), 1)];
        const double kept = number;
        number = std::bit_cast<double>(std::bit_cast<std::uint64_t>(kept) ^ 1);
        EXPECT_NE(model.hash(), before);
        number = kept;
      }
    }
  }
  EXPECT_EQ(model.hash(), before);
}

TEST(StateHash, DoesNotSeePadding) {
  Model model(Discretisation::own_nodes);
  const std::string before = model.hash();
  for (Index n = 0; n < model.local.num_nodes; ++n) {
    if (model.local.node_id[static_cast<std::size_t>(n)] < 0) store_node(model.state.position.data(), n, Vec3(1, 2, 3));
  }
  EXPECT_EQ(model.hash(), before);
}

TEST(StateHash, OfTwoRanksAddsUpToThatOfOne) {
  const Model whole(Discretisation::own_nodes);
  RasterSource source;
  source.cells = {2, 1, 1};
  const Mesh mesh = make_raster(source).mesh;
  StateHash sum;
  for (const int rank : {0, 1}) {
    std::vector<std::uint8_t> original(mesh.elements.size());
    for (std::size_t e = 0; e < original.size(); ++e) original[e] = (e % 3 == 0) == (rank == 0) ? 1 : 0;
    Model part(Discretisation::own_nodes);
    part.local = build_local_mesh(mesh, {Discretisation::own_nodes}, {1000.0}, original);
    part.state.position = part.local.reference;
    part.state.velocity.resize(part.local.reference.size());
    for (std::size_t i = 0; i < part.state.velocity.size(); ++i) part.state.velocity[i] = 3.0 * part.state.position[i];
    EXPECT_NE(part.hash(), whole.hash());
    sum.add(hash_elements(part.local, part.state));
  }
  EXPECT_EQ(sum.text(), whole.hash());
}

TEST(SequenceHash, DependsOnTheOrderAndCountOfNumbers) {
  const auto of = [](std::vector<double> values) {
    SequenceHash hash;
    hash.add(values);
    return hash.value();
  };
  EXPECT_NE(of({1, 2}), of({2, 1}));
  EXPECT_NE(of({0}), of({0, 0}));
  EXPECT_NE(of({0.0}), of({-0.0}));
  EXPECT_EQ(of({1, 2}), of({1, 2}));
}

TEST(SequenceHash, SpreadsASingleBitOverHalfOfThem) {
  double flipped = 0;
  std::set<std::uint64_t> seen;
  const auto of = [](std::uint64_t word) {
    SequenceHash hash;
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
