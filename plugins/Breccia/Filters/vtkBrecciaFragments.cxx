#include "vtkBrecciaFragments.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "brecciaBodies.h"
#include "brecciaFragmentTable.h"
#include "brecciaSieve.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkExtractCells.h"
#include "vtkIdList.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkBrecciaFragments);

namespace {

using breccia::Fragment;

std::vector<double> Column(const std::vector<Fragment>& fragments, double (*of)(const Fragment&)) {
  std::vector<double> values;
  for (const Fragment& f : fragments) values.push_back(of(f));
  return values;
}

template <class Of>
std::vector<double> Vectors(const std::vector<Fragment>& fragments, Of&& of) {
  std::vector<double> values;
  for (const Fragment& f : fragments) {
    const std::array<double, 3> v = of(f);
    values.insert(values.end(), v.begin(), v.end());
  }
  return values;
}

double Speed(const Fragment& f) { return std::hypot(f.velocity[0], f.velocity[1], f.velocity[2]); }

/// @param body_of  by fragment
void FillTable(const std::vector<Fragment>& fragments, const std::map<vtkTypeInt64, vtkTypeInt64>& body_of,
               const breccia::BodyNames& names, vtkTable* table) {
  std::vector<vtkTypeInt64> id, body, elements, cracked;
  for (const Fragment& f : fragments) {
    const auto found = body_of.find(f.id);
    body.push_back(found == body_of.end() ? -1 : found->second);
    id.push_back(f.id);
    elements.push_back(f.elements);
    cracked.push_back(f.cracked);
  }
  const auto number = [&](const char* name, double (*of)(const Fragment&)) {
    breccia::AddColumn(table, name, Column(fragments, of));
  };
  const auto vector = [&](const char* name, auto&& of) { breccia::AddColumn(table, name, Vectors(fragments, of), 3); };
  breccia::AddColumn(table, "fragment", id);
  breccia::AddColumn(table, "body", body);
  breccia::AddBodyColumn(table, "body_name", names, body);
  breccia::AddColumn(table, "elements", elements);
  breccia::AddColumn(table, "cracked_faces", cracked);
  number("mass", [](const Fragment& f) { return f.mass; });
  number("volume", [](const Fragment& f) { return f.volume; });
  number("area", [](const Fragment& f) { return f.area; });
  vector("centroid", [](const Fragment& f) { return f.centroid; });
  vector("velocity", [](const Fragment& f) { return f.velocity; });
  number("speed", Speed);
  vector("spin", [](const Fragment& f) { return f.spin; });
  vector("semi_axes", [](const Fragment& f) { return f.semi_axes; });
  number("bounding_factor", [](const Fragment& f) { return f.bounding_factor; });
  vector("axis_1", [](const Fragment& f) { return f.axes[0]; });
  vector("axis_2", [](const Fragment& f) { return f.axes[1]; });
  vector("axis_3", [](const Fragment& f) { return f.axes[2]; });
  number("diameter", [](const Fragment& f) { return f.Diameter(); });
  number("sieve_size", [](const Fragment& f) { return f.SieveSize(); });
  number("elongation", [](const Fragment& f) { return f.Elongation(); });
  number("flatness", [](const Fragment& f) { return f.Flatness(); });
  number("sphericity", [](const Fragment& f) { return f.Sphericity(); });
}

void AddFit(vtkTable* table, const std::string& name, const char* size, const breccia::SizeFit& fit) {
  const auto fact = [&](const char* what, double value) {
    breccia::AddFact(table, (name + "_" + what).c_str(), value);
  };
  fact(size, fit.size);
  fact("exponent", fit.exponent);
  fact("r2", fit.r2);
  fact("deviation", fit.deviation);
  if (fit) return;
  vtkNew<vtkStringArray> reason;
  reason->SetName((name + "_left_out").c_str());
  reason->InsertNextValue(fit.left_out);
  table->GetFieldData()->AddArray(reason);
}

void FillSieve(const breccia::Sieve& sieve, vtkTable* table) {
  std::vector<double> rosin_rammler, swebrec;
  for (const double x : sieve.size) {
    rosin_rammler.push_back(sieve.RosinRammler(x));
    swebrec.push_back(sieve.Swebrec(x));
  }
  breccia::AddColumn(table, "size", sieve.size);
  breccia::AddColumn(table, "passing", sieve.passing);
  breccia::AddColumn(table, "rosin_rammler", rosin_rammler);
  breccia::AddColumn(table, "swebrec", swebrec);
  breccia::AddFact(table, "d50", sieve.d50);
  breccia::AddFact(table, "d80", sieve.d80);
  AddFit(table, "rosin_rammler", "size", sieve.rosin_rammler);
  AddFit(table, "swebrec", "median", sieve.swebrec);
  breccia::AddFact(table, "swebrec_largest", sieve.largest);
}

/// The elements with what is known of their fragments.
vtkSmartPointer<vtkUnstructuredGrid> Painted(const breccia::Elements& elements, const breccia::Connectivity& parts,
                                             const std::vector<Fragment>& fragments, const breccia::IdIndex& row_of) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  if (!elements.grid) return grid;
  if (auto* same = vtkUnstructuredGrid::SafeDownCast(elements.grid)) grid->ShallowCopy(same);
  vtkNew<vtkTypeInt64Array> id;
  id->SetName("fragment");
  vtkNew<vtkDoubleArray> mass, diameter, speed;
  mass->SetName("fragment_mass");
  diameter->SetName("fragment_diameter");
  speed->SetName("fragment_speed");
  const vtkIdType n = elements.Count();
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{id, mass, diameter, speed})
    array->SetNumberOfTuples(n);
  for (vtkIdType e = 0; e < n; ++e) {
    const vtkTypeInt64 part = parts.fragment[static_cast<std::size_t>(e)];
    const Fragment& f = fragments[static_cast<std::size_t>(row_of.Find(part))];
    id->SetValue(e, part);
    mass->SetValue(e, f.mass);
    diameter->SetValue(e, f.Diameter());
    speed->SetValue(e, Speed(f));
  }
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{id, mass, diameter, speed})
    grid->GetCellData()->AddArray(array);
  grid->GetCellData()->SetActiveScalars("fragment_diameter");
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> Extracted(vtkUnstructuredGrid* grid, const breccia::Connectivity& parts,
                                               const std::vector<vtkTypeInt64>& wanted) {
  vtkNew<vtkIdList> cells;
  for (std::size_t e = 0; e < parts.fragment.size(); ++e) {
    if (std::binary_search(wanted.begin(), wanted.end(), parts.fragment[e]))
      cells->InsertNextId(static_cast<vtkIdType>(e));
  }
  vtkNew<vtkExtractCells> extract;
  extract->SetInputData(grid);
  extract->SetCellList(cells);
  extract->Update();
  return extract->GetOutput();
}

