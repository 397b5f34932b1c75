#include "vtkBrecciaFractureSurface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "brecciaOrientation.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkBrecciaFractureSurface);

namespace {

constexpr int kBins = 18;             // of a rose over 180 degrees
constexpr double kMergeShare = 0.05;  // of the shortest edge: closer corners are one

bool IsWanted(vtkTypeInt64 mode, int wanted) { return wanted == 0 || mode == wanted; }

vtkSmartPointer<vtkDoubleArray> Array(vtkFieldData* to, const char* name, vtkIdType n, int components = 1) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(n);
  to->AddArray(array);
  return array;
}

double ShortestEdge(const std::vector<double>& corners) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t + 9 <= corners.size(); t += 9) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double *a = &corners[t + 3 * i], *b = &corners[t + 3 * ((i + 1) % 3)];
      shortest = std::min(shortest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
  }
  return shortest;
}

/// The triangles of this rank, with the joints' arrays and their orientation.
void FillSurface(const breccia::Cracks& cracks, int mode, int up, vtkPolyData* out) {
  vtkNew<vtkPolyData> surface;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  std::vector<std::size_t> chosen;
  std::vector<double> corners;
  for (std::size_t i = 0; i < cracks.id.size(); ++i) {
    if (!IsWanted(cracks.mode[i], mode)) continue;
    chosen.push_back(i);
    const double* x = &cracks.corners[9 * i];
    corners.insert(corners.end(), x, x + 9);
    vtkIdType ids[3];
    for (int c = 0; c < 3; ++c) ids[c] = points->InsertNextPoint(x + 3 * c);
    triangles->InsertNextCell(3, ids);
  }
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  const auto n = static_cast<vtkIdType>(chosen.size());
  if (cracks.grid) {
    surface->GetCellData()->CopyAllocate(cracks.grid->GetCellData(), n);
    for (vtkIdType i = 0; i < n; ++i)
      surface->GetCellData()->CopyData(cracks.grid->GetCellData(), cracks.cell[chosen[static_cast<std::size_t>(i)]], i);
  }
  const auto area = Array(surface->GetCellData(), "area", n), strike = Array(surface->GetCellData(), "strike", n),
             dip = Array(surface->GetCellData(), "dip", n),
             direction = Array(surface->GetCellData(), "dip_direction", n);
  for (vtkIdType i = 0; i < n; ++i) {
    breccia::Vector normal = breccia::AreaVector(&cracks.corners[9 * chosen[static_cast<std::size_t>(i)]]);
    const double size = breccia::Length(normal);
    for (double& x : normal) x = size > 0 ? x / size : 0;
    const breccia::Orientation o = breccia::OrientationOf(normal, up);
    area->SetValue(i, size);
    strike->SetValue(i, o.strike);
    dip->SetValue(i, o.dip);
    direction->SetValue(i, o.dip_direction);
  }
  if (n == 0) {
    out->ShallowCopy(surface);
    return;
  }
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(surface);
  clean->ToleranceIsAbsoluteOn();
  clean->SetAbsoluteTolerance(kMergeShare * ShortestEdge(corners));
  clean->ConvertPolysToLinesOff();
  clean->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  clean->Update();
  out->ShallowCopy(clean->GetOutput());
  out->GetCellData()->SetActiveScalars("time_of_failure");
}

void FillRose(const std::vector<breccia::FailedJoint>& joints, int up, vtkTable* table) {
  std::vector<double> from(kBins), all(kBins), opened(kBins), sheared(kBins), mixed(kBins);
  for (std::size_t bin = 0; bin < kBins; ++bin) from[bin] = 180.0 / kBins * static_cast<double>(bin);
  for (const breccia::FailedJoint& joint : joints) {
    const double share = breccia::OrientationOf(joint.normal, up).strike / 180 * kBins;
    const auto bin = static_cast<std::size_t>(std::clamp(share, 0.0, kBins - 1.0));
    all[bin] += joint.area;
    if (joint.mode == 1) opened[bin] += joint.area;
    if (joint.mode == 2) sheared[bin] += joint.area;
    if (joint.mode == 3) mixed[bin] += joint.area;
  }
  breccia::AddColumn(table, "strike_from", from);
  breccia::AddColumn(table, "area", all);
  breccia::AddColumn(table, "area_mode_1", opened);
  breccia::AddColumn(table, "area_mode_2", sheared);
  breccia::AddColumn(table, "area_mixed", mixed);
}

