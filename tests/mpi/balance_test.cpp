#include "simulation/balance.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "case/reader.hpp"
#include "mpi/world.hpp"
#include "simulation/convert.hpp"
#include "simulation/model.hpp"

namespace breccia {
namespace {

using test::world;

case_::Case one_cube() {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / ("breccia_balance_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << R"([mesh.raster]
cells = [1, 1, 1]
cell_size = "10 mm"
group = "box"
[[material]]
group = "box"
young = "1 GPa"
poisson = 0.2
density = 2000
joints = "none"
[[stage]]
name = "rest"
end = "1 ms"
)";
  case_::Case input = case_::read_case(file);
  std::filesystem::remove(file);
  return input;
}

/// Every rank has a cube; the root's core is twice as fast as the others.
class CubesOnUnequalCores : public testing::Test {
 protected:
  CubesOnUnequalCores() { stepper_.connect(world(), {}, ExchangeKind::non_blocking); }
  ~CubesOnUnequalCores() override { stepper_.conclude(); }
  void work() { stepper_.timer().add(Phase::sweep, seconds_); }
  [[nodiscard]] double weight() const { return balance_.weights(stepper_).at(0); }

  const case_::Case input_ = one_cube();
  const Model model_ = build_model(input_);
  Stepper stepper_{model_, search_params(input_, model_)};
  Balance balance_;
  const double seconds_ = world().is_root() ? 1 : 2;
  const double slowest_ = world().size() == 1 ? 1 : 2;
  const double mean_ = (2.0 * world().size() - 1) / world().size();  // s
};

TEST_F(CubesOnUnequalCores, WeighMoreOnTheSlowOnesOverTime) {
  const double at_first = weight();
  for (int look = 0; look < 10; ++look) {
    work();
    static_cast<void>(balance_.look(stepper_));
    EXPECT_DOUBLE_EQ(balance_.imbalance(), slowest_ / mean_);
    EXPECT_DOUBLE_EQ(balance_.load(), seconds_ / mean_);
  }
  EXPECT_NEAR(weight(), at_first * seconds_ / mean_, 2e-3 * at_first);
}

TEST_F(CubesOnUnequalCores, LoseWhatTheyWaitForTheSlowestUnlessItWasOneLookOnly) {
  work();
  EXPECT_EQ(balance_.look(stepper_), 0);
  work();
  EXPECT_DOUBLE_EQ(balance_.look(stepper_), (slowest_ - mean_) / Balance::kInterval);
}

}  // namespace
}  // namespace breccia
