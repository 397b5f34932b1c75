#include "output/frames/vtkhdf_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "unit/output/hdf5_reader.hpp"
#include "unit/output/synthetic_plate.hpp"
#include "unit/output/temporary_folder.hpp"
#include "unit/system/file_size_limit.hpp"

namespace breccia::vtkhdf_sink_test {
namespace {

using test::content_of;
using test::Hdf5Reader;
using test::names_in;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two tetrahedra, one joint, one contact; every value different, all but the mass exact in single precision.
Frame two_elements(std::int64_t number, double time) {
  Frame frame;
  frame.number = number;
  frame.time = time;
  frame.step = 1000 * number;
  auto& e = frame.elements;
  e.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1.0 / 3, 5, 5, 6, 5, 5, 5, 6, 5, 5, 5, 6};
  e.id = {7, 123456789012};
  e.body = {0, 1};
  e.material = {2, 3};
  e.rank = {4, 5};
  e.fragment = {7, 8};
  e.stress = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  e.von_mises = {20, 21};
  e.principal = {3, 2, 1, 6, 5, 4};
  e.velocity = {.5, .25, .125, 1, 2, 4};
  e.displacement = {-1, -2, -4, -8, -16, -32};
  e.cost = {1, 1.5};
  e.mass = {1.0 / 3, 2.0 / 3};
  e.neighbour = {-1, 123456789012, -1, -1, 7, -1, -1, -1};
  frame.joints = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {42}, {0.75}, {3}, {1e-6}, {2e-6}, {1}, {0.375}, {2}, {0.5}};
  frame.contacts = {{246913578036}, {24},      {9, 8, 7}, {1, 2, 3}, {1, 2, 3},
                    {0, 0, 0},      {0, 0, 0}, {0},       {1},       {123456789012}};
  return frame;
}

std::vector<std::pair<std::string, double>> index_of(const std::filesystem::path& path) {
  std::vector<std::pair<std::string, double>> entries;
  const auto index = nlohmann::json::parse(content_of(path));
  for (const auto& entry : index.at("files")) {
    entries.emplace_back(entry.at("name"), entry.at("time"));
  }
  return entries;
}

