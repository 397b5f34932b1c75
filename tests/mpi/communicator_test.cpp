#include "parallel/communicator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <new>
#include <numeric>
#include <stdexcept>

#include "base/error.hpp"
#include "mpi/world.hpp"
#include "parallel/mpi_handle.hpp"

namespace breccia::communicator_test {
namespace {

using test::world;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Parcel = Communicator::Parcel;

int last() { return world().size() - 1; }

/// A number that only this pair of ranks has.
std::int64_t number_of(int from, int to) { return 1000 * (from + 1) + to; }

std::vector<std::byte> bytes_of(std::size_t length, int seed) {
  std::vector<std::byte> bytes(length);
  for (std::size_t i = 0; i < length; ++i) {
    bytes[i] = static_cast<std::byte>((i * 7 + i / 251 + static_cast<std::size_t>(seed)) % 256);
  }
  return bytes;
}

/// Makes messages short, so that ordinary ones go in several pieces.
class ShortMessages {
 public:
  explicit ShortMessages(std::size_t bytes) {
    if (world().handle()) world().handle()->largest_message = bytes;
  }
  ShortMessages(const ShortMessages&) = delete;
  ShortMessages& operator=(const ShortMessages&) = delete;
  ~ShortMessages() {
    if (world().handle()) world().handle()->largest_message = usual_;
  }

 private:
  std::size_t usual_ = world().handle() ? world().handle()->largest_message : 0;
};

TEST(Communicator, HasAsManyRanksAsWereStartedEachWithANumberOfItsOwn) {
  std::vector<std::int64_t> seen(static_cast<std::size_t>(world().size()), 0);
  seen.at(static_cast<std::size_t>(world().rank())) = 1;
  world().sum(seen);
  EXPECT_THAT(seen, Each(1));
  EXPECT_EQ(world().is_root(), world().rank() == 0);
}

TEST(Communicator, ReducesToSmallestLargestAndSum) {
  const int rank = world().rank(), ranks = world().size();
  EXPECT_EQ(world().min(rank + 0.5), 0.5);
  EXPECT_EQ(world().max(rank + 0.5), ranks - 0.5);
  EXPECT_EQ(world().max(-double{1} - rank), -1);
  EXPECT_EQ(world().max(std::int64_t{rank} - 10), ranks - 11);
  const std::int64_t large = std::int64_t{1} << 40;
  EXPECT_EQ(world().sum(large + rank), ranks * large + ranks * (ranks - 1) / 2);
}

TEST(Communicator, ReducesArraysElementByElement) {
  const int rank = world().rank(), ranks = world().size();
  std::vector<std::int64_t> counts{1, rank, -rank};
  world().sum(counts);
  EXPECT_THAT(counts, ElementsAre(ranks, ranks * (ranks - 1) / 2, -ranks * (ranks - 1) / 2));
  std::vector<double> values{double(rank), -double(rank)};
  world().max(values);
  EXPECT_THAT(values, ElementsAre(ranks - 1, 0));
}

TEST(Communicator, BroadcastsWhatTheRootHasAlsoInPiecesAndNothing) {
  constexpr std::size_t kPiece = 1000;
  const ShortMessages pieces(kPiece);
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, kPiece, 10 * kPiece + 3}) {
    std::vector<std::byte> bytes = bytes_of(world().is_root() ? length : 17, world().rank());
    world().broadcast(bytes);
    EXPECT_EQ(bytes, bytes_of(length, 0)) << length;
  }
}

TEST(Communicator, GathersListsOfDifferentLengthByRank) {
  std::vector<double> mine(static_cast<std::size_t>(world().rank()), world().rank() + 0.25);  // none of rank 0
  const auto all = world().all_gather(std::span<const double>(mine));
  ASSERT_EQ(all.size(), static_cast<std::size_t>(world().size()));
  for (int r = 0; r < world().size(); ++r) {
    EXPECT_EQ(all[static_cast<std::size_t>(r)], std::vector<double>(static_cast<std::size_t>(r), r + 0.25));
  }
}

TEST(Communicator, GathersListsThatAreLongerThanAMessage) {
  const ShortMessages pieces(100);
  for (const std::size_t step : {1U, 25U, 99U, 250U}) {
    const std::size_t length = step * static_cast<std::size_t>(last() - world().rank());  // none of the last rank
    const auto all = world().all_gather(std::span<const std::byte>(bytes_of(length, world().rank())));
    ASSERT_EQ(all.size(), static_cast<std::size_t>(world().size()));
    for (int r = 0; r < world().size(); ++r) {
      EXPECT_EQ(all[static_cast<std::size_t>(r)], bytes_of(step * static_cast<std::size_t>(last() - r), r))
          << step << ", rank " << r;
    }
  }
}

