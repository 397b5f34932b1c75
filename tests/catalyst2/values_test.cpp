// What an implementation is given against what the run's own frames and its history hold, which other code has written.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <sstream>

#include "catalyst2/catalyst_run.hpp"
#include "unit/output/hdf5_reader.hpp"

namespace breccia::test::values_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEveryMs =
    " --set 'insitu.pipeline=[{name=\"volume\", every_time=\"1 ms\", strict=true}, {name=\"joints\", "
    "every_time=\"1 ms\", strict=true}, {name=\"history\", every_steps=1, strict=true}]' ";

struct Field {
  const char* name;
  int components;
  enum Kind { integer, single, real } kind;  ///< in frames
};
/// In the order of the channels; without rank and cost, which are of the division among ranks and of the run's speed.
const std::vector<Field> kElements{
    {"id", 1, Field::integer},       {"body", 1, Field::integer},     {"material", 1, Field::integer},
    {"fragment", 1, Field::integer}, {"stress", 6, Field::single},    {"von_mises", 1, Field::single},
    {"principal", 3, Field::single}, {"velocity", 3, Field::single},  {"displacement", 3, Field::single},
    {"mass", 1, Field::real},        {"neighbour", 4, Field::integer}};
const std::vector<Field> kJoints{{"id", 1, Field::integer},
                                 {"damage", 1, Field::single},
                                 {"mode", 1, Field::integer},
                                 {"opening", 1, Field::single},
                                 {"slip", 1, Field::single},
                                 {"broken", 1, Field::integer},
                                 {"time_of_failure", 1, Field::single},
                                 {"state", 1, Field::integer},
                                 {"energy", 1, Field::single}};

using Values = std::vector<double>;

/// Values of a channel at a step, a row a cell, by the cells' ids: corners' places, then the fields. Frames have single
/// precision where `fields` says so.
std::map<double, Values> given(const std::vector<std::string>& lines, const std::string& channel,
                               const std::string& step, std::size_t corners, const std::vector<Field>& fields) {
  std::map<double, Values> rows;
  for (const std::string& line : lines) {
    std::istringstream words(line);
    std::string of, at;
    words >> of >> at;
    if (of != channel || at != step) continue;
    Values row;
    std::uint64_t bits = 0;
    words >> std::hex;
    for (std::size_t i = 0; i < 3 * corners; ++i) {
      words >> bits;
      row.push_back(std::bit_cast<double>(bits));
    }
    for (const Field& field : fields) {
      for (int i = 0; i < field.components; ++i) {
        words >> bits;
        const auto value = std::bit_cast<double>(bits);
        row.push_back(field.kind == Field::integer  ? static_cast<double>(static_cast<std::int64_t>(bits))
                      : field.kind == Field::single ? static_cast<double>(static_cast<float>(value))
                                                    : value);
      }
    }
    EXPECT_FALSE(words.fail()) << line;
    std::string more;
    EXPECT_FALSE(words >> more) << line << ": has more than is known of the channel";
    EXPECT_TRUE(rows.emplace(row[3 * corners], row).second) << channel << " has the id twice: " << line;
  }
  return rows;
}

std::map<double, Values> in_frame(const Hdf5Reader& frame, std::size_t corners, const std::vector<Field>& fields) {
  const Values points = frame.values("Points");
  std::vector<Values> arrays;
  for (const Field& field : fields) arrays.push_back(frame.values(std::string("CellData/") + field.name));
  std::map<double, Values> rows;
  for (std::size_t cell = 0; cell < arrays[0].size(); ++cell) {
    const auto part = [cell](const Values& values, std::size_t n) {
      const auto from = values.begin() + static_cast<std::ptrdiff_t>(n * cell);
      return Values(from, from + static_cast<std::ptrdiff_t>(n));
    };
    Values row = part(points, 3 * corners);
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const Values values = part(arrays[f], static_cast<std::size_t>(fields[f].components));
      row.insert(row.end(), values.begin(), values.end());
    }
    rows.emplace(arrays[0][cell], row);
  }
  return rows;
}

