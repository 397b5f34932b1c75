#include "domains/balance.hpp"

#include <gtest/gtest.h>

#include "contact/search_params.hpp"
#include "model/model.hpp"
#include "mpi/world.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::balance_test {
namespace {

using test::world;

/// Every rank has the same model; the root's core is twice as fast as the others.
class UnequalCores : public testing::Test {
 protected:
  UnequalCores() { domain_.connect(world(), {}, ExchangeKind::non_blocking); }
  ~UnequalCores() override { conclude(domain_); }
  void work(double seconds) { domain_.timer.add(Phase::sweep, seconds); }
  [[nodiscard]] double weight() const { return balance_.weights(domain_).at(0); }

  const case_::Case input_ = case_::read_text(case_::minimal);
  const Model model_ = build_model(input_);
  Domain domain_{model_, search_params(input_, model_)};
  Balance balance_;
  const double seconds_ = world().is_root() ? 1 : 2;
  const double slowest_ = world().size() == 1 ? 1 : 2;
  const double mean_ = (2.0 * world().size() - 1) / world().size();  // s
};

TEST_F(UnequalCores, MakeElementsWeighMoreOnTheSlowOnes) {
  const double at_first = weight();
  for (int look = 0; look < 30; ++look) {
    work(seconds_);
    static_cast<void>(balance_.look(domain_));
    EXPECT_DOUBLE_EQ(balance_.imbalance(), slowest_ / mean_);
    EXPECT_DOUBLE_EQ(balance_.load(), seconds_ / mean_);
  }
  EXPECT_NEAR(weight(), at_first * seconds_ / mean_, 2e-3 * at_first);
}

TEST_F(UnequalCores, CostWhatOthersHaveWaitedForTheSlowestSinceTheDivision) {
  for (int look = 1; look < 4; ++look) {
    work(seconds_);
    EXPECT_DOUBLE_EQ(balance_.look(domain_), look * (slowest_ - mean_));
  }
  balance_.restart(domain_);
  work(seconds_);
  EXPECT_DOUBLE_EQ(balance_.look(domain_), slowest_ - mean_);
}

TEST_F(UnequalCores, CostNothingWhereEachIsTheSlowOneInTurn) {
  work(seconds_);
  static_cast<void>(balance_.look(domain_));
  work(3 - seconds_);
  EXPECT_DOUBLE_EQ(balance_.look(domain_), 0);
}

}  // namespace
}  // namespace breccia::balance_test