TEST(Communicator, ExchangesListsAndSendsNoEmptyOnes) {
  const int rank = world().rank();
  std::vector<Communicator::ListOf<double>> lists;
  for (int to = 0; to < world().size(); ++to)
    lists.push_back({to, std::vector<double>(static_cast<std::size_t>(to), rank + 0.5)});
  const auto received = world().exchange(lists);
  ASSERT_EQ(received.size(), static_cast<std::size_t>(rank == 0 ? 0 : world().size()));
  for (std::size_t from = 0; from < received.size(); ++from) {
    EXPECT_EQ(received[from].rank, static_cast<int>(from));
    EXPECT_EQ(received[from].entries,
              std::vector<double>(static_cast<std::size_t>(rank), static_cast<double>(from) + 0.5));
  }
}

/// What this rank gets when every rank sends a parcel of `length(from, to)` bytes, or none if negative.
void expect_exchanged(const std::function<int(int, int)>& length) {
  const int rank = world().rank();
  std::vector<Parcel> parcels;
  for (int to = last(); to >= 0; --to) {
    const int bytes = length(rank, to);
    if (bytes >= 0) {
      parcels.push_back({to, bytes_of(static_cast<std::size_t>(bytes), static_cast<int>(number_of(rank, to)))});
    }
  }
  const std::vector<Parcel> received = world().exchange(std::move(parcels));
  auto next = received.begin();
  for (int from = 0; from <= last(); ++from) {
    const int bytes = length(from, rank);
    if (bytes < 0) continue;
    ASSERT_NE(next, received.end());
    EXPECT_EQ(next->rank, from);
    EXPECT_EQ(next->bytes, bytes_of(static_cast<std::size_t>(bytes), static_cast<int>(number_of(from, rank))));
    ++next;
  }
  EXPECT_EQ(next, received.end());
}

TEST(Communicator, ExchangesParcelsAlsoEmptyOnesAndToOneself) {
  expect_exchanged([](int from, int to) { return 100 * from + to; });          // rank 0 sends itself an empty parcel
  expect_exchanged([](int from, int to) { return from == to ? 5 : -1; });      // to oneself only
  expect_exchanged([](int from, int to) { return to == 0 ? 3 * from : -1; });  // all to one
  expect_exchanged([](int from, int to) { return from < to ? 0 : -1; });
  expect_exchanged([](int, int) { return -1; });
}

TEST(Communicator, ExchangesParcelsLongerThanAMessage) {
  const ShortMessages pieces(64);
  expect_exchanged([](int from, int to) { return 64 * (from + to) + from % 2; });
}

TEST(Communicator, RefusesTwoParcelsForOneRank) {
  if (world().size() == 1) GTEST_SKIP() << "needs another rank";
  std::vector<Parcel> twice(2, Parcel{0, {}});
  EXPECT_THROW((void)world().exchange(std::move(twice)), InternalError);
}

// --- agree
// --------------------------------------------------------------------------------------------------------------

Problem problem_of(int rank, int number) {
  return {
      "case.toml", 10 + rank, "key", "what " + std::to_string(number), "allowed", "given by " + std::to_string(rank)};
}

std::vector<Problem> problems_of(int rank) { return {problem_of(rank, 1), problem_of(rank, 2)}; }

void expect_problems(const InputError& error, int rank) {
  ASSERT_EQ(error.problems().size(), 2u);
  EXPECT_EQ(error.problems()[0].text(), problem_of(rank, 1).text());
  EXPECT_EQ(error.problems()[1].text(), problem_of(rank, 2).text());
  EXPECT_EQ(error.problems()[1].line, 10 + rank);
}

std::string text_of(int rank) { return "from rank " + std::to_string(rank); }

enum class Thrown { nothing, input, output, simulation, internal, other };

/// What agree throws here when the ranks of `failing` throw what is given; checks that it is what the lowest threw.
template <class Throw>
Thrown agreed(const std::vector<int>& failing, Throw&& throw_of) {
  const int lowest = failing.empty() ? -1 : *std::min_element(failing.begin(), failing.end());
  try {
    world().agree([&] {
      if (std::find(failing.begin(), failing.end(), world().rank()) != failing.end()) throw_of(world().rank());
    });
  } catch (const OutputError& error) {
    expect_problems(error, lowest);
    return Thrown::output;
  } catch (const InputError& error) {
    expect_problems(error, lowest);
    return Thrown::input;
  } catch (const SimulationError& error) {
    EXPECT_EQ(error.what(), text_of(lowest));
    return Thrown::simulation;
  } catch (const InternalError& error) {
    EXPECT_EQ(error.what(), text_of(lowest));
    return Thrown::internal;
  } catch (...) {
    return Thrown::other;
  }
  return Thrown::nothing;
}

/// Groups of ranks that fail: the first, the last, the last two, all.
std::vector<std::vector<int>> failing_groups() {
  std::vector<int> all(static_cast<std::size_t>(world().size()));
  std::iota(all.begin(), all.end(), 0);
  return {{0}, {last()}, {last(), std::max(0, last() - 1)}, all};
}

TEST(Agree, ThrowsNothingWhenNoRankDoes) {
  int ran = 0;
  world().agree([&] { ++ran; });
  EXPECT_EQ(ran, 1);
}

