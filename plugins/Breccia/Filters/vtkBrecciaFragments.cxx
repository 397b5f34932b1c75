#include "vtkBrecciaFragments.h"

#include <algorithm>
#include <cmath>

#include "brecciaFragmentTable.h"
#include "brecciaSieve.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkExtractCells.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
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

void FillTable(const std::vector<Fragment>& fragments, vtkTable* table) {
  std::vector<vtkTypeInt64> id, elements, cracked;
  for (const Fragment& f : fragments) {
    id.push_back(f.id);
    elements.push_back(f.elements);
    cracked.push_back(f.cracked);
  }
  const auto number = [&](const char* name, double (*of)(const Fragment&)) {
    breccia::AddColumn(table, name, Column(fragments, of));
  };
  const auto vector = [&](const char* name, auto&& of) { breccia::AddColumn(table, name, Vectors(fragments, of), 3); };
  breccia::AddColumn(table, "fragment", id);
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
  breccia::AddFact(table, "rosin_rammler_size", sieve.rosin_rammler_size);
  breccia::AddFact(table, "rosin_rammler_exponent", sieve.rosin_rammler_exponent);
  breccia::AddFact(table, "swebrec_median", sieve.swebrec_median);
  breccia::AddFact(table, "swebrec_largest", sieve.swebrec_largest);
  breccia::AddFact(table, "swebrec_exponent", sieve.swebrec_exponent);
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

}  // namespace

vtkBrecciaFragments::vtkBrecciaFragments() {
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

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

int vtkBrecciaFragments::FillInputPortInformation(int port, vtkInformation* info) {
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  if (port == 1) info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkBrecciaFragments::FillOutputPortInformation(int port, vtkInformation* info) {
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkTable");
  return 1;
}

int vtkBrecciaFragments::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) {
  if (!vtkUnstructuredGrid::GetData(outputs, 0)) {
    vtkNew<vtkUnstructuredGrid> grid;
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), grid);
  }
  for (const int port : {1, 2}) {
    if (vtkTable::GetData(outputs, port)) continue;
    vtkNew<vtkTable> table;
    outputs->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), table);
  }
  return 1;
}

int vtkBrecciaFragments::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) {
  try {
    const breccia::Ranks ranks;
    vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
    const breccia::Elements elements = breccia::FindElements(input, ranks);
    const breccia::Cracks cracks = breccia::FindCracks(input, vtkDataObject::GetData(inputs[1], 0), ranks);
    std::vector<double> mass, velocity;
    std::string problem;
    try {
      mass = breccia::Numbers(elements.grid, "mass");
      velocity = breccia::Numbers(elements.grid, "velocity", 3);
    } catch (const breccia::BadInput& bad) {
      problem = std::string("elements: ") + bad.what();
    }
    ranks.Agree(problem);
    const breccia::Connectivity parts = breccia::Connect(elements, cracks.id, ranks);
    std::vector<Fragment> fragments = breccia::Tabulate(elements, parts, mass, velocity, ranks);

    std::vector<vtkTypeInt64> ids;
    for (const Fragment& f : fragments) ids.push_back(f.id);
    auto grid = Painted(elements, parts, fragments, breccia::IdIndex(ids));
    if (!this->FollowedElements.empty()) {
      std::vector<vtkTypeInt64> wanted;
      const breccia::IdIndex here(elements.id);
      for (const vtkIdType element : this->FollowedElements) {
        if (const vtkIdType e = here.Find(element); e >= 0)
          wanted.push_back(parts.fragment[static_cast<std::size_t>(e)]);
      }
      wanted = ranks.Gather(wanted);
      std::sort(wanted.begin(), wanted.end());
      grid = Extracted(grid, parts, wanted);
      fragments.erase(
          std::remove_if(fragments.begin(), fragments.end(),
                         [&](const Fragment& f) { return !std::binary_search(wanted.begin(), wanted.end(), f.id); }),
          fragments.end());
    }
    vtkUnstructuredGrid::GetData(outputs, 0)->ShallowCopy(grid);
    std::vector<std::pair<double, double>> sizes;
    for (const Fragment& f : fragments) {
      if (this->OnlyBroken && f.cracked == 0) continue;
      sizes.emplace_back(this->SieveMeasure == SPHERE ? f.Diameter() : f.SieveSize(), f.mass);
    }
    if (!ranks.First()) {
      fragments.clear();
      sizes.clear();
    }
    FillTable(fragments, vtkTable::GetData(outputs, 1));
    FillSieve(breccia::SieveOf(sizes), vtkTable::GetData(outputs, 2));
    return 1;
  } catch (const breccia::BadInput& bad) {
    vtkErrorMacro(<< "Fragments: " << bad.what());
    return 0;
  }
}

void vtkBrecciaFragments::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SieveMeasure: " << this->SieveMeasure << "\n"
     << indent << "OnlyBroken: " << this->OnlyBroken << "\n"
     << indent << "FollowedElements: " << this->FollowedElements.size() << "\n";
}
