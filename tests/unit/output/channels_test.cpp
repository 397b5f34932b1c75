#include "output/insitu/channels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "case/insitu_fields.hpp"
#include "case/schema.hpp"

namespace breccia::channels_test {
namespace {

using testing::ElementsAre;

/// Two joints, the second broken.
Frame example() {
  Frame frame;
  frame.step = 7;
  frame.time = 0.5;
  for (int i = 0; i < 18; ++i) frame.joints.points.push_back(i);
  frame.joints.id = {4, 9};
  frame.joints.damage = {0.5, 1};
  frame.joints.mode = {1, 2};
  frame.joints.opening = {0.1, 0.2};
  frame.joints.slip = {0.3, 0.4};
  frame.joints.broken = {0, 1};
  frame.joints.time_of_failure = {-1, 0.25};
  frame.joints.state = {1, 3};
  frame.joints.energy = {0.5, 2};
  frame.elements.points.assign(12, 1.0);
  frame.elements.id = {3};
  return frame;
}

const BrecciaArray& array(const BrecciaGrid& grid, const char* name) {
  for (std::int32_t i = 0; i < grid.num_arrays; ++i) {
    if (std::strcmp(grid.arrays[i].name, name) == 0) return grid.arrays[i];
  }
  ADD_FAILURE() << "no array " << name;
  return grid.arrays[0];
}

const std::vector<std::string> kColumns{"step", "time [s]"};

TEST(Channels, PointIntoTheFrame) {
  const Frame frame = example();
  const Channels channels(frame, channel_mask({"elements", "joints"}), kColumns, {});
  const BrecciaGrid& elements = *channels.instant().channels[BRECCIA_ELEMENTS];
  EXPECT_EQ(elements.points, frame.elements.points.data());
  EXPECT_EQ(elements.num_points, 4);
  EXPECT_EQ(elements.num_cells, 1);
  EXPECT_EQ(array(elements, "id").values, frame.elements.id.data());
  const BrecciaGrid& joints = *channels.instant().channels[BRECCIA_JOINTS];
  EXPECT_EQ(joints.points, frame.joints.points.data());
  EXPECT_EQ(array(joints, "time_of_failure").values, frame.joints.time_of_failure.data());
}

TEST(Channels, HaveTheFieldsThatACaseMayAskForAndNoOthers) {
  Frame frame = example();
  for (const char* name : {"plastic_shear", "compaction", "plastic_work"}) {  // of the only law that remembers
    frame.elements.state.push_back({name, 1, {}});
    frame.surface.cells.state.push_back({name, 1, {}});
  }
  const std::uint32_t all = (1U << BRECCIA_NUM_CHANNELS) - 1;
  const Channels channels(frame, all, kColumns, {});
  const std::vector<std::string> choices = case_::key_of("insitu.pipeline[].fields").choice_list();
  std::set<std::string> seen;
  for (std::size_t i = 0; i < BRECCIA_HISTORY; ++i) {
    const BrecciaGrid& grid = *channels.instant().channels[i];
    std::vector<std::string> names;
    for (std::int32_t k = 0; k < grid.num_arrays; ++k) names.emplace_back(grid.arrays[k].name);
    EXPECT_THAT(case_::fields_of_channel(kChannelNames[i]), testing::UnorderedElementsAreArray(names))
        << kChannelNames[i];
    seen.insert(names.begin(), names.end());
  }
  EXPECT_THAT(choices, testing::UnorderedElementsAreArray(seen));
}

TEST(Channels, OfFracturesHoldTheBrokenJoints) {
  const Frame frame = example();
  const Channels channels(frame, channel_mask({"fractures"}), kColumns, {});
  const BrecciaGrid& fractures = *channels.instant().channels[BRECCIA_FRACTURES];
  ASSERT_EQ(fractures.num_cells, 1);
  EXPECT_EQ(fractures.points[0], 9.0);
  EXPECT_EQ(static_cast<const std::int64_t*>(array(fractures, "id").values)[0], 9);
  EXPECT_EQ(static_cast<const std::int32_t*>(array(fractures, "state").values)[0], 3);
  EXPECT_EQ(static_cast<const double*>(array(fractures, "slip").values)[0], 0.4);
}

TEST(Channels, ThatNobodyAsksForAreAbsent) {
  const Frame frame = example();
  const Channels channels(frame, channel_mask({"joints"}), kColumns, {});
  for (int c = 0; c < BRECCIA_NUM_CHANNELS; ++c)
    EXPECT_EQ(channels.instant().channels[c] != nullptr, c == BRECCIA_JOINTS)
        << kChannelNames[static_cast<std::size_t>(c)];
}

TEST(Channels, WithoutCellsHaveAllTheirArrays) {
  const Frame nothing, something = example();
  const std::uint32_t all = (1U << BRECCIA_NUM_CHANNELS) - 1;
  const Channels empty(nothing, all, kColumns, {}), full(something, all, kColumns, std::vector<double>{7, 0.5});
  for (int c = 0; c < BRECCIA_NUM_CHANNELS; ++c) {
    const BrecciaGrid &a = *empty.instant().channels[c], &b = *full.instant().channels[c];
    EXPECT_EQ(a.num_cells, 0);
    ASSERT_EQ(a.num_arrays, b.num_arrays);
    for (std::int32_t i = 0; i < a.num_arrays; ++i) {
      EXPECT_STREQ(a.arrays[i].name, b.arrays[i].name);
      EXPECT_EQ(a.arrays[i].type, b.arrays[i].type);
      EXPECT_EQ(a.arrays[i].components, b.arrays[i].components);
    }
  }
}

TEST(Channels, OfTheHistoryHaveARowOfItsColumns) {
  const Frame frame = example();
  const Channels channels(frame, channel_mask({"history"}), kColumns, std::vector<double>{7, 0.5});
  const BrecciaGrid& history = *channels.instant().channels[BRECCIA_HISTORY];
  EXPECT_EQ(history.cell, BRECCIA_TABLE);
  ASSERT_EQ(history.num_cells, 1);
  EXPECT_EQ(static_cast<const double*>(array(history, "time [s]").values)[0], 0.5);
}

TEST(Channels, NameThePartsOfTheFrameTheyNeed) {
  const FrameParts parts = parts_of(channel_mask({"fractures", "surface"}));
  EXPECT_TRUE(parts.joints && parts.surface);
  EXPECT_FALSE(parts.elements || parts.contacts || parts.domain);
  EXPECT_EQ(channel_mask({"elements", "history"}), 1U << BRECCIA_ELEMENTS | 1U << BRECCIA_HISTORY);
}

}  // namespace
}  // namespace breccia::channels_test
