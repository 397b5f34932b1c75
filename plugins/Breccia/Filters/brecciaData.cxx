#include "brecciaData.h"

#include <algorithm>

#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkTable.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

namespace breccia {
namespace {

vtkDataArray* ArrayOf(vtkDataSet* part, const char* name, int components) {
  if (!part || part->GetNumberOfCells() == 0) return nullptr;
  vtkDataArray* array = part->GetCellData()->GetArray(name);
  if (!array) throw BadInput("the cells have no array '" + std::string(name) + "'; there is: " + Describe(part));
  if (array->GetNumberOfComponents() != components) {
    throw BadInput("the cell array '" + std::string(name) + "' has " + std::to_string(array->GetNumberOfComponents()) +
                   " components instead of " + std::to_string(components));
  }
  return array;
}

template <class T>
std::vector<T> Values(vtkDataArray* array, bool same_type) {
  if (!array) return {};
  const vtkIdType n = array->GetNumberOfValues();
  std::vector<T> values(static_cast<std::size_t>(n));
  if (same_type && array->HasStandardMemoryLayout()) {
    const T* from = static_cast<const T*>(array->GetVoidPointer(0));
    std::copy(from, from + n, values.begin());
    return values;
  }
  const int width = array->GetNumberOfComponents();
  for (vtkIdType i = 0; i < n; ++i)
    values[static_cast<std::size_t>(i)] = static_cast<T>(array->GetComponent(i / width, static_cast<int>(i % width)));
  return values;
}

bool IsInt64(const vtkDataArray* array) {
  const int type = array->GetDataType();
  return type == VTK_LONG_LONG || (type == VTK_LONG && sizeof(long) == 8) ||
         (type == VTK_ID_TYPE && sizeof(vtkIdType) == 8);
}

/// In a run in which nothing is damaged yet the joints have no cells, and in files no arrays.
bool HasEmptyJoints(vtkDataObject* where) {
  if (auto* set = vtkDataSet::SafeDownCast(where)) return set->GetNumberOfCells() == 0;
  auto* tree = vtkCompositeDataSet::SafeDownCast(where);
  if (!tree) return false;
  vtkSmartPointer<vtkCompositeDataIterator> it;
  it.TakeReference(tree->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem()) {
    auto* leaf = vtkDataSet::SafeDownCast(it->GetCurrentDataObject());
    const char* name = it->HasCurrentMetaData() ? it->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME()) : nullptr;
    if (leaf && leaf->GetNumberOfCells() == 0 && name &&
        (std::string(name) == "joints" || std::string(name) == "fractures"))
      return true;
  }
  return false;
}

/// Also of ids whose difference is no int64. @pre from <= to
std::size_t Distance(vtkTypeInt64 from, vtkTypeInt64 to) {
  return static_cast<std::size_t>(to) - static_cast<std::size_t>(from);
}

}  // namespace

void Ranks::Largest(std::vector<double>& values) const {
  if (Count() == 1 || values.empty()) return;
  std::vector<double> all(values.size());
  controller_->AllReduce(values.data(), all.data(), static_cast<vtkIdType>(values.size()), vtkCommunicator::MAX_OP);
  values = all;
}

void Ranks::Agree(const std::string& problem) const {
  std::vector<char> mine(problem.begin(), problem.end());
  if (!mine.empty()) mine.push_back('\0');
  const std::vector<char> all = Gather(mine);
  if (!all.empty()) throw BadInput(all.data());
}

std::vector<char> Ranks::GatherBytes(const char* mine, vtkIdType length) const {
  std::vector<vtkIdType> lengths(static_cast<std::size_t>(Count())), offsets(lengths.size());
  controller_->AllGather(&length, lengths.data(), 1);
  vtkIdType total = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    offsets[i] = total;
    total += lengths[i];
  }
  std::vector<char> all(static_cast<std::size_t>(total));
  if (total > 0) controller_->AllGatherV(mine, all.data(), length, lengths.data(), offsets.data());
  return all;
}

