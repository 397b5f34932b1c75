// What ParaView's extractors of data make of channels, read back with VTK's own readers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPPolyDataReader.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLPartitionedDataSetReader.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"

namespace breccia::test::collections_test {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kPart = 100;  ///< elements that the script's threshold leaves

/// Cells of all grids in a file; -1: it cannot be read.
template <class Reader>
std::int64_t cells_of(const fs::path& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkDataObject* const data = reader->GetOutputDataObject(0);
  if (reader->GetErrorCode() != 0 || data == nullptr) return -1;
  return data->GetNumberOfElements(vtkDataObject::CELL);
}

std::int64_t lines_of(const fs::path& file) {
  std::ifstream stream(file);
  return std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
}

TEST(Collections, HaveEachCellOnceOnAnyNumberOfRanksOneOfThemEmpty) {
  const fs::path folder = fresh_folder("collections");
  const int empty = world().size > 1 ? world().size / 2 : -1;
  SyntheticRun run(3, world().rank, world().size, empty);
  Config config(folder, world().communicator, world().rank, world().size);
  config.add(std::string(BRECCIA_SCRIPTS) + "/writes_collections.py");
  config.add(std::string(BRECCIA_SCRIPTS) + "/writes_boxes.py");
  {
    Adaptor adaptor(config.get());
    ASSERT_TRUE(adaptor.is_open());
    for (const std::int64_t step : {1, 2}) {
      const std::uint32_t channels = adaptor.channels(0, step, SyntheticRun::time_of(step));
      EXPECT_EQ(adaptor.execute(1, run.at(step, channels)), 0) << adaptor.text;
      run.take_away();
      run.give_back();
    }
    EXPECT_EQ(adaptor.execute(2, run.at(2, adaptor.channels(1, 2, SyntheticRun::time_of(2)))), 2);
    EXPECT_THAT(adaptor.text, testing::HasSubstr("the extractor VTH writes adaptively refined boxes"));
  }
  barrier();
  if (world().rank != 0) return;
  const fs::path files = folder / "writes_collections";
  const std::int64_t elements = run.total(BRECCIA_ELEMENTS, 2), surface = run.total(BRECCIA_SURFACE, 2);
  EXPECT_EQ(cells_of<vtkXMLPartitionedDataSetReader>(files / "elements_000002.vtpd"), elements);
  EXPECT_EQ(cells_of<vtkXMLPartitionedDataSetReader>(files / "part_000002.vtpd"), kPart);
  EXPECT_EQ(cells_of<vtkXMLPartitionedDataSetCollectionReader>(files / "surface_000002.vtpc"), surface);
  EXPECT_EQ(cells_of<vtkXMLPartitionedDataSetCollectionReader>(files / "group_000002.vtpc"), surface);
  EXPECT_EQ(cells_of<vtkXMLMultiBlockDataReader>(files / "elements_000002.vtm"), elements);
  EXPECT_EQ(cells_of<vtkXMLPUnstructuredGridReader>(files / "elements_000002.pvtu"), elements);
  EXPECT_EQ(cells_of<vtkXMLPPolyDataReader>(files / "surface_000002.pvtp"), surface);
  EXPECT_GE(lines_of(files / "surface_000002.csv"), surface);
  EXPECT_TRUE(fs::exists(files / "surface_000002.ply"));
  EXPECT_TRUE(fs::exists(files / "elements_000002.cgns"));
}

}  // namespace
}  // namespace breccia::test::collections_test