class Catalyst2Values : public testing::TestWithParam<int> {};

TEST_P(Catalyst2Values, OfAllCellsAreThoseOfTheFramesThatTheRunWrites) {
  const CatalystRun run(GetParam(), kBackend + kEveryMs);
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const std::vector<std::string> lines = run.cells();
  std::size_t cells = 0, joints = 0, frames = 0;
  for (const auto& entry : fs::directory_iterator(run.folder() / "frames")) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(".vtkhdf")) continue;
    const Hdf5Reader frame(entry.path());
    const std::string step = std::to_string(static_cast<std::int64_t>(frame.values("FieldData/step").at(0)));
    SCOPED_TRACE(file + " of step " + step);
    if (file.starts_with("elements")) {
      const auto expected = in_frame(frame, 4, kElements);
      EXPECT_EQ(given(lines, "elements", step, 4, kElements), expected);
      cells += expected.size();
      ++frames;
    }
    if (file.starts_with("joints")) {
      const auto expected = in_frame(frame, 3, kJoints);
      EXPECT_EQ(given(lines, "joints", step, 3, kJoints), expected);
      joints += expected.size();
    }
  }
  EXPECT_GE(frames, 5U) << "0, 1, ... 4 ms";
  EXPECT_EQ(cells, frames * run.summary()["elements"].get<std::size_t>());
  EXPECT_GT(joints, 0U);
}

INSTANTIATE_TEST_SUITE_P(OfRanks, Catalyst2Values, testing::Values(1, 2, 3), testing::PrintToStringParamName());

TEST(Catalyst2ValuesAlone, AreViewsOfTheMemoryThatTheSolverHasHandedOver) {
  const Scratch scratch;
  const fs::path seen = scratch.path("seen");
  const CatalystRun run(1,
                        kBackend +
                            " --set 'insitu.pipeline=[{name=\"volume\", every_time=\"1 ms\", strict=true}, "
                            "{name=\"surface\", every_time=\"1 ms\", strict=true}, {name=\"fractures\", "
                            "every_time=\"1 ms\", strict=true}, {name=\"joints\", every_time=\"1 ms\", "
                            "strict=true}, {name=\"domains\", every_time=\"1 ms\", strict=true}, "
                            "{name=\"history\", every_time=\"1 ms\", strict=true}]' ",
                        std::string("BRECCIA_CATALYST2='") + BRECCIA_WITNESS + "' WITNESSED='" + BRECCIA_ADAPTOR +
                            "' WITNESS_FILE='" + seen.string() + "'");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  std::map<std::string, int> views;
  std::istringstream lines(read_text(seen));
  std::string channel;
  for (int same = 0, other = 0; lines >> channel >> same >> other;) {
    views[channel] += same;
    EXPECT_EQ(other, 0) << channel << ": copies";
  }
  for (const char* name : {"elements", "surface", "fractures", "joints", "domains", "history"})
    EXPECT_GT(views[name], 0) << name;
}

TEST(Catalyst2ValuesAlone, OfARankThatOwnsNothingAreNoneAndAllOthersAreThere) {
  // Nothing is in the middle third.
  const std::string apart = kBackend + kEveryMs + "--set 'mesh.raster.gap=[\"60 mm\",\"0 mm\",\"0 mm\"]' ";
  const CatalystRun alone(1, apart), run(3, apart + "--set domains.kind=grid --set 'domains.n=[3,1,1]'");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.summary()["state_hash"], alone.summary()["state_hash"]);
  EXPECT_EQ(run.cells(), alone.cells());
  int empty = 0;
  for (int rank = 0; rank < 3; ++rank) {
    const std::vector<std::string> lines = run.cells_of_rank(rank);
    empty += std::none_of(lines.begin(), lines.end(), [](const std::string& l) { return l.starts_with("elements"); });
  }
  EXPECT_GT(empty, 0) << "the case has no rank without elements";
}

}  // namespace
}  // namespace breccia::test::values_test