std::vector<vtkDataSet*> Leaves(vtkDataObject* input) {
  std::vector<vtkDataSet*> leaves;
  if (auto* tree = vtkCompositeDataSet::SafeDownCast(input)) {
    vtkSmartPointer<vtkCompositeDataIterator> it;
    it.TakeReference(tree->NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem()) {
      if (auto* leaf = vtkDataSet::SafeDownCast(it->GetCurrentDataObject())) leaves.push_back(leaf);
    }
  } else if (auto* set = vtkDataSet::SafeDownCast(input)) {
    leaves.push_back(set);
  }
  return leaves;
}

vtkSmartPointer<vtkDataSet> FindPart(vtkDataObject* input, const char* mark) {
  std::vector<vtkDataSet*> found;
  for (vtkDataSet* leaf : Leaves(input)) {
    if (leaf->GetNumberOfCells() > 0 && leaf->GetCellData()->HasArray(mark)) found.push_back(leaf);
  }
  if (found.empty()) return nullptr;
  if (found.size() == 1) return found.front();
  vtkNew<vtkAppendFilter> append;
  for (vtkDataSet* leaf : found) append->AddInputData(leaf);
  append->Update();
  return append->GetOutput();
}

bool LacksBlock(vtkDataObject* input, const char* name, const char* mark) {
  auto* tree = vtkCompositeDataSet::SafeDownCast(input);
  if (!tree) {
    auto* set = vtkDataSet::SafeDownCast(input);
    return set && !set->GetCellData()->HasArray(mark);
  }
  bool lacks = false;  // an input without any data set, as on a rank without a part, is ignored
  vtkSmartPointer<vtkCompositeDataIterator> it;
  it.TakeReference(tree->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem()) {
    auto* leaf = vtkDataSet::SafeDownCast(it->GetCurrentDataObject());
    const char* its = it->HasCurrentMetaData() ? it->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME()) : nullptr;
    if (!leaf || !its || std::string(its) == name || leaf->GetCellData()->HasArray(mark)) return false;
    lacks = true;
  }
  return lacks;
}

std::string Describe(vtkDataObject* input) {
  std::string text;
  for (vtkDataSet* leaf : Leaves(input)) {
    for (int i = 0; i < leaf->GetCellData()->GetNumberOfArrays(); ++i) {
      const char* name = leaf->GetCellData()->GetArrayName(i);
      if (name && text.find(name) == std::string::npos) text += (text.empty() ? "" : ", ") + std::string(name);
    }
  }
  return text.empty() ? "no cell array" : text;
}

std::vector<vtkTypeInt64> Integers(vtkDataSet* part, const char* name, int components) {
  vtkDataArray* array = ArrayOf(part, name, components);
  return Values<vtkTypeInt64>(array, array && IsInt64(array));
}

std::vector<double> Numbers(vtkDataSet* part, const char* name, int components) {
  vtkDataArray* array = ArrayOf(part, name, components);
  return Values<double>(array, array && array->GetDataType() == VTK_DOUBLE);
}

std::vector<double> Corners(vtkDataSet* part, int count) {
  std::vector<double> corners;
  if (!part) return corners;
  const vtkIdType cells = part->GetNumberOfCells();
  corners.resize(static_cast<std::size_t>(cells * count * 3));
  vtkNew<vtkIdList> space;
  for (vtkIdType cell = 0; cell < cells; ++cell) {
    vtkIdType n = 0;
    const vtkIdType* points = nullptr;
    part->GetCellPoints(cell, n, points, space);
    if (n != count) {
      throw BadInput("cell " + std::to_string(cell) + " has " + std::to_string(n) + " corners instead of " +
                     std::to_string(count));
    }
    for (int c = 0; c < count; ++c)
      part->GetPoint(points[c], &corners[static_cast<std::size_t>((cell * count + c) * 3)]);
  }
  return corners;
}

Elements FindElements(vtkDataObject* input, const Ranks& ranks) {
  Elements elements;
  std::string problem;
  double found = 0;
  try {
    elements.grid = FindPart(input, "neighbour");
    if (elements.grid) {
      found = 1;
      elements.id = Integers(elements.grid, "id");
      elements.neighbour = Integers(elements.grid, "neighbour", 4);
      elements.corners = Corners(elements.grid, 4);
    }
  } catch (const BadInput& bad) {
    problem = std::string("elements: ") + bad.what();
  }
  std::vector<double> anywhere{found};
  ranks.Largest(anywhere);
  if (problem.empty() && anywhere[0] == 0) {
    problem =
        "no elements: a block of tetrahedra with the cell arrays 'id' and 'neighbour' is needed (the channel "
        "'elements' of a run, "
        "by a Breccia that writes 'neighbour'); there is: " +
        Describe(input);
  }
  ranks.Agree(problem);
  return elements;
}

