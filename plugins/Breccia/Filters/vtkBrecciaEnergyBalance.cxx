#include "vtkBrecciaEnergyBalance.h"

#include <algorithm>

#include "brecciaData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkBrecciaEnergyBalance);

namespace {

/// Terms of the budget, as history.csv names them.
constexpr const char* kTerms[] = {"kinetic",          "elastic",      "joint elastic",  "contact stored",
                                  "joint mode 1",     "joint mode 2", "joint friction", "contact dissipated",
                                  "contact friction", "plastic",      "viscous",        "damping"};

std::vector<double> ColumnOf(vtkTable* history, const std::string& name) {
  auto* column = vtkDataArray::SafeDownCast(history->GetColumnByName(name.c_str()));
  if (!column) {
    throw breccia::BadInput("the table has no column '" + name +
                            "' (is it the history of a run, the reader's second output?)");
  }
  std::vector<double> values;
  for (vtkIdType i = 0; i < column->GetNumberOfTuples(); ++i) values.push_back(column->GetComponent(i, 0));
  return values;
}

}  // namespace

vtkBrecciaEnergyBalance::vtkBrecciaEnergyBalance() : vtkBrecciaFilter(1, {"vtkTable"}) {}

void vtkBrecciaEnergyBalance::Make(vtkDataObject* input, vtkDataObject*, vtkInformationVector* outputs) {
  auto* table = vtkTable::GetData(outputs, 0);
  table->Initialize();
  auto* history = vtkTable::SafeDownCast(input);
  const breccia::Ranks ranks;
  ranks.Agree(history ? "" : "a table is needed: the history of a run, the reader's second output");
  if (!ranks.First() && history->GetNumberOfColumns() == 0) return;
  const std::vector<double> time = ColumnOf(history, "time [s]");
  breccia::AddColumn(table, "time [s]", time);
  std::vector<double> sum(time.size());
  std::vector<std::pair<std::string, std::vector<double>>> stacked;
  for (const std::string term : kTerms) {
    const std::vector<double> values = ColumnOf(history, term + " [J]");
    if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0; })) continue;
    breccia::AddColumn(table, (term + " [J]").c_str(), values);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values[i];
    stacked.emplace_back("up to " + term + " [J]", sum);
  }
  for (const auto& [name, values] : stacked) breccia::AddColumn(table, name.c_str(), values);
  breccia::AddColumn(table, "external work [J]", ColumnOf(history, "external work [J]"));
  breccia::AddColumn(table, "residual [J]", ColumnOf(history, "residual [J]"));
  breccia::AddColumn(table, "relative residual", ColumnOf(history, "relative residual"));
}