void FillStereonet(const std::vector<breccia::FailedJoint>& joints, int up, vtkPolyData* net) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> verts;
  const auto n = static_cast<vtkIdType>(joints.size());
  const auto area = Array(net->GetPointData(), "area", n), time = Array(net->GetPointData(), "time_of_failure", n),
             mode = Array(net->GetPointData(), "mode", n);
  for (vtkIdType i = 0; i < n; ++i) {
    const breccia::FailedJoint& joint = joints[static_cast<std::size_t>(i)];
    const breccia::Orientation o = breccia::OrientationOf(joint.normal, up);
    const vtkIdType id = points->InsertNextPoint(o.x, o.y, 0);
    verts->InsertNextCell(1, &id);
    area->SetValue(i, joint.area);
    time->SetValue(i, joint.time);
    mode->SetValue(i, static_cast<double>(joint.mode));
  }
  net->SetPoints(points);
  net->SetVerts(verts);
}

void FillTips(const std::vector<breccia::Tip>& tips, vtkTable* table) {
  std::vector<double> time, distance, speed, position;
  for (const breccia::Tip& tip : tips) {
    time.push_back(tip.time);
    distance.push_back(tip.distance);
    speed.push_back(tip.speed);
    position.insert(position.end(), tip.position.begin(), tip.position.end());
  }
  breccia::AddColumn(table, "time", time);
  breccia::AddColumn(table, "distance", distance);
  breccia::AddColumn(table, "speed", speed);
  breccia::AddColumn(table, "position", position, 3);
  breccia::AddFact(table, "mean_speed", breccia::MeanSpeed(tips));
}

}  // namespace

vtkBrecciaFractureSurface::vtkBrecciaFractureSurface()
    : vtkBrecciaFilter(2, {"vtkPolyData", "vtkTable", "vtkPolyData", "vtkTable"}) {}

void vtkBrecciaFractureSurface::Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) {
  const breccia::Ranks ranks;
  const breccia::Cracks cracks = breccia::FindCracks(input, joints, ranks);
  std::vector<breccia::FailedJoint> all = breccia::AllFailed(cracks, false, ranks);
  all.erase(
      std::remove_if(all.begin(), all.end(), [&](const auto& joint) { return !IsWanted(joint.mode, this->Mode); }),
      all.end());
  auto* surface = vtkPolyData::GetData(outputs, 0);
  for (int port = 0; port < 4; ++port) vtkDataObject::GetData(outputs, port)->Initialize();
  FillSurface(cracks, this->Mode, this->Up, surface);
  const breccia::Roughness roughness = breccia::RoughnessOf(all);
  breccia::AddFact(surface, "fracture_area", roughness.area);
  breccia::AddFact(surface, "projected_area", roughness.projected_area);
  breccia::AddFact(surface, "rms_height", roughness.rms_height);
  if (!ranks.First()) all.clear();
  FillRose(all, this->Up, vtkTable::GetData(outputs, 1));
  if (!ranks.First()) vtkTable::GetData(outputs, 1)->Initialize();
  FillStereonet(all, this->Up, vtkPolyData::GetData(outputs, 2));
  FillTips(breccia::TipsOf(all), vtkTable::GetData(outputs, 3));
}

void vtkBrecciaFractureSurface::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mode: " << this->Mode << "\n" << indent << "Up: " << this->Up << "\n";
}
