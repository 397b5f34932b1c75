#include "catalyst/frame_to_vtk.hpp"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include <numeric>

namespace breccia::insitu {
namespace {

bool is_unstructured(std::int32_t cell) { return cell == BRECCIA_TETRAHEDRON || cell == BRECCIA_HEXAHEDRON; }

/// A VTK array over the values of another: nothing is copied, nothing will be freed.
template <class Array, class Value>
vtkSmartPointer<Array> over(const void* values, std::int64_t tuples, int components) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(components);
  // VTK has no read-only arrays; filters copy before they write.
  array->SetArray(static_cast<Value*>(const_cast<void*>(values)), tuples * components, 1);
  return array;
}

vtkSmartPointer<vtkDataArray> wrapped(const BrecciaArray& source, std::int64_t tuples) {
  vtkSmartPointer<vtkDataArray> array;
  switch (source.type) {
    case BRECCIA_F64:
      array = over<vtkDoubleArray, double>(source.values, tuples, source.components);
      break;
    case BRECCIA_I32:
      array = over<vtkTypeInt32Array, vtkTypeInt32Array::ValueType>(source.values, tuples, source.components);
      break;
    case BRECCIA_I64:
      array = over<vtkTypeInt64Array, vtkTypeInt64Array::ValueType>(source.values, tuples, source.components);
      break;
    default:
      throw PipelineError(std::string("array ") + source.name + " has the unknown type " + std::to_string(source.type));
  }
  array->SetName(source.name);
  return array;
}

vtkSmartPointer<vtkPoints> points_of(const BrecciaGrid& grid) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(over<vtkDoubleArray, double>(grid.points, grid.num_points, 3));
  return points;
}

/// Arrays go to the cells of a data set or to the rows of a table.
vtkFieldData* attributes_of(vtkDataObject* object) {
  if (auto* table = vtkTable::SafeDownCast(object)) return table->GetRowData();
  return vtkDataSet::SafeDownCast(object)->GetCellData();
}

void add_empty_arrays(vtkFieldData* like, vtkFieldData* to) {
  for (int i = 0; i < like->GetNumberOfArrays(); ++i) {
    vtkAbstractArray* array = like->GetAbstractArray(i);
    const auto empty = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
    empty->SetName(array->GetName());
    empty->SetNumberOfComponents(array->GetNumberOfComponents());
    to->AddArray(empty);
  }
}

}  // namespace

void set_instant(vtkDataObject* object, std::int64_t step, double time) {
  vtkNew<vtkDoubleArray> times;
  times->SetName("TimeValue");
  times->InsertNextValue(time);
  vtkNew<vtkTypeInt64Array> steps;
  steps->SetName("step");
  steps->InsertNextValue(step);
  object->GetFieldData()->AddArray(times);
  object->GetFieldData()->AddArray(steps);
}

void ChannelToVtk::update_connectivity(const BrecciaGrid& grid) {
  if (cells_ && topology_ == grid.topology && cell_ == grid.cell && num_cells_ == grid.num_cells &&
      num_points_ == grid.num_points)
    return;
  const int corners = corners_of(grid.cell);
  const std::int64_t entries = grid.num_cells * corners;
  if (grid.corners == nullptr && entries != grid.num_points)
    throw PipelineError("has " + std::to_string(grid.num_points) + " points for " + std::to_string(grid.num_cells) +
                        " cells without corners");
  if (entries >= INT32_MAX) throw PipelineError("has more than 2^31 corners on a rank");

  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(grid.num_cells + 1);
  for (std::int64_t cell = 0; cell <= grid.num_cells; ++cell)
    offsets->SetValue(cell, static_cast<std::int32_t>(cell * corners));
  vtkNew<vtkTypeInt32Array> connectivity;
  connectivity->SetNumberOfValues(entries);
  auto* first = connectivity->GetPointer(0);
  if (grid.corners != nullptr) {
    std::copy_n(grid.corners, entries, first);
  } else {
    std::iota(first, first + entries, 0);
  }
  // New objects, not new content: filters may still hold the old ones.
  cells_ = vtkSmartPointer<vtkCellArray>::New();
  cells_->SetData(offsets, connectivity);
  cell_types_ = nullptr;
  if (is_unstructured(grid.cell)) {
    cell_types_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
    cell_types_->SetNumberOfValues(grid.num_cells);
    cell_types_->FillValue(static_cast<unsigned char>(grid.cell));
  }
  topology_ = grid.topology;
  cell_ = grid.cell;
  num_cells_ = grid.num_cells;
  num_points_ = grid.num_points;
}

vtkSmartPointer<vtkDataObject> ChannelToVtk::wrap(const BrecciaGrid& grid, std::int64_t step, double time) {
  vtkSmartPointer<vtkDataObject> object;
  if (grid.cell == BRECCIA_TABLE) {
    object = vtkSmartPointer<vtkTable>::New();
  } else {
    update_connectivity(grid);
    if (is_unstructured(grid.cell)) {
      auto cells = vtkSmartPointer<vtkUnstructuredGrid>::New();
      cells->SetPoints(points_of(grid));
      cells->SetCells(cell_types_, cells_);
      object = cells;
    } else {
      auto faces = vtkSmartPointer<vtkPolyData>::New();
      faces->SetPoints(points_of(grid));
      if (grid.cell == BRECCIA_VERTEX) {
        faces->SetVerts(cells_);
      } else {
        faces->SetPolys(cells_);
      }
      object = faces;
    }
  }
  for (std::int32_t i = 0; i < grid.num_arrays; ++i)
    attributes_of(object)->AddArray(wrapped(grid.arrays[i], grid.num_cells));
  auto* const set = vtkDataSet::SafeDownCast(object);
  for (std::int32_t i = 0; set != nullptr && i < grid.num_point_arrays; ++i)
    set->GetPointData()->AddArray(wrapped(grid.point_arrays[i], grid.num_points));
  set_instant(object, step, time);
  return object;
}

Frame FrameToVtk::wrap(const BrecciaInstant& instant) {
  Frame frame;
  frame.step = instant.step;
  frame.time = instant.time;
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
    if (instant.channels[channel] == nullptr) continue;
    try {
      frame.channels[channel] = channels_[channel].wrap(*instant.channels[channel], instant.step, instant.time);
    } catch (const PipelineError& error) {
      throw PipelineError(std::string("channel ") + kChannelNames[channel] + ": " + error.what());
    }
  }
  return frame;
}

vtkSmartPointer<vtkDataObject> empty_like(vtkDataObject* object) {
  auto copy = vtkSmartPointer<vtkDataObject>::Take(object->NewInstance());
  if (auto* set = vtkPointSet::SafeDownCast(copy)) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    set->SetPoints(points);
  }
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(copy)) grid->Allocate(0);
  add_empty_arrays(attributes_of(object), attributes_of(copy));
  if (auto* set = vtkDataSet::SafeDownCast(object))
    add_empty_arrays(set->GetPointData(), vtkDataSet::SafeDownCast(copy)->GetPointData());
  copy->GetFieldData()->ShallowCopy(object->GetFieldData());
  return copy;
}

}  // namespace breccia::insitu