/// The fragments that hold the elements, ascending.
std::vector<vtkTypeInt64> Followed(const std::vector<vtkIdType>& followed, const breccia::Elements& elements,
                                   const breccia::Connectivity& parts, const breccia::Ranks& ranks) {
  std::vector<vtkTypeInt64> mine;
  const breccia::IdIndex here(elements.id);
  for (const vtkIdType element : followed) {
    if (const vtkIdType e = here.Find(element); e >= 0) mine.push_back(parts.fragment[static_cast<std::size_t>(e)]);
  }
  std::vector<vtkTypeInt64> wanted = ranks.Gather(mine);
  std::sort(wanted.begin(), wanted.end());
  return wanted;
}

}  // namespace

vtkBrecciaFragments::vtkBrecciaFragments() : vtkBrecciaFilter(2, {"vtkUnstructuredGrid", "vtkTable", "vtkTable"}) {}

void vtkBrecciaFragments::AddFollowedElement(vtkIdType id) {
  if (id < 0) return;
  this->FollowedElements.push_back(id);
  this->Modified();
}

void vtkBrecciaFragments::ClearFollowedElements() {
  if (this->FollowedElements.empty()) return;
  this->FollowedElements.clear();
  this->Modified();
}

void vtkBrecciaFragments::Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) {
  const breccia::Ranks ranks;
  const breccia::Elements elements = breccia::FindElements(input, ranks);
  const breccia::Cracks cracks = breccia::FindCracks(input, joints, ranks);
  const breccia::Connectivity parts = breccia::Connect(elements, cracks.id, ranks);
  std::vector<Fragment> fragments = breccia::Tabulate(elements, parts, ranks);
  const std::map<vtkTypeInt64, vtkTypeInt64> body_of = breccia::BodiesOfFragments(elements, parts.fragment, ranks);
  std::vector<vtkTypeInt64> ids;
  for (const Fragment& f : fragments) ids.push_back(f.id);
  auto grid = Painted(elements, parts, fragments, breccia::IdIndex(ids));
  if (!this->FollowedElements.empty()) {
    const std::vector<vtkTypeInt64> wanted = Followed(this->FollowedElements, elements, parts, ranks);
    grid = Extracted(grid, parts, wanted);
    const auto unwanted = [&](const Fragment& f) { return !std::binary_search(wanted.begin(), wanted.end(), f.id); };
    fragments.erase(std::remove_if(fragments.begin(), fragments.end(), unwanted), fragments.end());
  }
  vtkUnstructuredGrid::GetData(outputs, 0)->ShallowCopy(grid);
  if (!ranks.First()) fragments.clear();
  std::vector<std::pair<double, double>> sizes;
  for (const Fragment& f : fragments) {
    if (this->OnlyBroken && f.cracked == 0) continue;
    const double size = this->SieveMeasure == SPHERE ? f.Diameter() : f.SieveSize();
    if (std::isfinite(size) && std::isfinite(f.mass)) sizes.emplace_back(size, f.mass);
  }
  vtkTable::GetData(outputs, 1)->Initialize();
  vtkTable::GetData(outputs, 2)->Initialize();
  FillTable(fragments, body_of, breccia::BodyNames(input), vtkTable::GetData(outputs, 1));
  FillSieve(breccia::SieveOf(sizes), vtkTable::GetData(outputs, 2));
}

void vtkBrecciaFragments::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SieveMeasure: " << this->SieveMeasure << "\n"
     << indent << "OnlyBroken: " << this->OnlyBroken << "\n"
     << indent << "FollowedElements: " << this->FollowedElements.size() << "\n";
}