TEST(VtkhdfSinkTest, StoresEveryElementArrayWithItsShapeAndValues) {
  const TemporaryFolder folder;
  const Frame frame = two_elements(12, 0.5);
  VtkhdfSink(folder.path()).frame(frame);
  const Hdf5Reader grid(folder / "elements_000012.vtkhdf");
  EXPECT_EQ(grid.type(), "UnstructuredGrid");
  EXPECT_EQ(grid.values("Points"), frame.elements.points);
  EXPECT_EQ(grid.data("Points").bytes, 8u);
  EXPECT_THAT(grid.values("NumberOfPoints"), ElementsAre(8));
  EXPECT_THAT(grid.values("NumberOfCells"), ElementsAre(2));
  EXPECT_THAT(grid.values("NumberOfConnectivityIds"), ElementsAre(8));
  EXPECT_THAT(grid.values("Connectivity"), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(grid.values("Offsets"), ElementsAre(0, 4, 8));
  EXPECT_THAT(grid.values("Types"), ElementsAre(10, 10));
  EXPECT_EQ(grid.data("Types").bytes, 1u);
  EXPECT_THAT(grid.values("CellData/id"), ElementsAre(7, 123456789012));
  EXPECT_THAT(grid.values("CellData/body"), ElementsAre(0, 1));
  EXPECT_THAT(grid.values("CellData/material"), ElementsAre(2, 3));
  EXPECT_THAT(grid.values("CellData/rank"), ElementsAre(4, 5));
  EXPECT_THAT(grid.values("CellData/fragment"), ElementsAre(7, 8));
  EXPECT_EQ(grid.values("CellData/stress"), frame.elements.stress);
  EXPECT_THAT(grid.data("CellData/stress").shape, ElementsAre(2, 6));
  EXPECT_EQ(grid.data("CellData/stress").bytes, 4u);
  EXPECT_THAT(grid.values("CellData/von_mises"), ElementsAre(20, 21));
  EXPECT_EQ(grid.values("CellData/principal"), frame.elements.principal);
  EXPECT_EQ(grid.values("CellData/velocity"), frame.elements.velocity);
  EXPECT_EQ(grid.values("CellData/displacement"), frame.elements.displacement);
  EXPECT_EQ(grid.values("CellData/cost"), frame.elements.cost);
  EXPECT_EQ(grid.values("CellData/mass"), frame.elements.mass);  // thirds: in 64 bits
  EXPECT_THAT(grid.values("CellData/neighbour"), ElementsAre(-1, 123456789012, -1, -1, 7, -1, -1, -1));
  EXPECT_THAT(grid.values("FieldData/time"), ElementsAre(0.5));
  EXPECT_THAT(grid.values("FieldData/step"), ElementsAre(12000));
}

TEST(VtkhdfSinkTest, StoresJointsAsTrianglesAndContactsAsVerticesWithForces) {
  const TemporaryFolder folder;
  VtkhdfSink(folder.path()).frame(two_elements(0, 0));
  const Hdf5Reader joints(folder / "joints_000000.vtkhdf");
  EXPECT_THAT(joints.values("Types"), ElementsAre(5));
  EXPECT_THAT(joints.values("CellData/id"), ElementsAre(42));
  EXPECT_THAT(joints.values("CellData/damage"), ElementsAre(0.75));
  EXPECT_THAT(joints.values("CellData/mode"), ElementsAre(3));
  EXPECT_THAT(joints.values("CellData/opening"), ElementsAre(1e-6F));
  EXPECT_THAT(joints.values("CellData/slip"), ElementsAre(2e-6F));
  EXPECT_THAT(joints.values("CellData/broken"), ElementsAre(1));
  EXPECT_THAT(joints.values("CellData/time_of_failure"), ElementsAre(0.375));
  EXPECT_THAT(joints.values("CellData/state"), ElementsAre(2));
  EXPECT_THAT(joints.values("CellData/energy"), ElementsAre(0.5));
  const Hdf5Reader contacts(folder / "contacts_000000.vtkhdf");
  EXPECT_THAT(contacts.values("Types"), ElementsAre(1));
  EXPECT_THAT(contacts.values("Points"), ElementsAre(9, 8, 7));
  EXPECT_THAT(contacts.values("CellData/force"), ElementsAre(1, 2, 3));
  EXPECT_THAT(contacts.values("CellData/id"), ElementsAre(246913578036));
  EXPECT_THAT(contacts.values("CellData/normal_force"), ElementsAre(1, 2, 3));
  EXPECT_THAT(contacts.values("CellData/tangential_force"), ElementsAre(0, 0, 0));
  EXPECT_THAT(contacts.values("CellData/body"), ElementsAre(0));
  EXPECT_THAT(contacts.values("CellData/other_body"), ElementsAre(1));
  EXPECT_THAT(contacts.values("CellData/other_element"), ElementsAre(123456789012));
  EXPECT_THAT(contacts.values("CellData/point"), ElementsAre(24));
}

TEST(VtkhdfSinkTest, StoresAFrameOfManyChunksUnchanged) {
  const TemporaryFolder folder;
  const Frame frame = test::SyntheticPlate{.cubes = 32}.frame(0, 5e-5);  // 24,768 elements: more than one chunk
  VtkhdfSink(folder.path()).frame(frame);
  const Hdf5Reader grid(folder / "elements_000000.vtkhdf");
  const auto& e = frame.elements;
  EXPECT_EQ(grid.values("Points"), e.points);
  EXPECT_EQ(grid.values("CellData/id"), std::vector<double>(e.id.begin(), e.id.end()));
  EXPECT_EQ(grid.values("CellData/fragment"), std::vector<double>(e.fragment.begin(), e.fragment.end()));
}

TEST(VtkhdfSinkTest, StoresAFrameWithoutJointsAndContactsAsEmptyGrids) {
  const TemporaryFolder folder;
  Frame frame = two_elements(0, 0);
  frame.joints = {};
  frame.contacts = {};
  VtkhdfSink(folder.path()).frame(frame);
  for (const std::string part : {"joints", "contacts"}) {
    const Hdf5Reader grid(folder / (part + "_000000.vtkhdf"));
    EXPECT_THAT(grid.values("NumberOfCells"), ElementsAre(0)) << part;
    EXPECT_THAT(grid.values("Offsets"), ElementsAre(0)) << part;
    EXPECT_THAT(grid.data("Points").shape, ElementsAre(0, 3)) << part;
  }
}

TEST(VtkhdfSinkTest, IndexListsEveryFrameWithItsTime) {
  const TemporaryFolder folder;
  VtkhdfSink sink(folder.path());
  sink.frame(two_elements(0, 0));
  sink.frame(two_elements(1, 1e-5 / 3));
  for (const std::string part : {"elements", "joints", "contacts"}) {
    EXPECT_THAT(index_of(folder / (part + ".hdf.series")),
                ElementsAre(std::pair(part + "_000000.vtkhdf", 0.0), std::pair(part + "_000001.vtkhdf", 1e-5 / 3)));
  }
}

TEST(VtkhdfSinkTest, WritesOnlyThePartsAskedFor) {
  const TemporaryFolder folder;
  VtkhdfSink(folder.path(), {.elements = false, .joints = true, .contacts = false}).frame(two_elements(0, 0));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("joints.hdf.series", "joints_000000.vtkhdf"));
}

