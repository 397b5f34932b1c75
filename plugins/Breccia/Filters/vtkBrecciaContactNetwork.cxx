#include "vtkBrecciaContactNetwork.h"

#include <algorithm>
#include <map>
#include <set>

#include "brecciaBodies.h"
#include "brecciaFragmentTable.h"
#include "brecciaJoints.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkTubeFilter.h"

vtkStandardNewMacro(vtkBrecciaContactNetwork);

namespace {

using breccia::Vector;
using Pair = std::pair<vtkTypeInt64, vtkTypeInt64>;

/// A contact point that carries a force, with the element it belongs to and the one it is in.
struct Touch {
  vtkTypeInt64 point, element, other, body, other_body;
  Vector force;  ///< N, on the element
};

constexpr vtkTypeInt64 kPointsOfAnElement = 24;  // ids of contact points are 24 element + 6 face + number

/// Of all ranks, by the ids of their points.
std::vector<Touch> FindTouches(vtkDataObject* input, const breccia::Ranks& ranks) {
  std::vector<Touch> mine;
  std::string problem;
  try {
    const auto part = breccia::FindPart(input, "normal_force");
    if (!part && breccia::LacksBlock(input, "contacts", "normal_force")) {
      throw breccia::BadInput(
          "there is no block 'contacts' (vertices with the cell arrays 'normal_force', 'force', 'point', "
          "'other_element'): the run has not recorded them (output.contacts), or a filter before this one has left "
          "them out; there is: " +
          breccia::Describe(input));
    }
    // Where there is no "point", in recordings of before, "id" was it.
    const bool has_point = part != nullptr && part->GetCellData()->HasArray("point") != 0;
    const auto point = breccia::Integers(part, has_point ? "point" : "id"),
               other = breccia::Integers(part, "other_element"), body = breccia::Integers(part, "body"),
               other_body = breccia::Integers(part, "other_body");
    const auto force = breccia::Numbers(part, "force", 3);
    for (std::size_t i = 0; i < point.size(); ++i) {
      mine.push_back({point[i],
                      point[i] / kPointsOfAnElement,
                      other[i],
                      body[i],
                      other_body[i],
                      {force[3 * i], force[3 * i + 1], force[3 * i + 2]}});
    }
  } catch (const breccia::BadInput& bad) {
    problem = std::string("contacts: ") + bad.what();
  }
  ranks.Agree(problem);
  std::vector<Touch> all = ranks.Gather(mine);
  std::sort(all.begin(), all.end(),
            [](const Touch& a, const Touch& b) { return a.point != b.point ? a.point < b.point : a.other < b.other; });
  return all;
}

/// The fragments of the elements that touch something.
std::map<vtkTypeInt64, vtkTypeInt64> FragmentsOf(const std::vector<Touch>& touches, const breccia::Elements& elements,
                                                 const breccia::Connectivity& parts, const breccia::Ranks& ranks) {
  const breccia::IdIndex here(elements.id);
  std::vector<Pair> mine;
  for (const Touch& touch : touches) {
    for (const vtkTypeInt64 element : {touch.element, touch.other}) {
      if (const vtkIdType e = here.Find(element); e >= 0)
        mine.emplace_back(element, parts.fragment[static_cast<std::size_t>(e)]);
    }
  }
  const std::vector<Pair> all = ranks.Gather(mine);
  return {all.begin(), all.end()};
}

void Add(Vector& sum, const Vector& term, double sign) {
  for (std::size_t k = 0; k < 3; ++k) sum[k] += sign * term[k];
}

struct Link {
  Vector force{};  ///< N, on the first of the pair
  double contacts = 0;
};

void AddTo(std::map<Pair, Link>& links, vtkTypeInt64 own, vtkTypeInt64 other, const Vector& force) {
  Link& link = links[std::minmax(own, other)];
  Add(link.force, force, own <= other ? 1 : -1);
  ++link.contacts;
}

void FillChains(const std::map<Pair, Link>& links, const std::map<vtkTypeInt64, Vector>& centroid, double radius,
                vtkPolyData* out) {
  vtkNew<vtkPolyData> lines;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkDoubleArray> force, thickness;
  force->SetName("force");
  thickness->SetName("radius");
  double largest = 0;
  vtkBoundingBox box;
  for (const auto& [pair, link] : links) {
    largest = std::max(largest, breccia::Length(link.force));
    for (const vtkTypeInt64 end : {pair.first, pair.second}) {
      const Vector& x = centroid.at(end);
      box.AddPoint(x[0], x[1], x[2]);
    }
  }
  if (!(radius > 0)) radius = box.IsValid() ? box.GetDiagonalLength() / 50 : 1;
  for (const auto& [pair, link] : links) {
    const double size = breccia::Length(link.force);
    if (pair.first == pair.second || !(size > 0)) continue;
    vtkIdType ids[2];
    int end = 0;
    for (const vtkTypeInt64 fragment : {pair.first, pair.second}) {
      ids[end++] = points->InsertNextPoint(centroid.at(fragment).data());
      force->InsertNextValue(size);
      thickness->InsertNextValue(radius * size / largest);
    }
    cells->InsertNextCell(2, ids);
  }
  lines->SetPoints(points);
  lines->SetLines(cells);
  lines->GetPointData()->AddArray(force);
  lines->GetPointData()->SetScalars(thickness);
  if (cells->GetNumberOfCells() == 0) return;
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(lines);
  tubes->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  tubes->SetNumberOfSides(8);
  tubes->CappingOn();
  tubes->Update();
  out->ShallowCopy(tubes->GetOutput());
  out->GetPointData()->SetActiveScalars("force");
}

void FillNodes(const std::map<Pair, Link>& links, const std::map<vtkTypeInt64, vtkTypeInt64>& body_of,
               const breccia::BodyNames& names, vtkTable* table) {
  struct Node {
    std::set<vtkTypeInt64> touches;
    Vector force{};
    double largest = 0;
  };
  std::map<vtkTypeInt64, Node> nodes;
  for (const auto& [pair, link] : links) {
    if (pair.first == pair.second) continue;
    double sign = 1;
    for (const auto& [own, other] : {pair, Pair(pair.second, pair.first)}) {
      Node& node = nodes[own];
      node.touches.insert(other);
      Add(node.force, link.force, sign);
      node.largest = std::max(node.largest, breccia::Length(link.force));
      sign = -1;
    }
  }
  std::vector<vtkTypeInt64> id, body, number;
  std::vector<double> force, largest;
  double sum = 0;
  for (const auto& [fragment, node] : nodes) {
    id.push_back(fragment);
    const auto found = body_of.find(fragment);
    body.push_back(found == body_of.end() ? -1 : found->second);
    number.push_back(static_cast<vtkTypeInt64>(node.touches.size()));
    force.insert(force.end(), node.force.begin(), node.force.end());
    largest.push_back(node.largest);
    sum += static_cast<double>(node.touches.size());
  }
  breccia::AddColumn(table, "fragment", id);
  breccia::AddColumn(table, "body", body);
  breccia::AddBodyColumn(table, "body_name", names, body);
  breccia::AddColumn(table, "coordination_number", number);
  breccia::AddColumn(table, "force", force, 3);
  breccia::AddColumn(table, "largest_force", largest);
  breccia::AddFact(table, "mean_coordination_number", nodes.empty() ? 0 : sum / static_cast<double>(nodes.size()));
}

void FillWalls(const std::map<Pair, Link>& links, const breccia::BodyNames& names, vtkTable* table) {
  std::vector<vtkTypeInt64> body, other;
  std::vector<double> force, contacts;
  for (const auto& [pair, link] : links) {
    body.push_back(pair.first);
    other.push_back(pair.second);
    force.insert(force.end(), link.force.begin(), link.force.end());
    contacts.push_back(link.contacts);
  }
  breccia::AddColumn(table, "body", body);
  breccia::AddBodyColumn(table, "body_name", names, body);
  breccia::AddColumn(table, "other_body", other);
  breccia::AddBodyColumn(table, "other_body_name", names, other);
  breccia::AddColumn(table, "force", force, 3);
  breccia::AddColumn(table, "contacts", contacts);
}

}  // namespace