Cracks FindCracks(vtkDataObject* input, vtkDataObject* joints, const Ranks& ranks) {
  Cracks cracks;
  std::string problem;
  vtkDataObject* where = joints ? joints : input;
  try {
    cracks.grid = FindPart(where, "broken");
    const std::vector<vtkTypeInt64> broken = Integers(cracks.grid, "broken"), id = Integers(cracks.grid, "id"),
                                    mode = Integers(cracks.grid, "mode");
    const std::vector<double> time = Numbers(cracks.grid, "time_of_failure"), corners = Corners(cracks.grid, 3);
    for (std::size_t i = 0; i < broken.size(); ++i) {
      if (broken[i] == 0) continue;
      if (id[i] < 0)  // 4 element + face
        throw BadInput("the cell array 'id' has the value " + std::to_string(id[i]) + "; ids of joints are 0 or more");
      cracks.cell.push_back(static_cast<vtkIdType>(i));
      cracks.id.push_back(id[i]);
      cracks.mode.push_back(mode[i]);
      cracks.time.push_back(time[i]);
      cracks.corners.insert(cracks.corners.end(), corners.begin() + static_cast<std::ptrdiff_t>(9 * i),
                            corners.begin() + static_cast<std::ptrdiff_t>(9 * i + 9));
    }
  } catch (const BadInput& bad) {
    problem = std::string("joints: ") + bad.what();
  }
  std::vector<double> anywhere{cracks.grid || HasEmptyJoints(where) ? 1.0 : 0.0};
  ranks.Largest(anywhere);
  if (problem.empty() && anywhere[0] == 0) {
    problem =
        "no joints: a block of triangles with the cell arrays 'id', 'broken', 'mode' and 'time_of_failure' is needed "
        "(the "
        "channel 'joints' or 'fractures' of a run), in the input or as a second one; there is: " +
        Describe(where);
  }
  ranks.Agree(problem);
  return cracks;
}

IdIndex::IdIndex(const std::vector<vtkTypeInt64>& ids) {
  if (ids.empty()) return;
  const auto [low, high] = std::minmax_element(ids.begin(), ids.end());
  first_ = *low;
  if (const std::size_t last = Distance(first_, *high); last <= 8 * ids.size() + 1024) {
    place_.assign(last + 1, -1);
    for (std::size_t i = 0; i < ids.size(); ++i) place_[Distance(first_, ids[i])] = static_cast<vtkIdType>(i);
    return;
  }
  for (std::size_t i = 0; i < ids.size(); ++i) sorted_.emplace_back(ids[i], static_cast<vtkIdType>(i));
  std::sort(sorted_.begin(), sorted_.end());
}

vtkIdType IdIndex::Find(vtkTypeInt64 id) const {
  if (!place_.empty()) {
    return id >= first_ && Distance(first_, id) < place_.size() ? place_[Distance(first_, id)] : -1;
  }
  const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<vtkTypeInt64, vtkIdType>(id, -1));
  return found != sorted_.end() && found->first == id ? found->second : -1;
}

void AddColumn(vtkTable* table, const char* name, const std::vector<double>& values, int components) {
  vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  column->SetNumberOfComponents(components);
  column->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), column->GetPointer(0));
  table->AddColumn(column);
}

void AddColumn(vtkTable* table, const char* name, const std::vector<vtkTypeInt64>& values) {
  vtkNew<vtkTypeInt64Array> column;
  column->SetName(name);
  column->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), column->GetPointer(0));
  table->AddColumn(column);
}

void AddFact(vtkDataObject* object, const char* name, double value) {
  vtkNew<vtkDoubleArray> fact;
  fact->SetName(name);
  fact->InsertNextValue(value);
  object->GetFieldData()->AddArray(fact);
}

}  // namespace breccia
