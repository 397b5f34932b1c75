#include "output/vtkhdf_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "output/atomic_file.hpp"
#include "output/vtkhdf_image.hpp"
#include "unit/output/file_size_limit.hpp"
#include "unit/output/hdf5_reader.hpp"
#include "unit/output/synthetic_plate.hpp"
#include "unit/output/temporary_folder.hpp"
#include "unit/output/thrown_message.hpp"

namespace breccia {
namespace {

using test::Hdf5Reader;
using testing::ElementsAre;

std::vector<double> in_single_precision(const std::vector<double>& values) {
  std::vector<double> rounded;
  for (const double value : values) rounded.push_back(static_cast<float>(value));
  return rounded;
}

template <class T>
std::vector<double> as_doubles(const std::vector<T>& values) {
  std::vector<double> doubles;
  for (const T value : values) doubles.push_back(static_cast<double>(value));
  return doubles;
}

/// In the folder of each test; the plate is large enough for several chunks a dataset.
class FrameFiles : public testing::Test {
 protected:
  FrameFiles() { plate_.cubes = 30; }
  test::TemporaryFolder folder_;
  test::SyntheticPlate plate_;
};

TEST_F(FrameFiles, GiveBackPointsInDoubleAndFieldsInSinglePrecision) {
  const Frame frame = plate_.frame(7, 0.9 * plate_.end);
  VtkhdfSink(folder_.path()).frame(frame);
  const Hdf5Reader file(folder_ / "elements_000007.vtkhdf");
  const auto& e = frame.elements;
  const auto n = static_cast<hsize_t>(e.id.size());
  EXPECT_EQ(file.values("VTKHDF/Points"), e.points);
  EXPECT_THAT(file.data("VTKHDF/Points").shape, ElementsAre(4 * n, 3u));
  EXPECT_EQ(file.data("VTKHDF/Points").bytes, 8u);
  EXPECT_EQ(file.values("VTKHDF/CellData/id"), as_doubles(e.id));
  EXPECT_EQ(file.values("VTKHDF/CellData/body"), as_doubles(e.body));
  EXPECT_EQ(file.values("VTKHDF/CellData/material"), as_doubles(e.material));
  EXPECT_EQ(file.values("VTKHDF/CellData/rank"), as_doubles(e.rank));
  EXPECT_EQ(file.values("VTKHDF/CellData/fragment"), as_doubles(e.fragment));
  EXPECT_EQ(file.values("VTKHDF/CellData/stress"), in_single_precision(e.stress));
  EXPECT_THAT(file.data("VTKHDF/CellData/stress").shape, ElementsAre(n, 6u));
  EXPECT_EQ(file.data("VTKHDF/CellData/stress").bytes, 4u);
  EXPECT_EQ(file.values("VTKHDF/CellData/von_mises"), in_single_precision(e.von_mises));
  EXPECT_THAT(file.data("VTKHDF/CellData/von_mises").shape, ElementsAre(n));
  EXPECT_EQ(file.values("VTKHDF/CellData/principal"), in_single_precision(e.principal));
  EXPECT_EQ(file.values("VTKHDF/CellData/velocity"), in_single_precision(e.velocity));
  EXPECT_EQ(file.values("VTKHDF/CellData/displacement"), in_single_precision(e.displacement));
  EXPECT_THAT(file.values("VTKHDF/FieldData/time"), ElementsAre(frame.time));
  EXPECT_THAT(file.values("VTKHDF/FieldData/step"), ElementsAre(static_cast<double>(frame.step)));
}

TEST_F(FrameFiles, GiveBackJointsAndContacts) {
  const Frame frame = plate_.frame(0, plate_.end);
  ASSERT_FALSE(frame.joints.id.empty());
  ASSERT_FALSE(frame.contacts.body.empty());
  VtkhdfSink(folder_.path()).frame(frame);
  const Hdf5Reader joints(folder_ / "joints_000000.vtkhdf");
  EXPECT_EQ(joints.values("VTKHDF/Points"), frame.joints.points);
  EXPECT_EQ(joints.values("VTKHDF/CellData/id"), as_doubles(frame.joints.id));
  EXPECT_EQ(joints.values("VTKHDF/CellData/damage"), in_single_precision(frame.joints.damage));
  EXPECT_EQ(joints.values("VTKHDF/CellData/mode"), as_doubles(frame.joints.mode));
  EXPECT_EQ(joints.values("VTKHDF/CellData/opening"), in_single_precision(frame.joints.opening));
  EXPECT_EQ(joints.values("VTKHDF/CellData/slip"), in_single_precision(frame.joints.slip));
  EXPECT_EQ(joints.values("VTKHDF/CellData/broken"), as_doubles(frame.joints.broken));
  const Hdf5Reader contacts(folder_ / "contacts_000000.vtkhdf");
  EXPECT_EQ(contacts.values("VTKHDF/Points"), frame.contacts.points);
  EXPECT_EQ(contacts.values("VTKHDF/CellData/force"), in_single_precision(frame.contacts.force));
  EXPECT_EQ(contacts.values("VTKHDF/CellData/body"), as_doubles(frame.contacts.body));
  EXPECT_EQ(contacts.values("VTKHDF/CellData/other_body"), as_doubles(frame.contacts.other_body));
}

TEST(GridImage, NumbersCellsPointsAndTypesAsVtkDoes) {
  struct Kind {
    CellKind kind;
    std::size_t corners;
    double vtk_type;  // VTK_TETRA, VTK_TRIANGLE, VTK_VERTEX of vtkCellType.h
  };
  const test::TemporaryFolder folder;
  for (const Kind& kind : {Kind{CellKind::tetrahedra, 4, 10}, Kind{CellKind::triangles, 3, 5}, Kind{CellKind::vertices, 1, 1}}) {
    const std::vector<double> points(2 * 3 * kind.corners, 0.5);
    GridView grid;
    grid.kind = kind.kind;
    grid.points = points;
    write_file_atomically(folder / "grid.vtkhdf", vtkhdf_image(grid));
    const Hdf5Reader file(folder / "grid.vtkhdf");
    const double n = static_cast<double>(kind.corners);
    EXPECT_THAT(file.values("VTKHDF/NumberOfPoints"), ElementsAre(2 * n));
    EXPECT_THAT(file.values("VTKHDF/NumberOfConnectivityIds"), ElementsAre(2 * n));
    EXPECT_THAT(file.values("VTKHDF/NumberOfCells"), ElementsAre(2));
    EXPECT_THAT(file.values("VTKHDF/Offsets"), ElementsAre(0, n, 2 * n));
    EXPECT_THAT(file.values("VTKHDF/Types"), ElementsAre(kind.vtk_type, kind.vtk_type));
    const std::vector<double> connectivity = file.values("VTKHDF/Connectivity");
    ASSERT_EQ(connectivity.size(), 2 * kind.corners);
    for (std::size_t i = 0; i < connectivity.size(); ++i) EXPECT_EQ(connectivity[i], static_cast<double>(i));
  }
}

TEST(GridImage, RefusesAnArrayOfAnotherLength) {
  const std::vector<double> points(12), values(2);
  GridView grid;
  grid.points = points;
  grid.arrays = {{"wrong", std::span<const double>(values)}};
  EXPECT_THROW(static_cast<void>(vtkhdf_image(grid)), InternalError);
}

nlohmann::json index_of(const test::TemporaryFolder& folder, const std::string& part) {
  return nlohmann::json::parse(test::content_of(folder / (part + ".hdf.series")))["files"];
}

TEST_F(FrameFiles, AreListedWithTheirTimes) {
  plate_.cubes = 4;
  VtkhdfSink sink(folder_.path());
  sink.frame(plate_.frame(0, 0));
  sink.frame(plate_.frame(1, 1.0 / 3e5));
  const nlohmann::json expected{{{"name", "joints_000000.vtkhdf"}, {"time", 0.0}},
                                {{"name", "joints_000001.vtkhdf"}, {"time", 1.0 / 3e5}}};
  EXPECT_EQ(index_of(folder_, "joints"), expected);
  EXPECT_EQ(index_of(folder_, "elements").size(), 2u);
  EXPECT_EQ(index_of(folder_, "contacts").size(), 2u);
}

TEST_F(FrameFiles, OfPartsNotAskedForDoNotAppear) {
  plate_.cubes = 4;
  VtkhdfSink sink(folder_.path(), {.elements = false, .joints = true, .contacts = false});
  sink.frame(plate_.frame(0, 0));
  EXPECT_THAT(test::names_in(folder_.path()), ElementsAre("joints.hdf.series", "joints_000000.vtkhdf"));
}

TEST_F(FrameFiles, BeforeAFullDiskStayWithTheirIndex) {
  plate_.cubes = 4;
  VtkhdfSink sink(folder_.path());
  sink.frame(plate_.frame(0, 0));
  const std::vector<std::string> names = test::names_in(folder_.path());
  const std::string elements = test::content_of(folder_ / "elements_000000.vtkhdf");
  std::string message;
  {
    const test::FileSizeLimit limit(elements.size() / 2);
    message = test::message_of<OutputError>([&] { sink.frame(plate_.frame(1, 1e-5)); });
  }
  EXPECT_THAT(message, testing::HasSubstr((folder_ / "elements_000001.vtkhdf").string()));
  EXPECT_EQ(test::names_in(folder_.path()), names);
  EXPECT_EQ(test::content_of(folder_ / "elements_000000.vtkhdf"), elements);
  EXPECT_EQ(index_of(folder_, "elements").size(), 1u);
  // Room again: the run may go on with the next frame.
  sink.frame(plate_.frame(2, 2e-5));
  EXPECT_EQ(index_of(folder_, "elements").size(), 2u);
}

TEST(FrameFolder, ThatIsMissingIsNamed) {
  VtkhdfSink sink("/missing_folder/frames");
  test::SyntheticPlate plate;
  plate.cubes = 2;
  const std::string message = test::message_of<OutputError>([&] { sink.frame(plate.frame(0, 0)); });
  EXPECT_THAT(message, testing::HasSubstr("/missing_folder/frames/elements_000000.vtkhdf"));
}

}  // namespace
}  // namespace breccia
