#include "simulation/run_output.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "unit/observe/two_cubes.hpp"

namespace breccia::run_output_test {
namespace {

/// Counts the events of a kind.
class EventCount : public Sink {
 public:
  explicit EventCount(std::string kind) : kind_(std::move(kind)) {}
  void event(const RunEvent& event) override { count += event.kind == kind_ ? 1 : 0; }
  int count = 0;

 private:
  std::string kind_;
};

/// Cubes whose frames are asked for at some interval, with steps of 1e-8 s.
class RunOutputOfCubes : public testing::Test {
 protected:
  RunOutputOfCubes() {
    sinks_.push_back(std::make_unique<EventCount>("frames"));
    partition_.begin_stage(input_.stages[0]);
    partition_.domain().state.clock.dt = test::kCubeStep;
  }
  /// A run that begins so many stages. @param from  null: at its start
  int events_of_run(int stages, const RunPosition* from) {
    RunOutput output(input_, sinks_, partition_);
    output.tell_start(false, from);
    auto& events = dynamic_cast<EventCount&>(*sinks_[0]);
    events.count = 0;
    for (int stage = 0; stage < stages; ++stage) output.begin_stage(input_.stages[0]);
    return events.count;
  }

  case_::Case input_ = test::two_cubes("[output]\nframe_interval = 1e-9\n");
  std::vector<std::unique_ptr<Sink>> sinks_;
  Partition partition_{input_, {}, std::make_unique<Model>(build_model(input_))};
};

TEST_F(RunOutputOfCubes, SaysOnceARunThatEveryStepWritesAFrame) {
  EXPECT_EQ(events_of_run(2, nullptr), 1);
  const RunPosition position;
  EXPECT_EQ(events_of_run(2, &position), 0) << "a run that goes on has said so";
  input_.output.frame_interval = 1e-7;
  EXPECT_EQ(events_of_run(2, nullptr), 0);
}

TEST_F(RunOutputOfCubes, GoesOnFromTheJointsThatAreBrokenNotFromTheLastLineOfTheHistory) {
  RunOutput output(input_, sinks_, partition_);
  output.tell_start(false, nullptr);
  partition_.domain().state.joints.broken = 7;
  EXPECT_EQ(output.position().broken_joints, 7);
}

}  // namespace
}  // namespace breccia::run_output_test
