#include "vtkBrecciaCrackEvents.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "brecciaEvents.h"
#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
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

/// Grows when anything that the input comes from is modified; not with the time asked for.
vtkMTimeType StateOf(vtkAlgorithm* filter) {
  auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(filter->GetInputExecutive(0, 0));
  return pipeline ? pipeline->GetPipelineMTime() : 0;
}

}  // namespace

struct vtkBrecciaCrackEvents::Walk {
  /// A failed joint between two frames of the run.
  struct Failure {
    double before = 0, after = 0;  ///< s
    breccia::FacePair first, second;
  };
  double shown = 0;          ///< s
  vtkMTimeType state = 0;    ///< of what the input comes from
  double damage_energy = 0;  ///< J, in joints that hold
  std::vector<breccia::FailedJoint> joints;
  std::vector<Failure> failures;  ///< of each joint; none where the positions of the time shown are taken
  std::vector<double> pending;    ///< s, frames that are still to be read, the last one next
};

vtkBrecciaCrackEvents::vtkBrecciaCrackEvents() : vtkBrecciaFilter(2, {"vtkPolyData", "vtkTable", "vtkTable"}) {}

vtkBrecciaCrackEvents::~vtkBrecciaCrackEvents() = default;

int vtkBrecciaCrackEvents::RequestInformation(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*) {
  vtkInformation* info = inputs[0]->GetInformationObject(0);
  vtkInformationDoubleVectorKey* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  this->Times.clear();
  if (info->Has(key)) this->Times.assign(info->Get(key), info->Get(key) + info->Length(key));
  return 1;
}

int vtkBrecciaCrackEvents::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
                                               vtkInformationVector* outputs) {
  if (!this->Frames) return 1;
  vtkInformationDoubleKey* key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
  vtkInformation* out = outputs->GetInformationObject(0);
  if ((out->Has(key) && out->Get(key) != this->Frames->shown) || StateOf(this) != this->Frames->state) {
    this->Frames.reset();  // what an error in the input has left
    return 1;
  }
  inputs[0]->GetInformationObject(0)->Set(key, this->Frames->pending.back());
  return 1;
}

int vtkBrecciaCrackEvents::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                       vtkInformationVector* outputs) {
  vtkInformationDoubleKey* key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
  vtkInformationIntegerKey* again = vtkStreamingDemandDrivenPipeline::CONTINUE_EXECUTING();
  request->Remove(again);
  try {
    vtkInformation* out = outputs->GetInformationObject(0);
    vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
    if (this->Frames)
      this->Visit(input);
    else
      this->Begin(input, vtkDataObject::GetData(inputs[1], 0), out->Has(key) ? out->Get(key) : 0);
    if (!this->Frames->pending.empty()) {
      request->Set(again, 1);
      return 1;
    }
    this->Finish(outputs);
    for (int port = 0; port < 3 && out->Has(key); ++port)
      vtkDataObject::GetData(outputs, port)->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), out->Get(key));
    this->Frames.reset();
    return 1;
  } catch (const breccia::BadInput& bad) {
    this->Frames.reset();
    vtkErrorMacro(<< bad.what());
    return 0;
  }
}

void vtkBrecciaCrackEvents::Begin(vtkDataObject* input, vtkDataObject* given, double shown) {
  const breccia::Ranks ranks;
  auto walk = std::make_unique<Walk>();
  walk->shown = shown;
  walk->state = StateOf(this);
  const breccia::Cracks cracks = breccia::FindCracks(input, given, ranks);
  walk->joints = breccia::AllFailed(cracks, true, ranks);
  walk->damage_energy = breccia::EnergyOfDamage(cracks, ranks);
  std::vector<double> has_elements{breccia::FindPart(input, "neighbour") ? 1.0 : 0.0};
  ranks.Largest(has_elements);
  this->Frames = std::move(walk);
  if (!(has_elements[0] > 0)) return;
  if (this->MomentAt == AT_TIME_SHOWN || this->Times.size() < 2) {
    const auto faces = breccia::FacesOf(breccia::FindElements(input, ranks), ranks, this->Frames->joints);
    for (std::size_t i = 0; i < faces.size(); ++i) breccia::SetJump(faces[i], this->Frames->joints[i]);
    return;
  }
  std::set<double> needed;
  for (const breccia::FailedJoint& joint : this->Frames->joints) {
    const auto next = std::lower_bound(this->Times.begin(), this->Times.end(), joint.time);
    const auto after = next == this->Times.end() ? next - 1 : next;
    const auto before = after == this->Times.begin() ? after : after - 1;
    this->Frames->failures.push_back({*before, *after, {}, {}});
    needed.insert({*before, *after});
  }
  this->Frames->pending.assign(needed.rbegin(), needed.rend());
}

void vtkBrecciaCrackEvents::Visit(vtkDataObject* input) {
  const breccia::Ranks ranks;
  Walk& walk = *this->Frames;
  const double time = walk.pending.back();
  walk.pending.pop_back();
  std::vector<std::size_t> place;
  std::vector<breccia::FailedJoint> joints;
  for (std::size_t i = 0; i < walk.joints.size(); ++i) {
    if (walk.failures[i].before != time && walk.failures[i].after != time) continue;
    place.push_back(i);
    joints.push_back(walk.joints[i]);
  }
  const auto faces = breccia::FacesOf(breccia::FindElements(input, ranks), ranks, joints);
  for (std::size_t n = 0; n < place.size(); ++n) {
    Walk::Failure& failure = walk.failures[place[n]];
    if (failure.before == time) failure.first = faces[n];
    if (failure.after == time) failure.second = faces[n];
  }
}

void vtkBrecciaCrackEvents::Finish(vtkInformationVector* outputs) {
  std::vector<breccia::FailedJoint>& joints = this->Frames->joints;
  for (std::size_t i = 0; i < this->Frames->failures.size(); ++i) {
    const Walk::Failure& failure = this->Frames->failures[i];
    const double between = failure.after - failure.before;
    const double share = between > 0 ? std::clamp((joints[i].time - failure.before) / between, 0.0, 1.0) : 0;
    breccia::SetPlace(breccia::Between(failure.first, failure.second, share), joints[i]);
  }
  if (!breccia::Ranks().First()) joints.clear();
  this->Make(nullptr, nullptr, outputs);
}

void vtkBrecciaCrackEvents::Make(vtkDataObject*, vtkDataObject*, vtkInformationVector* outputs) {
  const std::vector<breccia::FailedJoint>& joints = this->Frames->joints;
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
  breccia::AddFact(table, "energy_of_damage", this->Frames->damage_energy);
  breccia::AddFact(table, "fracture_energy", energy + this->Frames->damage_energy);
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
