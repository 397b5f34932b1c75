#include "domains/partition.hpp"

#include <gtest/gtest.h>

#include <set>

#include "domains/state_records.hpp"
#include "mpi/world.hpp"
#include "simulation/step.hpp"
#include "support/raster_case.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::partition_test {
namespace {

using test::world;

/// Cubes of 24 elements that fly at each other and break.
case_::Case flying_cubes() {
  return case_::read_text(test::raster_case({.group = "cubes",
                                             .boxes = {2, 2, 2},
                                             .gap = 0.1e-3,
                                             .density = 2000,
                                             .penalty_factor = 10,
                                             .tensile_strength = 10e3,
                                             .energy_mode_1 = 0.01,
                                             .contact_penalty = 10e9,
                                             .contact_friction = 0.3}) +
                          R"(name = "flight"
[[initial_velocity]]
group = "cubes"
random = ["20 m/s", "40 m/s"]
seed = 3
)");
}

class PartitionOfCubes : public testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<Model> whole() const {
    return world().is_root() ? std::make_unique<Model>(build_model(input_)) : nullptr;
  }
  [[nodiscard]] Partition begun() const {
    Partition partition(input_, world(), whole());
    partition.begin_stage(input_.stages[0]);
    partition.domain().state.clock.dt = kStep;
    return partition;
  }
  static void take_steps(Partition& partition, int steps) {
    for (int i = 0; i < steps; ++i) {
      step(partition.domain());
      partition.keep_up();
    }
  }
  /// Of the whole model, at the end of its steps. Collective.
  static std::string hash(Partition& partition) {
    conclude(partition.domain());
    return hash_of(partition.domain()).text();
  }
  /// The hash of a run on one rank, on all ranks.
  [[nodiscard]] std::string hash_alone(int steps) const {
    std::string text;
    if (world().is_root()) {
      Partition alone(input_, Communicator(), whole());
      alone.begin_stage(input_.stages[0]);
      alone.domain().state.clock.dt = kStep;
      take_steps(alone, steps);
      text = hash(alone);
    }
    std::vector<std::byte> bytes;
    for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
    world().broadcast(bytes);
    text.clear();
    for (const std::byte b : bytes) text.push_back(std::to_integer<char>(b));
    return text;
  }

  static constexpr double kStep = 1e-7;  // s
  const case_::Case input_ = flying_cubes();
};

TEST_F(PartitionOfCubes, HoldsEveryElementOnce) {
  const Partition partition = begun();
  std::int64_t originals = 0;
  for (const std::uint8_t original : partition.model().local.original) originals += original;
  EXPECT_EQ(world().sum(originals), 8 * 24);
}

TEST_F(PartitionOfCubes, HasTheStableStepOfTheWholeModel) {
  Partition partition = begun();
  const StableStep step = partition.stable_step(100);
  double alone = 0, element = 0;
  if (world().is_root()) {
    Partition whole_model(input_, Communicator(), whole());
    whole_model.begin_stage(input_.stages[0]);
    const StableStep of_all = whole_model.stable_step(100);
    alone = of_all.step;
    element = static_cast<double>(of_all.element);
  }
  EXPECT_EQ(step.step, world().max(alone)) << "the same bits";
  EXPECT_EQ(static_cast<double>(step.element), world().max(element)) << "and what limits it";
}

TEST_F(PartitionOfCubes, FindsTheLengthOfTheStableStepAloneAsWell) {
  Partition partition = begun();
  for (int looks = 0; looks < 5; ++looks) {
    for (const double steps : {1.0, 100.0, 10000.0})
      EXPECT_EQ(partition.step_length(steps), partition.stable_step(steps).step) << steps;
    take_steps(partition, 80);
  }
  EXPECT_GT(world().sum(partition.state().joints.broken), 0);
}

TEST_F(PartitionOfCubes, FindsNoMoreThanThatTheStepLiesInTheGivenRangeAndOnlyWhereItDoes) {
  constexpr double kSteps = 100;
  Partition partition = begun();
  int spared = 0;
  for (int evaluations = 0; evaluations < 5; ++evaluations) {
    const double exact = partition.step_length(kSteps);
    for (const double low : {0.1, 0.5, 0.9, 0.999, 1.001, 1.1}) {
      for (const double high : {0.99, 0.999, 1.0, 1.001, 1.1, 2.0}) {
        if (low > high) continue;
        const StepRange range{low * exact, high * exact};
        const double found = partition.step_length(kSteps, range);
        if (found == exact) continue;
        ++spared;
        EXPECT_EQ(found, range.low);
        EXPECT_LE(range.low, exact);
        EXPECT_GE(range.high, exact);
      }
    }
    take_steps(partition, 80);
  }
  EXPECT_GT(spared, 0);
}

TEST_F(PartitionOfCubes, TakesTheStepsOfARankThatIsAlone) {
  constexpr int kSteps = 400;
  Partition partition = begun();
  take_steps(partition, kSteps);
  EXPECT_GT(world().sum(partition.state().joints.broken), 0);
  EXPECT_EQ(hash(partition), hash_alone(kSteps));
}

/// Each history that a rank holds costs it a message a step.
TEST_F(PartitionOfCubes, RemembersTheContactsThatItsForcesDependOn) {
  Partition partition = begun();
  std::int64_t of_others = 0;
  for (int i = 0; i < 400; ++i) {
    take_steps(partition, 1);
    if (!partition.domain().contact->searches().searched()) continue;  // divided anew
    const ContactState& contact = partition.state().contact;
    std::set<Index> coupled;
    for (const ContactCouple& couple : contact.couples) coupled.insert(couple.point);
    for (const TouchingCouple& couple : contact.touching) {
      const auto point = static_cast<std::size_t>(couple.point), contactor = static_cast<std::size_t>(couple.contactor);
      const bool here = contact.evaluated(contact.points[point].slot);
      of_others += !here;
      ASSERT_TRUE(here || contact.evaluated(contact.contactors[contactor]) || coupled.contains(couple.point));
    }
  }
  EXPECT_EQ(world().sum(of_others) > 0, world().size() > 1);
}

TEST_F(PartitionOfCubes, GoesOnFromASnapshotWithAnotherSearch) {
  constexpr int kBefore = 250, kAfter = 150;
  Partition first = begun();
  take_steps(first, kBefore);
  case_::Case other = input_;
  other.detection.algorithm = case_::DetectionAlgorithm::ms;
  Partition second(other, world(), first.snapshot());
  take_steps(second, kAfter);
  EXPECT_EQ(hash(second), hash_alone(kBefore + kAfter));
}

}  // namespace
}  // namespace breccia::partition_test
