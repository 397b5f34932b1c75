#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "mpi/world.hpp"
#include "output/frames/vtkhdf_sink.hpp"
#include "unit/output/hdf5_reader.hpp"
#include "unit/output/synthetic_plate.hpp"
#include "unit/output/temporary_folder.hpp"
#include "unit/system/file_size_limit.hpp"

namespace breccia {
namespace {

using test::Hdf5Reader;
using test::names_in;
using test::world;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

/// What this rank has handed to the disk, by its name at that moment.
std::vector<std::filesystem::path> synced;

}  // namespace
}  // namespace breccia

/// Goes before the C library's in this program: notes the call and does as that one does.
extern "C" int fsync(int descriptor) {
  breccia::synced.push_back(std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor)));
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

namespace breccia {
namespace {

constexpr const char* kNoError = "no error";
constexpr double kLate = 9e-5;  // s, when the synthetic plate has joints and contacts

/// A temporary folder that all ranks see; goes when all are done with it.
class SharedFolder {
 public:
  SharedFolder() {
    std::vector<std::byte> bytes;
    if (world().is_root()) {
      own_.emplace();
      const std::string name = own_->path().string();
      const auto raw = std::as_bytes(std::span(name));
      bytes.assign(raw.begin(), raw.end());
    }
    world().broadcast(bytes);
    path_ = std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;
  ~SharedFolder() { world().barrier(); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::optional<test::TemporaryFolder> own_;
  std::filesystem::path path_;
};

Frame plate(std::int64_t number, double time = kLate) { return test::SyntheticPlate{.cubes = 6}.frame(number, time); }

/// This rank's piece of the plate.
Frame my_piece(std::int64_t number, double time = kLate) {
  return test::piece_of(plate(number, time), world().rank(), world().size());
}

template <class T>
std::vector<double> doubles(const std::vector<T>& values) {
  return {values.begin(), values.end()};
}

/// As a file keeps it.
std::vector<double> single(const std::vector<double>& values) {
  std::vector<double> rounded;
  for (const double value : values) rounded.push_back(static_cast<float>(value));
  return rounded;
}

template <class Error>
std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return kNoError;
}

/// Numbers of points 0 1 2 ..., or where each cell's begin, piece by piece.
void expect_numbering(const Hdf5Reader& grid, std::size_t points_per_cell) {
  std::vector<double> connectivity, offsets;
  for (const double cells : grid.values("NumberOfCells")) {
    const auto n = static_cast<std::size_t>(cells);
    for (std::size_t i = 0; i < n * points_per_cell; ++i) connectivity.push_back(static_cast<double>(i));
    for (std::size_t i = 0; i <= n; ++i) offsets.push_back(static_cast<double>(i * points_per_cell));
  }
  EXPECT_EQ(grid.values("Connectivity"), connectivity);
  EXPECT_EQ(grid.values("Offsets"), offsets);
}

TEST(Frames, HoldThePiecesOfTheRanksInTheirOrder) {
  const SharedFolder folder;
  VtkhdfSink(folder.path(), {}, world()).frame(my_piece(3));
  if (!world().is_root()) return;
  const Frame whole = plate(3);
  const Hdf5Reader grid(folder / "elements_000003.vtkhdf");
  std::vector<double> cells;
  for (int r = 0; r < world().size(); ++r)
    cells.push_back(static_cast<double>(test::piece_of(whole, r, world().size()).elements.id.size()));
  EXPECT_EQ(grid.values("NumberOfCells"), cells);
  for (double& count : cells) count *= 4;
  EXPECT_EQ(grid.values("NumberOfPoints"), cells);
  EXPECT_EQ(grid.values("NumberOfConnectivityIds"), cells);
  expect_numbering(grid, 4);
  const Frame::Elements& e = whole.elements;
  EXPECT_EQ(grid.values("Points"), e.points);
  EXPECT_THAT(grid.values("Types"), Each(10));
  EXPECT_EQ(grid.values("Types").size(), e.id.size());
  EXPECT_EQ(grid.values("CellData/id"), doubles(e.id));
  EXPECT_EQ(grid.values("CellData/body"), doubles(e.body));
  EXPECT_EQ(grid.values("CellData/fragment"), doubles(e.fragment));
  EXPECT_EQ(grid.values("CellData/stress"), single(e.stress));
  EXPECT_EQ(grid.data("CellData/stress").shape, (std::vector<hsize_t>{e.id.size(), 6}));
  EXPECT_EQ(grid.values("CellData/displacement"), single(e.displacement));
  EXPECT_EQ(grid.values("CellData/cost"), single(e.cost));
  EXPECT_THAT(grid.values("FieldData/time"), ElementsAre(whole.time));
  EXPECT_THAT(grid.values("FieldData/step"), ElementsAre(static_cast<double>(whole.step)));
}

TEST(Frames, AreOnTheDiskOfEveryRankBeforeTheyHaveTheirNames) {
  if (world().size() == 1) GTEST_SKIP() << "one rank writes as any other file: SyncedFile";
  const SharedFolder folder;
  synced.clear();
  VtkhdfSink(folder.path(), {true, false, false}, world()).frame(my_piece(3));
  ASSERT_FALSE(synced.empty());
  EXPECT_EQ(synced.front(), std::filesystem::canonical(folder.path()) / ".elements_000003.vtkhdf.tmp");
}

TEST(Frames, HoldJointsAndContactsOfAllRanks) {
  const SharedFolder folder;
  VtkhdfSink(folder.path(), {}, world()).frame(my_piece(0));
  if (!world().is_root()) return;
  const Frame whole = plate(0);
  ASSERT_GT(whole.joints.id.size(), 8u);
  ASSERT_GT(whole.contacts.force.size(), 24u);
  const Hdf5Reader joints(folder / "joints_000000.vtkhdf"), contacts(folder / "contacts_000000.vtkhdf");
  expect_numbering(joints, 3);
  EXPECT_EQ(joints.values("Points"), whole.joints.points);
  EXPECT_EQ(joints.values("CellData/id"), doubles(whole.joints.id));
  EXPECT_EQ(joints.values("CellData/damage"), single(whole.joints.damage));
  EXPECT_EQ(joints.values("CellData/mode"), doubles(whole.joints.mode));
  expect_numbering(contacts, 1);
  EXPECT_EQ(contacts.values("Points"), whole.contacts.points);
  EXPECT_EQ(contacts.values("CellData/force"), single(whole.contacts.force));
  EXPECT_EQ(contacts.values("CellData/other_body"), doubles(whole.contacts.other_body));
}

TEST(Frames, MayHaveEmptyPieces) {
  const SharedFolder folder;
  Frame mine = plate(0);
  if (world().rank() != world().size() - 1) mine.elements = {};
  mine.contacts = {};
  VtkhdfSink(folder.path(), {}, world()).frame(mine);
  if (!world().is_root()) return;
  const Hdf5Reader elements(folder / "elements_000000.vtkhdf"), contacts(folder / "contacts_000000.vtkhdf");
  std::vector<double> cells(static_cast<std::size_t>(world().size()), 0.0);
  EXPECT_EQ(contacts.values("NumberOfCells"), cells);
  EXPECT_EQ(contacts.values("Offsets"), cells);
  EXPECT_THAT(contacts.data("CellData/force").shape, ElementsAre(0, 3));
  cells.back() = static_cast<double>(plate(0).elements.id.size());
  EXPECT_EQ(elements.values("NumberOfCells"), cells);
  EXPECT_EQ(elements.values("Points"), plate(0).elements.points);
  expect_numbering(elements, 4);
}

TEST(Frames, AreListedOnceWithTheirTimesAndLeaveNothingElse) {
  const SharedFolder folder;
  VtkhdfSink sink(folder.path(), {.elements = true, .joints = false, .contacts = false}, world());
  sink.frame(my_piece(0, 0.0));
  sink.frame(my_piece(1));
  if (!world().is_root()) return;
  EXPECT_THAT(names_in(folder.path()),
              ElementsAre("elements.hdf.series", "elements_000000.vtkhdf", "elements_000001.vtkhdf"));
  const std::string index = test::content_of(folder / "elements.hdf.series");
  EXPECT_THAT(index, HasSubstr("elements_000000.vtkhdf"));
  EXPECT_THAT(index, HasSubstr("9e-05"));
}

TEST(Frames, ThatCannotBeWrittenFailOnAllRanksAndNameTheFile) {
  const SharedFolder folder;
  VtkhdfSink sink(folder / "missing/frames", {}, world());
  const Frame mine = my_piece(0);
  EXPECT_THAT(message_of<OutputError>([&] { sink.frame(mine); }),
              HasSubstr((folder / "missing/frames/elements_000000.vtkhdf").string()));
}

TEST(Frames, LeaveTheEarlierOnesAsTheyWereWhenTheDiskIsFull) {
  constexpr rlim_t kRoom = 40'000;  // bytes; the elements of the plate need more
  const SharedFolder folder;
  VtkhdfSink sink(folder.path(), {}, world());
  sink.frame(my_piece(0));
  world().barrier();
  const std::vector<std::string> names = names_in(folder.path());
  const std::string index = test::content_of(folder / "elements.hdf.series"),
                    first = test::content_of(folder / "elements_000000.vtkhdf");
  ASSERT_GT(first.size(), 2 * kRoom);
  for (const int limited :
       {-1, 0, world().size() - 1}) {  // all ranks, the one that takes the space, one that writes its piece
    std::string message;
    {
      std::optional<test::FileSizeLimit> limit;
      if (limited == -1 || limited == world().rank()) limit.emplace(kRoom);
      message = message_of<OutputError>([&] { sink.frame(my_piece(1)); });
    }
    world().barrier();  // the first rank has removed what it began
    EXPECT_THAT(message, HasSubstr((folder / "elements_000001.vtkhdf").string())) << "limited: " << limited;
    EXPECT_EQ(names_in(folder.path()), names) << "limited: " << limited;
    EXPECT_EQ(test::content_of(folder / "elements.hdf.series"), index);
    EXPECT_EQ(test::content_of(folder / "elements_000000.vtkhdf"), first);
    world().barrier();
  }
  sink.frame(my_piece(2));
  world().barrier();
  EXPECT_EQ(Hdf5Reader(folder / "elements_000002.vtkhdf").values("Points"), plate(2).elements.points);
}

TEST(Frames, StandWholeInTheirFileWithPlainDatasetsOfTheSizeThatIsSaid) {
  const SharedFolder folder;
  VtkhdfSink(folder.path(), {}, world()).frame(my_piece(0));
  if (!world().is_root() || world().size() == 1) return;
  const Frame whole = plate(0);
  const std::size_t cells = whole.elements.id.size();
  // Points, connectivity, offsets, types; id, body, material, rank, fragment; 16 single numbers; then the structure.
  const std::size_t values = cells * (96 + 32 + 8 + 1 + 8 + 3 * 4 + 8 + 4 * (6 + 1 + 3 + 1 + 3 + 3));
  const std::uintmax_t size = std::filesystem::file_size(folder / "elements_000000.vtkhdf");
  EXPECT_GT(size, values);
  EXPECT_LT(size, values + 65'536);
}

TEST(Frames, WithAnArrayThatDoesNotFitTheCellsOfOneRankAreRefusedByAll) {
  const SharedFolder folder;
  Frame mine = my_piece(0);
  if (world().rank() == world().size() - 1) mine.elements.stress.pop_back();
  EXPECT_THAT(message_of<InternalError>([&] { VtkhdfSink(folder.path(), {}, world()).frame(mine); }),
              HasSubstr("stress"));
  world().barrier();
  EXPECT_THAT(names_in(folder.path()), ElementsAre());
}

}  // namespace
}  // namespace breccia
