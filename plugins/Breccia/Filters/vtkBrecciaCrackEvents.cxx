#include "vtkBrecciaCrackEvents.h"

#include <algorithm>
#include <cmath>

#include "brecciaEvents.h"
#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkBrecciaCrackEvents);

namespace {

using breccia::CrackEvent;

void FillTable(const std::vector<CrackEvent>& events, vtkTable* table) {
  std::vector<vtkTypeInt64> id, joints;
  for (const CrackEvent& event : events) {
    id.push_back(event.id);
    joints.push_back(event.joints);
  }
  breccia::AddColumn(table, "event", id);
  breccia::AddColumn(table, "joints", joints);
  const auto number = [&](const char* name, auto&& of) {
    std::vector<double> values;
    for (const CrackEvent& event : events) values.push_back(of(event));
    breccia::AddColumn(table, name, values);
  };
  const auto several = [&](const char* name, int components, auto&& of) {
    std::vector<double> values;
    for (const CrackEvent& event : events) {
      const auto all = of(event);
      values.insert(values.end(), all.begin(), all.end());
    }
    breccia::AddColumn(table, name, values, components);
  };
  number("time", [](const CrackEvent& e) { return e.time; });
  number("duration", [](const CrackEvent& e) { return e.duration; });
  number("area", [](const CrackEvent& e) { return e.area; });
  number("energy", [](const CrackEvent& e) { return e.energy; });
  several("centre", 3, [](const CrackEvent& e) { return e.centre; });
  several("moment_tensor", 6, [](const CrackEvent& e) { return e.moment; });
  number("scalar_moment", [](const CrackEvent& e) { return e.ScalarMoment(); });
  number("magnitude", [](const CrackEvent& e) { return e.Magnitude(); });
  number("energy_magnitude", [](const CrackEvent& e) { return e.EnergyMagnitude(); });
  number("isotropic_part", [](const CrackEvent& e) { return e.Parts()[0]; });
  number("double_couple_part", [](const CrackEvent& e) { return e.Parts()[1]; });
  number("clvd_part", [](const CrackEvent& e) { return e.Parts()[2]; });
}

void FillPoints(const std::vector<CrackEvent>& events, vtkTable* table, vtkPolyData* out) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> verts;
  for (const CrackEvent& event : events) {
    const vtkIdType id = points->InsertNextPoint(event.centre.data());
    verts->InsertNextCell(1, &id);
  }
  out->SetPoints(points);
  out->SetVerts(verts);
  out->GetPointData()->ShallowCopy(table->GetRowData());
}

/// Events of each magnitude, and of it or more, with the fitted line.
void FillMagnitudes(const std::vector<double>& magnitudes, double completeness, vtkTable* table) {
  const breccia::MagnitudeFit fit = breccia::FitMagnitudes(magnitudes, completeness);
  std::vector<double> sorted;
  std::copy_if(magnitudes.begin(), magnitudes.end(), std::back_inserter(sorted),
               [](double m) { return std::isfinite(m); });
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> from, number, line;
  for (double m = sorted.empty() ? 1 : std::floor(sorted.front() / breccia::kMagnitudeBin) * breccia::kMagnitudeBin;
       !sorted.empty() && m <= sorted.back(); m += breccia::kMagnitudeBin) {
    from.push_back(m);
    number.push_back(static_cast<double>(sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), m - 1e-9)));
    line.push_back(std::pow(10.0, fit.a - fit.b * m));
  }
  breccia::AddColumn(table, "magnitude", from);
  breccia::AddColumn(table, "events_of_it_or_more", number);
  breccia::AddColumn(table, "gutenberg_richter", line);
  breccia::AddFact(table, "b_value", fit.b);
  breccia::AddFact(table, "b_error", fit.error);
  breccia::AddFact(table, "a_value", fit.a);
  breccia::AddFact(table, "completeness", fit.completeness);
}

double Auto(double given, double otherwise) { return given > 0 ? given : otherwise; }

}  // namespace

vtkBrecciaCrackEvents::vtkBrecciaCrackEvents() : vtkBrecciaFilter(2, {"vtkPolyData", "vtkTable", "vtkTable"}) {}

void vtkBrecciaCrackEvents::Make(vtkDataObject* input, vtkDataObject* given, vtkInformationVector* outputs) {
  const breccia::Ranks ranks;
  const breccia::Cracks cracks = breccia::FindCracks(input, given, ranks);
  std::vector<breccia::FailedJoint> joints = breccia::AllFailed(cracks, true, ranks);
  std::vector<double> has_elements{breccia::FindPart(input, "neighbour") ? 1.0 : 0.0};
  ranks.Largest(has_elements);
  if (has_elements[0] > 0) breccia::SetJumps(breccia::FindElements(input, ranks), ranks, joints);
  if (!ranks.First()) joints.clear();

  double area = 0;
  for (const breccia::FailedJoint& joint : joints) area += joint.area;
  const double mean_area = joints.empty() ? 1 : area / static_cast<double>(joints.size());
  const double distance = Auto(this->Distance, 2 * std::sqrt(mean_area));
  const double duration = Auto(this->Duration, distance / Auto(this->WaveSpeed, 3000));
  const double nu = this->PoissonsRatio, mu = this->YoungsModulus / (2 * (1 + nu));
  const std::vector<CrackEvent> events = breccia::EventsOf(joints, distance, duration, 2 * mu * nu / (1 - 2 * nu), mu);

  for (int port = 0; port < 3; ++port) vtkDataObject::GetData(outputs, port)->Initialize();
  auto* table = vtkTable::GetData(outputs, 1);
  FillTable(events, table);
  FillPoints(events, table, vtkPolyData::GetData(outputs, 0));
  double energy = 0;
  std::vector<double> magnitudes;
  for (const CrackEvent& event : events) {
    energy += event.energy;
    magnitudes.push_back(this->MagnitudeOf == OF_ENERGY ? event.EnergyMagnitude() : event.Magnitude());
  }
  breccia::AddFact(table, "energy", energy);
  FillMagnitudes(magnitudes, this->Completeness, vtkTable::GetData(outputs, 2));
}

void vtkBrecciaCrackEvents::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Distance: " << this->Distance << "\n"
     << indent << "Duration: " << this->Duration << "\n"
     << indent << "WaveSpeed: " << this->WaveSpeed << "\n"
     << indent << "YoungsModulus: " << this->YoungsModulus << "\n"
     << indent << "PoissonsRatio: " << this->PoissonsRatio << "\n"
     << indent << "MagnitudeOf: " << this->MagnitudeOf << "\n"
     << indent << "Completeness: " << this->Completeness << "\n";
}
