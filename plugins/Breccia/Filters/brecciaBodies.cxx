#include "brecciaBodies.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

namespace breccia {
namespace {

constexpr const char* kNames = "body_names";  // by body

}  // namespace

BodyNames::BodyNames(vtkDataObject* input) {
  for (vtkDataSet* leaf : Leaves(input)) {
    auto* names = vtkStringArray::SafeDownCast(leaf->GetFieldData()->GetAbstractArray(kNames));
    if (!names) continue;
    for (vtkIdType body = 0; body < names->GetNumberOfValues(); ++body) names_.push_back(names->GetValue(body));
    return;
  }
}

std::string BodyNames::Of(vtkTypeInt64 body) const {
  if (body < 0) return {};
  const auto place = static_cast<std::size_t>(body);
  return place < names_.size() ? names_[place] : "body " + std::to_string(body);
}

void AddBodyNames(vtkDataObject* elements, const std::vector<std::string>& names) {
  if (!elements || names.empty()) return;
  vtkNew<vtkStringArray> array;
  array->SetName(kNames);
  for (const std::string& name : names) array->InsertNextValue(name);
  elements->GetFieldData()->AddArray(array);
}

void AddBodyColumn(vtkTable* table, const char* name, const BodyNames& names, const std::vector<vtkTypeInt64>& bodies) {
  vtkNew<vtkStringArray> column;
  column->SetName(name);
  for (const vtkTypeInt64 body : bodies) column->InsertNextValue(names.Of(body));
  table->AddColumn(column);
}

std::map<vtkTypeInt64, vtkTypeInt64> BodiesOfFragments(const Elements& elements,
                                                       const std::vector<vtkTypeInt64>& fragment, const Ranks& ranks) {
  std::vector<std::pair<vtkTypeInt64, vtkTypeInt64>> mine;
  vtkDataArray* array = elements.grid ? elements.grid->GetCellData()->GetArray("body") : nullptr;
  if (array && array->GetNumberOfComponents() == 1) {
    for (std::size_t e = 0; e < elements.id.size(); ++e) {
      if (elements.id[e] == fragment[e])
        mine.emplace_back(fragment[e], static_cast<vtkTypeInt64>(array->GetTuple1(static_cast<vtkIdType>(e))));
    }
  }
  const auto all = ranks.Gather(mine);
  return {all.begin(), all.end()};
}

}  // namespace breccia
