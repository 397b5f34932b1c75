#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "contact/search_params.hpp"
#include "domains/decomposition.hpp"
#include "domains/state_records.hpp"
#include "model/model.hpp"
#include "mpi/world.hpp"
#include "simulation/step.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::division_test {
namespace {

using test::world;

constexpr std::size_t kElementsABox = 24;

/// 125 boxes of 24 elements each, all on the root.
class FlyingBoxes : public testing::Test {
 protected:
  FlyingBoxes() {
    if (!world().is_root()) return;
    const Model model = build_model(input_);
    mine_ = records_of(Domain(model, search_params(input_, model)));
  }

  void divide() {
    const Sizes sizes = sizes_of_all(world(), longest_edges(mine_));
    const Reach reach = reach_of(input_, sizes.mean, 0.0);
    DomainSpec domains = domain_spec(input_);
    const std::vector<double> weight(mine_.elements.size(), 1.0);
    Piece piece = decompose(world(), domains, std::move(mine_), weight, sizes, reach);
    keep(piece.records, piece.original);
    mine_ = std::move(piece.records);
  }
  /// Elements of each box that are here.
  [[nodiscard]] std::map<Index, std::size_t> here() const {
    std::map<Index, std::size_t> count;
    for (const ElementRecord& element : mine_.elements) ++count[element.body];
    return count;
  }

  const case_::Case input_ = case_::read_text(case_::minimal, {"mesh.raster.boxes=5", "mesh.raster.gap=5 mm"});
  Records mine_;
};

TEST_F(FlyingBoxes, StayWholeWhenTheModelIsDivided) {
  for (int division = 0; division < 3; ++division) {
    divide();
    for (const auto& [box, elements] : here())
      EXPECT_EQ(elements, kElementsABox) << "box " << box << ", division " << division;
    EXPECT_EQ(world().sum(static_cast<std::int64_t>(mine_.elements.size())), 125 * 24);
    // Four domains are two cuts, each of which may be off by a box.
    EXPECT_LE(world().max(static_cast<std::int64_t>(mine_.elements.size())), 125 * 24 / world().size() + 2 * 24);
    for (ElementRecord& element : mine_.elements) {  // apart along one axis, then together along another
      for (auto& x : element.position) x[static_cast<std::size_t>(division)] *= 1.0 + 0.3 * element.body / 125;
    }
  }
}

TEST_F(FlyingBoxes, MayBeCutWhereTheyBroke) {
  for (ElementRecord& element : mine_.elements) element.released = 0xF;
  divide();
  const auto boxes = here();
  const bool cut = std::any_of(boxes.begin(), boxes.end(), [](const auto& box) { return box.second != kElementsABox; });
  EXPECT_EQ(world().max(static_cast<std::int64_t>(cut)) != 0, world().size() > 1);
}

/// Every rank has the same model.
TEST(Signals, AreReceivedAStepAfterTheyAreSentWhetherTheModelIsDividedMeanwhileOrNot) {
  const case_::Case input = case_::read_text(case_::minimal);
  const Model model = build_model(input);
  Domain before(model, search_params(input, model));
  before.connect(world(), {}, ExchangeKind::non_blocking);
  begin_stage(before, {}, 1e-9);
  step(before, {.signals = {.broke = world().is_root(), .orders = 1}});
  step(before, {.signals = {.orders = 2}});
  EXPECT_EQ(before.state.signals.received.orders, 1);
  EXPECT_TRUE(before.state.signals.received.broke);

  const Records records = records_of(before);
  Domain after(model, search_params(input, model), records, close(before));
  after.connect(world(), {}, ExchangeKind::non_blocking);
  begin_stage(after, {}, 1e-9);
  EXPECT_EQ(after.state.signals.received.orders, 1);
  EXPECT_TRUE(after.state.signals.received.broke);
  step(after);
  EXPECT_EQ(after.state.signals.received.orders, 2);
  EXPECT_FALSE(after.state.signals.received.broke);
  conclude(after);
}

}  // namespace
}  // namespace breccia::division_test
