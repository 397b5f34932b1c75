#include "catalyst/probe_pipeline.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>

#include "catalyst/whole_file.hpp"
#include "run_folder/csv.hpp"

namespace breccia::insitu {
namespace {

/// "stress xx", "velocity x", "principal 1".
std::string column(const std::string& name, int component, int components) {
  constexpr std::array<const char*, 6> of_tensor{" xx", " yy", " zz", " xy", " yz", " xz"};
  constexpr std::array<const char*, 3> of_vector{" x", " y", " z"};
  if (components == 1) return name;
  const auto index = static_cast<std::size_t>(component);
  if (components == 6) return name + of_tensor[index];
  if (components == 3 && name != "principal") return name + of_vector[index];
  return name + " " + std::to_string(component + 1);
}

std::string header_of(const std::vector<vtkDataArray*>& arrays) {
  std::string header = "step,time [s],row,point,x [m],y [m],z [m],element";
  for (vtkDataArray* array : arrays) {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      header += "," + csv_field(column(array->GetName(), c, array->GetNumberOfComponents()));
  }
  return header;
}

/// Doubles hold the integers of a run, which stay far below 2^53.
std::string number(double value, bool is_real) {
  return is_real ? exact(value) : std::to_string(static_cast<std::int64_t>(value));
}

}  // namespace

ProbePipeline::ProbePipeline(const Ranks& ranks, const std::vector<Probe>& probes, std::vector<std::string> fields,
                             std::filesystem::path folder)
    : ranks_(ranks), fields_(std::move(fields)) {
  for (const Probe& probe : probes) series_.push_back({folder / (probe.name + ".csv"), probe.points, points_of(probe)});
}

std::uint32_t ProbePipeline::channels(std::int64_t, double) { return bit(BRECCIA_ELEMENTS); }

void ProbePipeline::execute(const Frame& frame, BrecciaRequests&) {
  const Elements elements = elements_of(frame);
  std::vector<std::string> lines;  // on the first rank
  for (const Series& series : series_) lines.push_back(sample(series, frame, elements));
  // A file that cannot be written must not end the work with other ranks.
  for (std::size_t i = 0; i < series_.size() && ranks_.is_root(); ++i)
    write(series_[i], frame, header_of(elements.arrays), lines[i]);
}

ProbePipeline::Elements ProbePipeline::elements_of(const Frame& frame) const {
  auto* const grid = vtkUnstructuredGrid::SafeDownCast(frame.channels[BRECCIA_ELEMENTS]);
  vtkCellData* const cells = grid->GetCellData();
  vtkDataArray* const ids = cells->GetArray("id");
  Elements elements;
  std::string error;
  elements.count = grid->GetNumberOfCells();
  if (elements.count > 0) {
    auto* const corners = vtkDoubleArray::SafeDownCast(grid->GetPoints()->GetData());
    // Two of VTK's types have 64 bits.
    const bool are_ids =
        ids != nullptr && ids->GetDataType() != VTK_DOUBLE && ids->GetDataTypeSize() == sizeof(std::int64_t);
    if (!are_ids || corners == nullptr || corners->GetNumberOfTuples() != 4 * elements.count) {
      error = "the elements are not tetrahedra with points of their own and ids";
    } else {
      elements.corners = corners->GetPointer(0);
      elements.ids = static_cast<const std::int64_t*>(ids->GetVoidPointer(0));
    }
  }
  for (const std::string& field : fields_) {
    elements.arrays.push_back(cells->GetArray(field.c_str()));
    if (elements.arrays.back() == nullptr) error = "the elements have no array '" + field + "'";
  }
  for (int i = 0; fields_.empty() && i < cells->GetNumberOfArrays(); ++i) {
    const std::string name = cells->GetArrayName(i);
    if (name != "rank" && name != "cost" && name != "id") elements.arrays.push_back(cells->GetArray(i));
  }
  ranks_.throw_agreed(error);
  return elements;
}

/// Lines of an instant, on the first rank.
std::string ProbePipeline::sample(const Series& series, const Frame& frame, const Elements& elements) const {
  const std::vector<Place> places = places_of(series.points, elements.count, elements.corners, elements.ids);
  std::vector<std::int64_t> owners;
  for (const Place& place : places) owners.push_back(place.id);
  ranks_.least(owners);
  std::size_t columns = 0;
  for (vtkDataArray* array : elements.arrays) columns += static_cast<std::size_t>(array->GetNumberOfComponents());
  std::vector<double> values(places.size() * columns, 0.0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].cell < 0 || places[i].id != owners[i]) continue;
    double* value = values.data() + i * columns;
    for (vtkDataArray* array : elements.arrays) {
      // + 0.0: a sum over ranks makes 0 of -0.
      for (int c = 0; c < array->GetNumberOfComponents(); ++c) *value++ = array->GetComponent(places[i].cell, c) + 0.0;
    }
  }
  ranks_.sum_on_root(values);
  std::string lines;
  for (std::size_t i = 0; i < places.size() && ranks_.is_root(); ++i) {
    const auto a_row = static_cast<std::size_t>(series.points_a_row);
    lines += std::to_string(frame.step) + "," + exact(frame.time) + "," + std::to_string(i / a_row) + "," +
             std::to_string(i % a_row);
    for (const double coordinate : series.points[i]) lines += "," + exact(coordinate);
    const bool is_somewhere = owners[i] != Place::kNowhere;
    lines += "," + std::to_string(is_somewhere ? owners[i] : -1);
    const double* value = values.data() + i * columns;
    for (vtkDataArray* array : elements.arrays) {
      const bool is_real = array->GetDataType() == VTK_DOUBLE;
      for (int c = 0; c < array->GetNumberOfComponents(); ++c, ++value)
        lines += is_somewhere ? "," + number(*value, is_real) : ",";
    }
    lines += '\n';
  }
  return lines;
}

void ProbePipeline::write(Series& series, const Frame& frame, const std::string& header, const std::string& lines) {
  if (series.begun) {
    bytes_ += append_to_file(series.file, lines);
    return;
  }
  make_folder(series.file.parent_path());
  const std::string earlier = run_folder::rows_before(file_content(series.file), header, frame.step);
  bytes_ += replace_file(series.file, header + '\n' + earlier + lines);
  series.begun = true;
}

}  // namespace breccia::insitu
