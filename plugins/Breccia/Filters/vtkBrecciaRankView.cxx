#include "vtkBrecciaRankView.h"

#include <algorithm>
#include <limits>
#include <map>

#include "brecciaData.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkStreamingDemandDrivenPipeline.h"
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

double Mean(const std::map<vtkTypeInt64, Part>& parts) {
  double sum = 0;
  for (const auto& [number, part] : parts) sum += part.cost;
  return sum / static_cast<double>(std::max<std::size_t>(parts.size(), 1));
}

double Imbalance(const std::map<vtkTypeInt64, Part>& parts) {
  double largest = 0;
  for (const auto& [number, part] : parts) largest = std::max(largest, part.cost);
  return Mean(parts) > 0 ? largest / Mean(parts) - 1 : 0;
}

void FillTable(const std::map<vtkTypeInt64, Part>& parts, vtkTable* table) {
  std::vector<vtkTypeInt64> rank, elements;
  std::vector<double> cost, load;
  const double mean = Mean(parts);
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
  breccia::AddFact(table, "imbalance", Imbalance(parts));
}

/// A line for each frame. Ranks without elements in a frame have the load 0 there.
void FillHistory(const std::map<double, std::map<vtkTypeInt64, Part>>& frames, vtkTable* table) {
  std::vector<double> time, imbalance;
  std::map<vtkTypeInt64, std::vector<double>> load;
  std::map<vtkTypeInt64, std::vector<vtkTypeInt64>> elements;
  for (const auto& [at, parts] : frames) {
    for (const auto& [rank, part] : parts) {
      load[rank].resize(frames.size());
      elements[rank].resize(frames.size());
    }
  }
  for (const auto& [at, parts] : frames) {
    for (const auto& [rank, part] : parts) {
      load[rank][time.size()] = Mean(parts) > 0 ? part.cost / Mean(parts) : 0;
      elements[rank][time.size()] = part.elements;
    }
    time.push_back(at);
    imbalance.push_back(Imbalance(parts));
  }
  breccia::AddColumn(table, "time [s]", time);
  breccia::AddColumn(table, "imbalance", imbalance);
  for (const auto& [rank, values] : load)
    breccia::AddColumn(table, ("load of rank " + std::to_string(rank)).c_str(), values);
  for (const auto& [rank, values] : elements)
    breccia::AddColumn(table, ("elements of rank " + std::to_string(rank)).c_str(), values);
  breccia::AddFact(table, "imbalance", imbalance.empty() ? 0 : *std::max_element(imbalance.begin(), imbalance.end()));
}

}  // namespace

vtkBrecciaRankView::vtkBrecciaRankView() : vtkBrecciaFilter(1, {"vtkUnstructuredGrid", "vtkTable", "vtkTable"}) {}

void vtkBrecciaRankView::Make(vtkDataObject* input, vtkDataObject*, vtkInformationVector* outputs) {
  const breccia::Ranks ranks;
  vtkInformation* out = outputs->GetInformationObject(0);
  vtkInformationDoubleKey* key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
  const double shown = out->Has(key) ? out->Get(key) : 0;
  std::map<vtkTypeInt64, Part> parts = PartsOf(input, ranks);
  std::map<double, std::map<vtkTypeInt64, Part>> frames;
  if (this->OverTime && this->Times.size() > 1 && out->Has(key)) {
    for (const double time : this->Times) frames[time] = PartsOf(this->InputAt(time), ranks);
    this->InputAt(shown);
  } else {
    frames[shown] = parts;
  }
  auto* boxes = vtkUnstructuredGrid::GetData(outputs, 0);
  for (int port = 0; port < 3; ++port) vtkDataObject::GetData(outputs, port)->Initialize();
  if (!ranks.First()) parts.clear();
  auto* table = vtkTable::GetData(outputs, 1);
  FillTable(parts, table);
  FillBoxes(parts, table, boxes);
  if (ranks.First()) FillHistory(frames, vtkTable::GetData(outputs, 2));
}

void vtkBrecciaRankView::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OverTime: " << this->OverTime << "\n";
}
