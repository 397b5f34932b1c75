#include "run_folder/status.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace breccia::run_folder::status_test {
namespace {

TEST(StatusLine, SaysWhereTheRunStands) {
  const StatusLine line = parse_status_line(
      R"({"state":"running","stage":"s","step":7,"time":1e-6,"end":2e-6,"wall_s":3,"eta_s":null,"broken_joints":12})");
  ASSERT_TRUE(line.is_whole && line.status);
  EXPECT_FALSE(line.event);
  EXPECT_EQ(line.status->state, "running");
  EXPECT_EQ(line.status->stage, "s");
  EXPECT_EQ(line.status->step, 7);
  EXPECT_EQ(line.status->end, 2e-6);
  EXPECT_EQ(line.status->wall, 3);
  EXPECT_EQ(line.status->broken_joints, 12);
  EXPECT_TRUE(std::isnan(line.status->eta)) << "unknown";
  EXPECT_TRUE(std::isnan(line.status->imbalance)) << "not given";
}

TEST(StatusLine, IsAnEventAndNoStateWhereItTellsOfOne) {
  const StatusLine line = parse_status_line(
      R"({"event":"control","step":70,"time":2e-6,"accepted":false,"text":"disk full","id":"1.2","state":"running"})");
  ASSERT_TRUE(line.event);
  EXPECT_FALSE(line.status);
  EXPECT_EQ(line.event->kind, "control");
  EXPECT_EQ(line.event->text, "disk full");
  EXPECT_EQ(line.event->id, "1.2");
  EXPECT_EQ(line.event->accepted, false);
  EXPECT_EQ(line.event->step, 70);
  EXPECT_EQ(parse_status_line("{\"event\":\"insitu\"}").event->accepted, std::nullopt);
}

TEST(StatusLine, OfOtherThingsIsNeither) {
  for (const char* text : {"", "rubbish", "{\"state\":\"compl", "[]", "3"}) {
    const StatusLine line = parse_status_line(text);
    EXPECT_FALSE(line.is_whole || line.status || line.event) << text;
  }
  const StatusLine other = parse_status_line("{}");
  EXPECT_TRUE(other.is_whole);
  EXPECT_FALSE(other.status || other.event);
  EXPECT_FALSE(parse_status_line(std::string(100000, '{')).is_whole);
}

TEST(StatusLine, WithValuesOfOtherTypesThrowsNothing) {
  const StatusLine state = parse_status_line(R"({"state":[1],"step":"x","time":{},"wall_s":1e300})");
  ASSERT_TRUE(state.status);
  EXPECT_EQ(state.status->state, "");
  EXPECT_TRUE(std::isnan(state.status->step));
  const StatusLine event = parse_status_line(R"({"event":5,"id":7,"accepted":"yes","step":1e300,"text":null})");
  ASSERT_TRUE(event.event);
  EXPECT_EQ(event.event->step, 0) << "no step of a run";
  EXPECT_EQ(event.event->accepted, std::nullopt);
}

TEST(StatusLine, EndsARunInFourStates) {
  for (const char* state : {"complete", "stopped", "failed", "interrupted"}) EXPECT_TRUE(is_end(state));
  for (const char* state : {"running", "paused", "", "unknown"}) EXPECT_FALSE(is_end(state));
}

}  // namespace
}  // namespace breccia::run_folder::status_test
