#include <gtest/gtest.h>
#include <pthread.h>

#include <cstddef>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "output/checkpoint/checkpoint.hpp"
#include "output/checkpoint/checkpoint_columns.hpp"
#include "output/checkpoint/checkpoint_index.hpp"
#include "output/checkpoint/checkpoint_ranks.hpp"
#include "output/checkpoint/checkpoint_writer.hpp"
#include "unit/output/hdf5_reader.hpp"
#include "unit/output/temporary_folder.hpp"
#include "unit/state/sample_records.hpp"
#include "unit/system/file_size_limit.hpp"

namespace breccia::checkpoint_test {
namespace {

/// Every number of the model and the position another one.
Checkpoint sample() {
  Checkpoint checkpoint;
  const Mesh mesh = test::cubes();
  checkpoint.mine = test::records_of(mesh, build_topology(mesh));
  double next = 0.5;
  const auto fill = [&](const auto&, auto& field) {
    using Value = std::decay_t<decltype(field)>;
    if constexpr (std::is_same_v<Value, ExactSum>) {
      field.add(++next);
    } else if constexpr (std::is_same_v<Value, std::vector<GlobalId>>) {
      field = {3, 1, 2};
    } else {
      for_each_scalar(field, [&](auto& x) { x = static_cast<std::remove_reference_t<decltype(x)>>(++next); });
    }
  };
  for_each_field(checkpoint.model, fill);
  for_each_field(checkpoint.position, fill);
  checkpoint.position.start_step = checkpoint.model.clock.steps - 1;
  checkpoint.whole_model = {std::byte{1}, std::byte{0}, std::byte{255}};
  checkpoint.case_text = "title = \"a case\"\n";
  checkpoint.provenance = "{}";
  return checkpoint;
}

std::vector<std::byte> all_bytes(Checkpoint& checkpoint) {
  std::vector<std::byte> all, bytes;
  for (const CheckpointColumn& column : checkpoint_columns(checkpoint)) {
    column.pack(bytes);
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  return all;
}

class CheckpointFile : public testing::Test {
 protected:
  CheckpointFile() : file_(checkpoint_file(folder_.path(), 12)) {
    CheckpointWriter writer(file_, sample(), {}, {});
    writer.finish();
  }
  std::string content() const {
    std::ifstream stream(file_, std::ios::binary);
    std::ostringstream all;
    all << stream.rdbuf();
    return all.str();
  }
  /// Puts another index behind the file, with the checksums that make it be read.
  void write_with_index(CheckpointIndex index) {
    constexpr std::size_t kRoom = 1 << 20;
    std::string file = content();
    index.size = file.size() + kRoom;
    std::string text = index_text(index);
    ASSERT_LE(text.size(), kRoom);
    text.resize(kRoom, ' ');
    const IndexedBytes place{file.size(), kRoom, checksum_of(std::as_bytes(std::span(text)))};
    const std::vector<std::byte> header = header_bytes(place, index.size);
    std::memcpy(file.data(), header.data(), header.size());
    std::ofstream(file_, std::ios::binary) << file << text;
  }
  test::TemporaryFolder folder_;
  std::filesystem::path file_;
};

TEST_F(CheckpointFile, WithAnIndexThatAsksForMoreWorkThanItHasBytesIsRefused) {
  const CheckpointIndex sound = read_index(file_);
  ASSERT_NO_FATAL_FAILURE(write_with_index(sound));
  EXPECT_NO_THROW((void)read_checkpoint(file_, {}));
  CheckpointIndex twice = sound;  // the same bytes as parts of the structure, again and again
  twice.structure.assign(5000, {0, 0, checksum_of({})});
  for (IndexedBytes& part : twice.structure) part.size = twice.size / 2;
  ASSERT_NO_FATAL_FAILURE(write_with_index(twice));
  EXPECT_THROW((void)read_index(file_), InputError);
  CheckpointIndex many = sound;  // one column of more ranks than the others, each of which would be looked for
  many.columns.back().rows.resize(10000, 0);
  many.columns.back().checksums.resize(10000, checksum_of({}));
  ASSERT_NO_FATAL_FAILURE(write_with_index(many));
  EXPECT_THROW((void)read_index(file_), InputError);
}

TEST_F(CheckpointFile, OfATimeOrStepThatNoRunComesToIsRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<std::function<void(Checkpoint&)>> faults{
      [](Checkpoint& c) { c.model.clock.time = -1; },
      [](Checkpoint& c) { c.model.clock.time = kNan; },
      [](Checkpoint& c) { c.model.clock.dt = 0; },
      [](Checkpoint& c) { c.model.clock.dt = kInfinity; },
      [](Checkpoint& c) { c.model.clock.dt_before = -1e-9; },
      [](Checkpoint& c) { c.model.clock.dt_earlier = kNan; },
      [](Checkpoint& c) { c.model.clock.steps = -7; },
      [](Checkpoint& c) { c.model.clock.steps = std::numeric_limits<std::int64_t>::max(); },
      [](Checkpoint& c) { c.position.start_time = -1; },
      [](Checkpoint& c) { c.position.start_step = c.model.clock.steps + 1; },
      [](Checkpoint& c) { c.position.start_step = std::numeric_limits<std::int64_t>::min(); }};
  for (std::size_t f = 0; f < faults.size(); ++f) {
    Checkpoint changed = sample();
    faults[f](changed);
    CheckpointWriter(file_, std::move(changed), {}, {}).finish();
    try {
      (void)read_checkpoint(file_, {});
      ADD_FAILURE() << f;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("this checkpoint is damaged"), std::string::npos) << error.what();
    }
  }
}

TEST_F(CheckpointFile, GivesBackEveryBitOfWhatWasWritten) {
  Checkpoint before = sample(), after = read_checkpoint(file_, {});
  EXPECT_EQ(all_bytes(after), all_bytes(before));
  EXPECT_EQ(after.mine.joints.size(), before.mine.joints.size());
  EXPECT_EQ(after.case_text, before.case_text);
}

TEST_F(CheckpointFile, GivesBackNumbersThatAreAllZeroWhereRecordsBeginWithOthers) {
  Checkpoint before = sample();
  std::vector<std::size_t> more;
  for (const NamedLength& list : lengths_of_lists(before.mine)) more.push_back(list.name == "element" ? 0 : 2);
  lengthen_lists(before.mine, more);
  for (const CheckpointColumn& column : checkpoint_columns(before)) {
    if (!column.of_list || column.group == "element") continue;
    column.unpack(std::vector<std::byte>(column.rows * column.row_size()), 0);
  }
  ASSERT_EQ(before.mine.joints[0].joint.time_of_failure, 0) << "a joint that has not failed has another number";
  CheckpointWriter writer(file_, before, {}, {});
  writer.finish();
  Checkpoint after = read_checkpoint(file_, {});
  EXPECT_EQ(all_bytes(after), all_bytes(before));
}

TEST_F(CheckpointFile, IsReadByHdf5UnderTheNamesOfTheTables) {
  const Checkpoint before = sample();
  const test::Hdf5Reader reader(file_, "checkpoint");
  EXPECT_EQ(reader.values("model/steps").at(0), static_cast<double>(before.model.clock.steps));
  const std::vector<double> position = reader.values("element/position");
  ASSERT_EQ(position.size(), 12 * before.mine.elements.size());
  EXPECT_EQ(position[3], before.mine.elements[0].position[1][0]);
  EXPECT_EQ(reader.values("joint/mode_1").at(1), before.mine.joints[1].joint.history.mode_1);
}

TEST_F(CheckpointFile, IsRefusedWithAnyByteChanged) {
  const std::string text = content();
  constexpr std::size_t kPlaces = 400;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    std::string changed = text;
    const std::size_t at = text.size() * i / kPlaces;
    changed[at] = static_cast<char>(changed[at] ^ (1 << i % 8));
    std::ofstream(file_, std::ios::binary) << changed;
    EXPECT_THROW((void)read_checkpoint(file_, {}), InputError) << at;
  }
}

TEST_F(CheckpointFile, IsRefusedWhenItIsCutOff) {
  for (const double share : {0.0, 0.001, 0.3, 0.999}) {
    std::filesystem::resize_file(
        file_, static_cast<std::uintmax_t>(share * static_cast<double>(std::filesystem::file_size(file_))));
    EXPECT_THROW((void)read_checkpoint(file_, {}), InputError) << share;
  }
  EXPECT_THROW((void)read_checkpoint(folder_.path() / "nothing.h5", {}), InputError);
  EXPECT_THROW((void)read_checkpoint(folder_.path(), {}), InputError);
}

TEST_F(CheckpointFile, AppearsOnlyWhenItIsFinished) {
  const auto later = checkpoint_file(folder_.path(), 13);
  { const CheckpointWriter abandoned(later, sample(), {}, {}); }
  EXPECT_EQ(checkpoints_in(folder_.path()).size(), 1U);
  EXPECT_THROW(CheckpointWriter(folder_.path() / "none/step.h5", sample(), {}, {}), OutputError);
}

TEST_F(CheckpointFile, LeavesNothingWhereTheDiskIsFullFromItsFirstBytesOn) {
  const auto later = checkpoint_file(folder_.path(), 13);
  for (const rlim_t bytes : {0, 64, 2000}) {
    const test::FileSizeLimit full(bytes);
    EXPECT_THROW(CheckpointWriter(later, sample(), {}, {}).finish(), OutputError) << bytes;
    EXPECT_EQ(test::names_in(folder_.path()).size(), 1U) << bytes << " bytes fit: only the file from before stays";
  }
}

TEST_F(CheckpointFile, IsWrittenWhereNoThreadIsToBeHad) {
  pthread_attr_t usual, larger_than_memory;
  ASSERT_EQ(::pthread_getattr_default_np(&usual), 0);
  ASSERT_EQ(::pthread_getattr_default_np(&larger_than_memory), 0);
  ASSERT_EQ(::pthread_attr_setstacksize(&larger_than_memory, std::size_t{1} << 47), 0);
  ASSERT_EQ(::pthread_setattr_default_np(&larger_than_memory), 0);
  EXPECT_THROW(std::thread([] {}).join(), std::system_error) << "nothing is shown: there is a thread";
  const auto later = checkpoint_file(folder_.path(), 13);
  EXPECT_NO_THROW(CheckpointWriter(later, sample(), {}, {}).finish());
  EXPECT_EQ(::pthread_setattr_default_np(&usual), 0);
  EXPECT_NO_THROW((void)read_checkpoint(later, {}));
}

/// Three ranks, as threads.
void on_three(const std::filesystem::path& file, std::uint64_t token, const std::function<void(FileRanks&)>& work) {
  std::vector<std::thread> threads;
  for (int rank = 0; rank < 3; ++rank) {
    threads.emplace_back([&, rank] {
      FileRanks ranks(rank, 3, file, token);
      work(ranks);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST_F(CheckpointFile, CanBeExchangedByRanksWithoutMpiWhichLeaveNothingBehind) {
  using Numbers = CheckpointRanks::Numbers;
  const auto later = checkpoint_file(folder_.path(), 13);
  std::ofstream(folder_.path() / ".step_000000000013.h5.1.0.tmp") << "left by a killed run";
  on_three(later, 17, [](FileRanks& ranks) {
    const auto rank = static_cast<std::uint64_t>(ranks.rank());
    EXPECT_EQ(ranks.all_gather(Numbers(rank, rank)), (std::vector<Numbers>{{}, {1}, {2, 2}}));
    EXPECT_NO_THROW(ranks.agree([] {}));
    try {
      ranks.agree([&] {
        if (rank == 1) throw OutputError(Problem{"f", 0, "", "the disk is full", "", ""});
      });
      ADD_FAILURE() << "rank " << rank;
    } catch (const OutputError& error) {
      EXPECT_NE(std::string(error.what()).find("the disk is full"), std::string::npos);
    }
    EXPECT_EQ(ranks.all_gather(Numbers{rank}), (std::vector<Numbers>{{0}, {1}, {2}}));
  });
  EXPECT_EQ(test::names_in(folder_.path()).size(), 1U) << "only the checkpoint from before";
}

TEST_F(CheckpointFile, IsRemovedWhenEnoughLaterOnesAreThere) {
  for (const int step : {14, 13}) CheckpointWriter(checkpoint_file(folder_.path(), step), sample(), {}, {}).finish();
  std::ofstream(folder_.path() / ".step_000000000011.h5.tmp") << "left by a kill";
  remove_old_checkpoints(folder_.path(), 2, -1);
  const auto kept = checkpoints_in(folder_.path());
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].step, 14);
  EXPECT_EQ(kept[1].step, 13);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / ".step_000000000011.h5.tmp"));
  remove_checkpoints_after(folder_.path(), 13);
  EXPECT_EQ(checkpoints_in(folder_.path()).size(), 1U);
}

TEST_F(CheckpointFile, OfTheLastSoundStateStaysHoweverManyComeAfterIt) {
  for (const int step : {13, 14, 15, 16})
    CheckpointWriter(checkpoint_file(folder_.path(), step), sample(), {}, {}).finish();
  remove_old_checkpoints(folder_.path(), 2, 13);
  std::vector<std::int64_t> kept;
  for (const CheckpointEntry& entry : checkpoints_in(folder_.path())) kept.push_back(entry.step);
  EXPECT_EQ(kept, (std::vector<std::int64_t>{16, 15, 13}));
}

TEST_F(CheckpointFile, IsWrittenOnlyAfterTheFilesThatItCounts) {
  const auto later = checkpoint_file(folder_.path(), 13);
  EXPECT_THROW(CheckpointWriter(later, sample(), {}, {folder_.path()}).finish(), OutputError);  // a folder: not written
  EXPECT_FALSE(std::filesystem::exists(later));
  CheckpointWriter(later, sample(), {}, {folder_.path() / "nothing"}).finish();
  EXPECT_TRUE(std::filesystem::exists(later));
}

}  // namespace
}  // namespace breccia::checkpoint_test