vtkBrecciaContactNetwork::vtkBrecciaContactNetwork() : vtkBrecciaFilter(2, {"vtkPolyData", "vtkTable", "vtkTable"}) {}

void vtkBrecciaContactNetwork::Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) {
  const breccia::Ranks ranks;
  const breccia::Elements elements = breccia::FindElements(input, ranks);
  const breccia::Cracks cracks = breccia::FindCracks(input, joints, ranks);
  const std::vector<Touch> touches = FindTouches(input, ranks);
  const breccia::Connectivity parts = breccia::Connect(elements, cracks.id, ranks);
  const std::vector<breccia::Fragment> fragments = breccia::Tabulate(elements, parts, ranks);
  const std::map<vtkTypeInt64, vtkTypeInt64> fragment = FragmentsOf(touches, elements, parts, ranks);
  const std::map<vtkTypeInt64, vtkTypeInt64> body_of = breccia::BodiesOfFragments(elements, parts.fragment, ranks);
  for (int port = 0; port < 3; ++port) vtkDataObject::GetData(outputs, port)->Initialize();
  if (!ranks.First()) return;
  std::map<vtkTypeInt64, Vector> centroid;
  for (const breccia::Fragment& f : fragments) centroid[f.id] = f.centroid;
  std::map<Pair, Link> chains, walls;
  for (const Touch& touch : touches) {
    const auto own = fragment.find(touch.element), other = fragment.find(touch.other);
    if (own != fragment.end() && other != fragment.end()) AddTo(chains, own->second, other->second, touch.force);
    if (touch.body != touch.other_body) AddTo(walls, touch.body, touch.other_body, touch.force);
  }
  FillChains(chains, centroid, this->LargestRadius, vtkPolyData::GetData(outputs, 0));
  const breccia::BodyNames names(input);
  FillNodes(chains, body_of, names, vtkTable::GetData(outputs, 1));
  FillWalls(walls, names, vtkTable::GetData(outputs, 2));
}

void vtkBrecciaContactNetwork::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LargestRadius: " << this->LargestRadius << "\n";
}
