// Recordings of synthetic channels, read back with VTK's own readers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkXMLPPolyDataReader.h>
#include <vtkXMLPUnstructuredGridReader.h>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"

namespace breccia::test {
namespace {

constexpr std::uint32_t kAll = (1U << BRECCIA_NUM_CHANNELS) - 1;
constexpr const char* kNames[] = BRECCIA_CHANNEL_NAMES;
constexpr const char* kPipelines[] = {"volume", "joints", "fractures", "contacts", "surface", "domains", "history"};
constexpr std::int64_t kSteps[] = {0, 10, 20};

Config config_of_all(const std::filesystem::path& folder) {
  Config config(folder, world().communicator, world().rank, world().size);
  for (const char* pipeline : kPipelines) config.add(pipeline);
  return config;
}

/// Cells of all ranks of a recorded channel at a step; null when the file cannot be read.
vtkSmartPointer<vtkDataSet> read_all(const std::filesystem::path& folder, const std::string& channel,
                                     std::int64_t step) {
  char name[64];
  std::snprintf(name, sizeof name, "%s_%09lld", channel.c_str(), static_cast<long long>(step));
  const auto stem = (folder / channel / name).string();
  vtkSmartPointer<vtkXMLPDataReader> reader;
  if (std::filesystem::exists(stem + ".pvtu")) {
    reader = vtkSmartPointer<vtkXMLPUnstructuredGridReader>::New();
    reader->SetFileName((stem + ".pvtu").c_str());
  } else {
    reader = vtkSmartPointer<vtkXMLPPolyDataReader>::New();
    reader->SetFileName((stem + ".pvtp").c_str());
  }
  reader->Update();
  return reader->GetErrorCode() != 0 ? nullptr : vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0));
}

void expect_values(vtkDataSet* cells, std::int64_t step) {
  vtkDataArray* ids = cells->GetCellData()->GetArray("id") != nullptr ? cells->GetCellData()->GetArray("id") : nullptr;
  std::int64_t wrong = 0;
  for (int i = 0; i < cells->GetCellData()->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = cells->GetCellData()->GetArray(i);
    const std::string name = array->GetName();
    for (vtkIdType cell = 0; cell < array->GetNumberOfTuples(); ++cell) {
      const auto id = ids == nullptr ? cell : static_cast<std::int64_t>(ids->GetComponent(cell, 0));
      for (int c = 0; c < array->GetNumberOfComponents(); ++c) {
        const double expected = array->GetDataType() == VTK_DOUBLE
                                    ? SyntheticRun::expected_f64(name, c, id, step)
                                    : static_cast<double>(SyntheticRun::expected_integer(name, id, step));
        wrong += std::bit_cast<std::uint64_t>(array->GetComponent(cell, c)) != std::bit_cast<std::uint64_t>(expected);
      }
    }
  }
  EXPECT_EQ(wrong, 0);
}

void expect_each_cell_once(vtkDataSet* cells, std::int64_t total) {
  vtkDataArray* ids = cells->GetCellData()->GetArray("id");
  ASSERT_NE(ids, nullptr);
  ASSERT_EQ(ids->GetNumberOfTuples(), cells->GetNumberOfCells());
  std::set<std::int64_t> seen;
  for (vtkIdType cell = 0; cell < ids->GetNumberOfTuples(); ++cell)
    seen.insert(static_cast<std::int64_t>(ids->GetComponent(cell, 0)));
  EXPECT_EQ(cells->GetNumberOfCells(), total);
  EXPECT_EQ(static_cast<std::int64_t>(seen.size()), total);
  EXPECT_EQ(seen.empty() ? -1 : *seen.rbegin(), total - 1);
}

TEST(Extracts, HoldEachCellOnceAndItsValuesToTheBitWithARankThatOwnsNothing) {
  const auto folder = fresh_folder("all_channels");
  SyntheticRun run(4, world().rank, world().size, world().size - 1 > 0 ? world().size - 1 : -1);
  {
    Adaptor adaptor(config_of_all(folder).get());
    ASSERT_TRUE(adaptor.is_open());
    for (const std::int64_t step : kSteps) {
      for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel)
        EXPECT_EQ(adaptor.channels(channel, step, SyntheticRun::time_of(step)), 1U << channel);
      EXPECT_EQ(adaptor.execute(kAll, run.at(step, kAll)), 0U) << adaptor.text;
      run.take_away();  // from here on the adaptor must live without
      EXPECT_GT(adaptor.bytes(BRECCIA_ELEMENTS), 0);
      run.give_back();
    }
    run.take_away();
  }
  barrier();
  if (world().rank != 0) return;
  for (const std::int64_t step : kSteps) {
    for (int channel = 0; channel < BRECCIA_HISTORY; ++channel) {
      SCOPED_TRACE(std::string(kNames[channel]) + " at step " + std::to_string(step));
      const auto cells = read_all(folder, kNames[channel], step);
      ASSERT_NE(cells, nullptr);
      if (channel == BRECCIA_DOMAINS) {
        EXPECT_EQ(cells->GetNumberOfCells(), world().size);
      } else {
        expect_each_cell_once(cells, run.total(channel, step));
      }
      expect_values(cells, step);
    }
  }
}

TEST(Extracts, HistoryIsALineAStepWithDoublesThatReadBackToTheBit) {
  const auto folder = fresh_folder("history");
  SyntheticRun run(2, world().rank, world().size);
  {
    Config config(folder, world().communicator, world().rank, world().size);
    Adaptor adaptor(config.add("history").get());
    for (const std::int64_t step : kSteps)
      EXPECT_EQ(adaptor.execute(1, run.at(step, 1U << BRECCIA_HISTORY)), 0U) << adaptor.text;
  }
  barrier();
  std::ifstream file(folder / "history/history.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "step,time [s],kinetic [J],broken joints");
  for (const std::int64_t step : kSteps) {
    ASSERT_TRUE(std::getline(file, line));
    std::istringstream fields(line);
    std::string field;
    std::getline(fields, field, ',');
    EXPECT_EQ(field, std::to_string(step));
    std::getline(fields, field, ',');
    EXPECT_EQ(std::strtod(field.c_str(), nullptr), SyntheticRun::time_of(step));
    std::getline(fields, field, ',');
    EXPECT_EQ(std::strtod(field.c_str(), nullptr), SyntheticRun::expected_f64("kinetic [J]", 0, 0, step));
  }
  EXPECT_FALSE(std::getline(file, line));
}

}  // namespace
}  // namespace breccia::test