TEST(VtkhdfSinkTest, AFullDiskLeavesTheEarlierFramesAndIndicesAsTheyWere) {
  const TemporaryFolder folder;
  VtkhdfSink sink(folder.path());
  sink.frame(two_elements(0, 0));
  const auto names = names_in(folder.path());
  const std::string index = content_of(folder / "elements.hdf.series");
  const std::string first = content_of(folder / "elements_000000.vtkhdf");
  std::string message;
  testing::internal::CaptureStderr();
  {
    const test::FileSizeLimit limit(first.size() / 2);
    try {
      sink.frame(two_elements(1, 1));
    } catch (const OutputError& error) {
      message = error.what();
    }
  }
  EXPECT_THAT(testing::internal::GetCapturedStderr(), IsEmpty()) << "HDF5 must not talk to the user";
  EXPECT_THAT(message, HasSubstr((folder / "elements_000001.vtkhdf").string()));
  EXPECT_EQ(names_in(folder.path()), names);
  EXPECT_EQ(content_of(folder / "elements.hdf.series"), index);
  EXPECT_EQ(content_of(folder / "elements_000000.vtkhdf"), first);
  sink.frame(two_elements(2, 2));
  EXPECT_THAT(index_of(folder / "elements.hdf.series"),
              ElementsAre(std::pair("elements_000000.vtkhdf", 0.0), std::pair("elements_000002.vtkhdf", 2.0)));
}

TEST(VtkhdfSinkTest, NamesTheFileWhenTheFolderIsMissing) {
  const TemporaryFolder folder;
  VtkhdfSink sink(folder / "missing/frames");
  std::string message;
  try {
    sink.frame(two_elements(0, 0));
  } catch (const OutputError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, HasSubstr((folder / "missing/frames/elements_000000.vtkhdf").string()));
}

TEST(VtkhdfSinkTest, RefusesAnArrayThatDoesNotFitTheCells) {
  const TemporaryFolder folder;
  Frame frame = two_elements(0, 0);
  frame.elements.stress.pop_back();
  EXPECT_THROW(VtkhdfSink(folder.path()).frame(frame), InternalError);
  EXPECT_THAT(names_in(folder.path()), IsEmpty());
}

}  // namespace
}  // namespace breccia::vtkhdf_sink_test
