#include "vtkBrecciaCrackEvents.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "brecciaEvents.h"
#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
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
  out->GetPointData()->SetActiveScalars("time");
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

/// A failed joint between two frames of the run.
struct Failure {
  double before, after;  ///< s
  breccia::FacePair first, second;
};

}  // namespace

vtkBrecciaCrackEvents::vtkBrecciaCrackEvents() : vtkBrecciaFilter(2, {"vtkPolyData", "vtkTable", "vtkTable"}) {}

void vtkBrecciaCrackEvents::GoToFailures(std::vector<breccia::FailedJoint>& joints, double shown) {
  const breccia::Ranks ranks;
  std::map<double, std::vector<std::size_t>> frames;  // joints that failed just before or after them
  std::vector<Failure> failures;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto next = std::lower_bound(this->Times.begin(), this->Times.end(), joints[i].time);
    const auto after = next == this->Times.end() ? next - 1 : next;
    const auto before = after == this->Times.begin() ? after : after - 1;
    failures.push_back({*before, *after, {}, {}});
    frames[*before].push_back(i);
    if (after != before) frames[*after].push_back(i);
  }
  for (const auto& [time, failed] : frames) {
    std::vector<breccia::FailedJoint> near;
    for (const std::size_t i : failed) near.push_back(joints[i]);
    const auto faces = breccia::FacesOf(breccia::FindElements(this->InputAt(time), ranks), ranks, near);
    for (std::size_t n = 0; n < failed.size(); ++n) {
      Failure& failure = failures[failed[n]];
      if (failure.before == time) failure.first = faces[n];
      if (failure.after == time) failure.second = faces[n];
    }
  }
  this->InputAt(shown);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const double between = failures[i].after - failures[i].before;
    const double share = between > 0 ? std::clamp((joints[i].time - failures[i].before) / between, 0.0, 1.0) : 0;
    breccia::SetPlace(breccia::Between(failures[i].first, failures[i].second, share), joints[i]);
  }
}

void vtkBrecciaCrackEvents::Make(vtkDataObject* input, vtkDataObject* given, vtkInformationVector* outputs) {
  const breccia::Ranks ranks;
  const breccia::Cracks cracks = breccia::FindCracks(input, given, ranks);
  std::vector<breccia::FailedJoint> joints = breccia::AllFailed(cracks, true, ranks);
  const double damage_energy = breccia::EnergyOfDamage(cracks, ranks);
  std::vector<double> has_elements{breccia::FindPart(input, "neighbour") ? 1.0 : 0.0};
  ranks.Largest(has_elements);
  vtkInformation* out = outputs->GetInformationObject(0);
  vtkInformationDoubleKey* key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
  if (has_elements[0] > 0 && this->MomentAt == AT_FAILURE && this->Times.size() > 1 && out->Has(key)) {
    this->GoToFailures(joints, out->Get(key));
  } else if (has_elements[0] > 0) {
    const auto faces = breccia::FacesOf(breccia::FindElements(input, ranks), ranks, joints);
    for (std::size_t i = 0; i < faces.size(); ++i) breccia::SetJump(faces[i], joints[i]);
  }
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
  breccia::AddFact(table, "energy_of_damage", damage_energy);
  breccia::AddFact(table, "fracture_energy", energy + damage_energy);
  breccia::AddFact(table, "linking_distance", distance);
  breccia::AddFact(table, "linking_time", duration);
  breccia::AddFact(table, "at_time_shown", this->MomentAt == AT_TIME_SHOWN ? 1 : 0);
  breccia::AddFact(table, "magnitude_of_energy", this->MagnitudeOf == OF_ENERGY ? 1 : 0);
  FillMagnitudes(magnitudes, this->Completeness, vtkTable::GetData(outputs, 2));
}

void vtkBrecciaCrackEvents::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Distance: " << this->Distance << "\n"
     << indent << "Duration: " << this->Duration << "\n"
     << indent << "WaveSpeed: " << this->WaveSpeed << "\n"
     << indent << "YoungsModulus: " << this->YoungsModulus << "\n"
     << indent << "PoissonsRatio: " << this->PoissonsRatio << "\n"
     << indent << "MomentAt: " << this->MomentAt << "\n"
     << indent << "MagnitudeOf: " << this->MagnitudeOf << "\n"
     << indent << "Completeness: " << this->Completeness << "\n";
}
