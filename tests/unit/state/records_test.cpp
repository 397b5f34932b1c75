#include <gtest/gtest.h>
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "base/error.hpp"
#include "state/records.hpp"
#include "state/state.hpp"
#include "unit/state/sample_records.hpp"

namespace breccia::records_test {
namespace {

using test::cubes;
using test::marks;
using test::records_of;

/// Equal field by field.
void expect_equal(const Records& a, const Records& b) {
  std::map<std::string, std::vector<double>> numbers[2];
  for (const Records* records : {&a, &b}) {
    for_each_list(*records, [&](const char* list, const auto& entries) {
      for (const auto& entry : entries) {
        for_each_field(entry, [&](const auto& row, const auto& field) {
          for_each_scalar(field, [&](const auto& x) {
            numbers[records == &a ? 0 : 1][std::string(list) + "." + row.name].push_back(static_cast<double>(x));
          });
        });
      }
    });
  }
  EXPECT_EQ(numbers[0], numbers[1]);
}

/// A record whose numbers are all different from those of a new one and, as far as their types go, from each other.
template <class Record>
Record numbered(GlobalId element) {
  Record record{};
  int next = 3;
  for_each_field(record, [&](const auto&, auto& field) {
    for_each_scalar(field, [&](auto& x) {
      using Scalar = std::decay_t<decltype(x)>;
      if constexpr (std::is_same_v<Scalar, bool>) {
        x = !x;
      } else if constexpr (std::is_same_v<Scalar, double>) {
        x = 0.25 * next++;
      } else {
        x = static_cast<Scalar>(next++ % 120);
      }
    });
  });
  if constexpr (std::is_same_v<Record, ElementRecord>) {
    record.id = element;
  } else {
    record.element = element;
  }
  return record;
}

TEST(Records, ArriveWithEveryFieldOfTheTable) {
  Records sent;
  for_each_list(sent, [](const char*, auto& list) {
    using Record = typename std::decay_t<decltype(list)>::value_type;
    list = {numbered<Record>(5), numbered<Record>(7)};
  });
  Records arrived;
  unpack(pack(sent, std::vector<std::uint8_t>{1, 1}), arrived);
  expect_equal(arrived, sent);
}

/// Bytes of a record in memory that belong to no field: gaps between members, and indices that mean nothing elsewhere.
template <class Record>
std::size_t bytes_without_row() {
  return sizeof(Record) - packed_bytes<Record>();
}

TEST(FieldTable, HasARowForEveryMemberOfEveryRecord) {
  const auto gaps = [](std::size_t bytes) { return bytes; };
  EXPECT_EQ(bytes_without_row<ElementRecord>(), gaps(1 + 4));
  EXPECT_EQ(bytes_without_row<JointRecord>(), gaps(2 + 7) + 2 * sizeof(Index));  // slots of its sides
  EXPECT_EQ(bytes_without_row<ReleasedRecord>(), gaps(2) + sizeof(Index));       // slot of side a
  EXPECT_EQ(bytes_without_row<CoupleRecord>(), 2 * sizeof(Index));               // point and contactor
  EXPECT_EQ(bytes_without_row<OffsetRecord>(), 0U);
  EXPECT_EQ(bytes_without_row<HoldRecord>(), gaps(2));
  EXPECT_EQ(bytes_without_row<FaceTag>(), 0U);
  EXPECT_EQ(bytes_without_row<CornerTag>(), gaps(3));
}

template <class Record>
void expect_unique_names() {
  std::set<std::string> names;
  Record record{};
  for_each_field(record, [&](const auto& row, const auto&) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_NE(std::string(row.unit), "") << row.name;
  });
}

TEST(FieldTable, NamesEveryFieldOnceAndGivesItsUnit) {
  Records records;
  for_each_list(records, [](const char*, auto& list) {
    expect_unique_names<typename std::decay_t<decltype(list)>::value_type>();
  });
  expect_unique_names<State>();
}

TEST(Records, SentAwayAndMergedAgainAreComplete) {
  const Mesh mesh = cubes();
  const Records all = records_of(mesh, build_topology(mesh));
  const auto odd = marks(all, [](GlobalId id) { return id % 2 != 0; });
  const auto even = marks(all, [](GlobalId id) { return id % 2 == 0; });
  Records back = all;
  keep(back, even);
  EXPECT_EQ(back.elements.size(), all.elements.size() / 2);
  Records arrivals;
  unpack(pack(all, odd), arrivals);
  merge(back, std::move(arrivals));
  expect_equal(back, all);
}

TEST(Records, ThatArriveWhereThereAreNoneAreAllThere) {
  const Mesh mesh = cubes();
  const Records all = records_of(mesh, build_topology(mesh));
  Records none;
  merge(none, all);
  expect_equal(none, all);
}

TEST(Records, RefuseBytesThatAreCutOff) {
  const Mesh mesh = cubes();
  const Records all = records_of(mesh, build_topology(mesh));
  std::vector<std::byte> bytes = pack(all, std::vector<std::uint8_t>(all.elements.size(), 1));
  bytes.resize(bytes.size() - 5);
  Records records;
  EXPECT_THROW(unpack(bytes, records), InternalError);
}

}  // namespace
}  // namespace breccia::records_test