TEST(Agree, ThrowsOnAllRanksWhatTheLowestThrewWithAllItSays) {
  for (const std::vector<int>& failing : failing_groups()) {
    EXPECT_EQ(agreed(failing, [](int rank) { throw InputError(problems_of(rank)); }), Thrown::input);
    EXPECT_EQ(agreed(failing, [](int rank) { throw OutputError(problems_of(rank)); }), Thrown::output);
    EXPECT_EQ(agreed(failing, [](int rank) { throw SimulationError(text_of(rank)); }), Thrown::simulation);
    EXPECT_EQ(agreed(failing, [](int rank) { throw InternalError(text_of(rank)); }), Thrown::internal);
  }
}

TEST(Agree, TakesTheTypeOfTheLowestRankWhenRanksDiffer) {
  if (world().size() == 1) GTEST_SKIP() << "needs another rank";
  const auto mixed = [](int rank) {
    if (rank == last()) throw InputError(problems_of(rank));
    throw SimulationError(text_of(rank));
  };
  EXPECT_EQ(agreed({last() - 1, last()}, mixed), Thrown::simulation);
}

TEST(Agree, TellsOfMemoryAndOfFilesThatCannotBeUsedInWords) {
  if (world().size() == 1) GTEST_SKIP() << "a rank that is alone throws the exception itself";
  const auto told = [](const auto& error) {
    try {
      world().agree([&] {
        if (world().is_root()) throw error;
      });
    } catch (const InputError& agreed) {
      return std::string(agreed.what());
    }
    return std::string();
  };
  EXPECT_THAT(told(std::bad_alloc()), HasSubstr("out of memory"));
  EXPECT_THAT(told(std::filesystem::filesystem_error("no such folder", std::error_code())),
              HasSubstr("no such folder"));
}

TEST(Agree, MakesInternalErrorsOfOtherExceptions) {
  if (world().size() == 1) GTEST_SKIP() << "a rank that is alone throws the exception itself";
  EXPECT_EQ(agreed({last()}, [](int rank) { throw std::runtime_error(text_of(rank)); }), Thrown::internal);
  EXPECT_THROW(world().agree([] {
    if (world().rank() == last()) throw 5;
  }),
               InternalError);
}

TEST(Agree, MayBeUsedWithinItself) {
  EXPECT_THROW(world().agree([] {
    world().agree([] {
      if (world().rank() == last()) throw SimulationError("inner");
    });
  }),
               SimulationError);
}

// --- pending reductions and long waits
// -----------------------------------------------------------------------------------------------

TEST(PendingReduction, GivesTheLargestOfEachValueOfThePostBefore) {
  const int rank = world().rank();
  PendingReduction reduction(world(), 2);
  for (int step = 0; step < 50; ++step) {
    reduction.begin(std::vector<double>{double(step + rank), double(step - rank)});
    EXPECT_EQ(world().sum(std::int64_t{1}), world().size()) << "other reductions may come between";
    const std::span<const double> all = reduction.finish();
    EXPECT_THAT(std::vector<double>(all.begin(), all.end()), ElementsAre(step + last(), step));
  }
}

TEST(PendingReduction, MayBeLeftUntaken) {
  {
    PendingReduction reduction(world(), 1);
    reduction.begin(std::vector<double>{1.0});
  }
  EXPECT_EQ(world().sum(std::int64_t{1}), world().size());
}

TEST(Waiting, PastThePatienceNamesRankAndPhaseThenFailsAndCanBeTakenUpAgain) {
  if (world().size() == 1) GTEST_SKIP() << "needs another rank";
  constexpr double kPatience = 0.2;  // s
  const Communicator aside(std::make_shared<Communicator::Handle>(world().handle()->comm));
  const double usual = world().handle()->patience;
  PendingReduction reduction(world(), 1);
  std::string error, told;
  if (world().is_root()) {
    aside.barrier();  // until the others have lost their patience
    reduction.begin(std::vector<double>{7.0});
  } else {
    world().set_patience(kPatience);
    world().set_phase("testing");
    reduction.begin(std::vector<double>{1.0});
    testing::internal::CaptureStderr();
    const auto start = std::chrono::steady_clock::now();
    try {
      (void)reduction.finish();
    } catch (const NoResponse& thrown) {
      error = thrown.what();
    }
    const double waited = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    told = testing::internal::GetCapturedStderr();  // which would take the words of a failed test along
    EXPECT_GE(waited, 2 * kPatience);
    EXPECT_LT(waited, usual) << "on a machine however busy";
    world().set_patience(usual);
    world().set_phase("");
    aside.barrier();
  }
  EXPECT_THAT(reduction.finish(), ElementsAre(7.0));
  if (world().is_root()) return;
  const std::string waits = "rank " + std::to_string(world().rank()) + " has waited";
  for (const std::string& text : {error, told}) {
    EXPECT_THAT(text, HasSubstr(waits));
    EXPECT_THAT(text, HasSubstr("for all others in phase \"testing\""));
  }
  EXPECT_EQ(told.find(waits), told.rfind(waits)) << "told more than once";
}

}  // namespace
}  // namespace breccia::communicator_test
