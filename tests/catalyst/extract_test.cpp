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

#include <array>
#include <bit>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"

namespace breccia::test::extract_test {
namespace {

constexpr std::uint32_t kAll = (1U << BRECCIA_NUM_CHANNELS) - 1;
constexpr const char* kNames[] = BRECCIA_CHANNEL_NAMES;
constexpr const char* kPipelines[] = {"volume", "joints", "fractures", "contacts", "surface", "domains", "history"};
constexpr std::int64_t kSteps[] = {0, 10, 20};

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

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

/// Ids of the cells of a channel whose centre lies in a box.
std::set<std::int64_t> ids_within(const BrecciaGrid& grid, int corners, const std::array<double, 6>& box) {
  std::set<std::int64_t> ids;
  for (std::int64_t cell = 0; cell < grid.num_cells; ++cell) {
    bool is_within = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double centre = 0;
      for (int k = 0; k < corners; ++k)
        centre += grid.points[3 * (cell * corners + k) + static_cast<int>(axis)] / corners;
      is_within = is_within && centre > box[axis] && centre < box[axis + 3];
    }
    if (is_within) ids.insert(cell);
  }
  return ids;
}

TEST(Extracts, OfABoxAndSomeFieldsHoldItsCellsAndThoseFieldsWhileOtherPipelinesGetAll) {
  const auto folder = fresh_folder("selected");
  SyntheticRun run(4, world().rank, world().size, world().size - 1 > 0 ? world().size - 1 : -1);
  SyntheticRun whole(4, 0, 1);
  const std::array<double, 6> box{0.9, -1, 0.9, 3.1, 9, 2.1};  // no centre lies on its faces
  {
    Config config(folder, world().communicator, world().rank, world().size);
    config.add("volume").region(box).fields({"id", "stress"}).add("surface").fields({"von_mises", "id"}).add("domains");
    Adaptor adaptor(config.get());
    ASSERT_TRUE(adaptor.is_open());
    for (const std::int64_t step : {std::int64_t{0}, std::int64_t{10}}) {
      EXPECT_EQ(adaptor.execute(7, run.at(step, kAll)), 0U) << adaptor.text;
      run.take_away();
      run.give_back();
    }
  }
  barrier();
  if (world().rank != 0) return;
  for (const std::int64_t step : {std::int64_t{0}, std::int64_t{10}}) {
    const auto cells = read_all(folder, "elements", step);
    ASSERT_NE(cells, nullptr);
    EXPECT_EQ(cells->GetCellData()->GetNumberOfArrays(), 2);
    expect_values(cells, step);
    std::set<std::int64_t> seen;
    vtkDataArray* ids = cells->GetCellData()->GetArray("id");
    for (vtkIdType cell = 0; cell < ids->GetNumberOfTuples(); ++cell)
      seen.insert(static_cast<std::int64_t>(ids->GetComponent(cell, 0)));
    EXPECT_EQ(seen, ids_within(*whole.at(step, kAll).channels[BRECCIA_ELEMENTS], 4, box));
    EXPECT_EQ(static_cast<std::int64_t>(seen.size()), cells->GetNumberOfCells());
    EXPECT_GT(seen.size(), 0U);
    const auto surface = read_all(folder, "surface", step);
    EXPECT_EQ(surface->GetCellData()->GetNumberOfArrays(), 2);
    expect_each_cell_once(surface, run.total(BRECCIA_SURFACE, step));
    expect_values(surface, step);
    EXPECT_EQ(read_all(folder, "domains", step)->GetCellData()->GetNumberOfArrays(), 5);
  }
}

std::string exact(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// A probe's line of a step: of an element, or of a point in none (-1).
std::string probe_line(std::int64_t step, int point, const std::array<double, 3>& at, std::int64_t element) {
  std::string line = std::to_string(step) + "," + exact(SyntheticRun::time_of(step)) + ",0," + std::to_string(point);
  for (const double x : at) line += "," + exact(x);
  line += "," + std::to_string(element);
  if (element < 0) return line + ",,,,\n";
  for (int c = 0; c < 3; ++c) line += "," + exact(SyntheticRun::expected_f64("principal", c, element, step));
  return line + "," + std::to_string(SyntheticRun::expected_integer("body", element, step)) + "\n";
}

TEST(Extracts, OfProbesAreOfTheElementsInWhichTheirPointsLieAndGoOnAfterAKilledRun) {
  const auto folder = fresh_folder("probes");
  SyntheticRun run(4, world().rank, world().size, world().size - 1 > 0 ? world().size - 1 : -1);
  Config config(folder, world().communicator, world().rank, world().size);
  config.add("probes").fields({"principal", "body"});
  config.probe({"column", {0.7, 0.5, 0.25}, {0, 0, 3}, {0, 0, 0}, 4, 1});
  config.probe({"face", {0.5, 0.5, 0.25}, {0, 0, 0}, {0, 0, 0}, 1, 1});
  config.probe({"outside", {-1, 0.5, 0.25}, {1.7, 0, 0}, {0, 0, 0}, 2, 1});
  const std::string header =
      "step,time [s],row,point,x [m],y [m],z [m],element,principal 1,principal 2,principal 3,body\n";
  std::string column = header, face = header, outside = header;
  for (const std::int64_t step : kSteps) {
    for (int k = 0; k < 4; ++k) column += probe_line(step, k, {0.7, 0.5, 0.25 + k}, 6LL * 16 * k);
    // On a face between two elements: that of the smaller id. Later they have moved on along x.
    face += probe_line(step, 0, {0.5, 0.5, 0.25}, step == 0 ? 0 : 2);
    outside += probe_line(step, 0, {-1, 0.5, 0.25}, -1) + probe_line(step, 1, {0.7, 0.5, 0.25}, 0);
  }
  for (const bool is_resumed : {false, true}) {
    Adaptor adaptor(config.get());
    ASSERT_TRUE(adaptor.is_open());
    for (const std::int64_t step : kSteps) {
      if (is_resumed && step < 20) continue;
      EXPECT_EQ(adaptor.channels(0, step, 0), 1U << BRECCIA_ELEMENTS);
      EXPECT_EQ(adaptor.execute(1, run.at(step, 1U << BRECCIA_ELEMENTS)), 0U) << adaptor.text;
    }
    barrier();
    if (world().rank != 0) continue;
    EXPECT_GT(adaptor.bytes(0), 0);
    EXPECT_EQ(content_of(folder / "probes/column.csv"), column);
    EXPECT_EQ(content_of(folder / "probes/face.csv"), face);
    EXPECT_EQ(content_of(folder / "probes/outside.csv"), outside);
    std::ofstream(folder / "probes/column.csv", std::ios::app) << "30,0.00";  // where a run was killed
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
}  // namespace breccia::test::extract_test
