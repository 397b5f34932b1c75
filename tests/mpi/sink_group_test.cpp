#include "simulation/sink_group.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "mpi/world.hpp"

namespace breccia::sink_group_test {
namespace {

using test::world;

/// Writes frames together with those of other ranks; on the root its status file is full.
class FullSink : public Sink {
 public:
  void frame(const Frame&) override { (void)world().sum(std::int64_t{1}); }
  [[nodiscard]] bool status_due() const override { return world().is_root(); }
  void status(const StatusLine&) override { throw OutputError(Problem{"status.jsonl", 0, "", "is full", "", ""}); }
};

class OneSink : public testing::Test {
 protected:
  OneSink() { sinks_.push_back(std::make_unique<FullSink>()); }
  void tell_status() {
    group_.tell_status([] { return StatusLine{}; });
  }
  void tell_frame() {
    group_.tell([](Sink& sink) { sink.frame({}); });
  }

 private:
  std::vector<std::unique_ptr<Sink>> sinks_;
  SinkGroup group_{sinks_, world()};
};

TEST_F(OneSink, ThatCannotWriteItsStatusOnOneRankIsAnErrorOnAllBeforeAFrameIsBegun) {
  tell_status();
  EXPECT_THROW(tell_frame(), OutputError);
}

TEST_F(OneSink, TellsOfItsStatusOnce) {
  tell_status();
  EXPECT_THROW(tell_frame(), OutputError);
  EXPECT_NO_THROW(tell_frame()) << "the summary of a run that ends so can be written";
}

}  // namespace
}  // namespace breccia::sink_group_test
