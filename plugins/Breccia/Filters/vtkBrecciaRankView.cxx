#include "vtkBrecciaRankView.h"

#include <algorithm>
#include <limits>
#include <map>

#include "brecciaData.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkBrecciaRankView);

namespace {

/// A rank's elements.
struct Part {
  vtkTypeInt64 rank = 0, elements = 0;
  double cost = 0;
  double box[6] = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void AddPoint(const double* x) {
    for (int k = 0; k < 3; ++k) {
      box[2 * k] = std::min(box[2 * k], x[k]);
      box[2 * k + 1] = std::max(box[2 * k + 1], x[k]);
    }
  }
  void Add(const Part& other) {
    elements += other.elements;
    cost += other.cost;
    for (int k = 0; k < 3; ++k) {
      box[2 * k] = std::min(box[2 * k], other.box[2 * k]);
      box[2 * k + 1] = std::max(box[2 * k + 1], other.box[2 * k + 1]);
    }
  }
};

std::map<vtkTypeInt64, Part> PartsOf(vtkDataObject* input, const breccia::Ranks& ranks) {
  const breccia::Elements elements = breccia::FindElements(input, ranks);
  std::map<vtkTypeInt64, Part> parts;
  std::string problem;
  try {
    const auto rank = breccia::Integers(elements.grid, "rank");
    const auto cost = breccia::Numbers(elements.grid, "cost");
    for (std::size_t e = 0; e < rank.size(); ++e) {
      Part& part = parts[rank[e]];
      part.rank = rank[e];
      ++part.elements;
      part.cost += cost[e];
      for (std::size_t c = 0; c < 4; ++c) part.AddPoint(&elements.corners[12 * e + 3 * c]);
    }
  } catch (const breccia::BadInput& bad) {
    problem = std::string("elements: ") + bad.what();
  }
  ranks.Agree(problem);
  std::vector<Part> mine;
  for (const auto& [rank, part] : parts) mine.push_back(part);
  std::map<vtkTypeInt64, Part> all;
  for (const Part& part : ranks.Gather(mine)) {
    Part& sum = all[part.rank];
    sum.rank = part.rank;
    sum.Add(part);
  }
  return all;
}

void FillBoxes(const std::map<vtkTypeInt64, Part>& parts, vtkTable* table, vtkUnstructuredGrid* out) {
  vtkNew<vtkPoints> points;
  out->SetPoints(points);
  out->Allocate(static_cast<vtkIdType>(parts.size()));
  constexpr int kCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (const auto& [rank, part] : parts) {
    vtkIdType ids[8];
    for (int c = 0; c < 8; ++c)
      ids[c] =
          points->InsertNextPoint(part.box[kCorners[c][0]], part.box[2 + kCorners[c][1]], part.box[4 + kCorners[c][2]]);
    out->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  }
  out->GetCellData()->ShallowCopy(table->GetRowData());
  out->GetCellData()->SetActiveScalars("load");
}

}  // namespace

vtkBrecciaRankView::vtkBrecciaRankView() : vtkBrecciaFilter(1, {"vtkUnstructuredGrid", "vtkTable"}) {}

void vtkBrecciaRankView::Make(vtkDataObject* input, vtkDataObject*, vtkInformationVector* outputs) {
  const breccia::Ranks ranks;
  std::map<vtkTypeInt64, Part> parts = PartsOf(input, ranks);
  if (!ranks.First()) parts.clear();
  auto* boxes = vtkUnstructuredGrid::GetData(outputs, 0);
  auto* table = vtkTable::GetData(outputs, 1);
  boxes->Initialize();
  table->Initialize();
  std::vector<vtkTypeInt64> rank, elements;
  std::vector<double> cost, load;
  double sum = 0, largest = 0;
  for (const auto& [number, part] : parts) {
    sum += part.cost;
    largest = std::max(largest, part.cost);
  }
  const double mean = sum / static_cast<double>(std::max<std::size_t>(parts.size(), 1));
  for (const auto& [number, part] : parts) {
    rank.push_back(number);
    elements.push_back(part.elements);
    cost.push_back(part.cost);
    load.push_back(mean > 0 ? part.cost / mean : 0);
  }
  breccia::AddColumn(table, "rank", rank);
  breccia::AddColumn(table, "elements", elements);
  breccia::AddColumn(table, "cost", cost);
  breccia::AddColumn(table, "load", load);
  breccia::AddFact(table, "imbalance", mean > 0 ? largest / mean - 1 : 0);
  FillBoxes(parts, table, boxes);
}
