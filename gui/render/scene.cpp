#include "render/scene.hpp"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellPicker.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>

#include <algorithm>

#include "render/cracks.hpp"

namespace breccia::gui {
namespace {

/// Largest number of faces whose edges are still distinguishable and quickly drawn.
constexpr vtkIdType kMostWithEdges = 50000;

}  // namespace

std::optional<Quantity> quantity_of(Colouring colouring) {
  const int place = static_cast<int>(colouring) - static_cast<int>(Colouring::first_quantity);
  return place < 0 ? std::nullopt : std::optional(static_cast<Quantity>(place));
}

const std::vector<std::pair<Colouring, std::string>>& colourings() {
  static const auto list = [] {
    std::vector<std::pair<Colouring, std::string>> all{{Colouring::group, "group"},
                                                       {Colouring::body, "body"},
                                                       {Colouring::fragment, "fragment"},
                                                       {Colouring::rank, "rank"}};
    for (int i = 0; i < kNumQuantities; ++i) {
      const auto quantity = static_cast<Quantity>(i);
      const bool adapts = is_length(quantity);  // its unit does, to the model
      all.emplace_back(colouring_by(quantity), adapts ? source_of(quantity).name : title_of(quantity));
    }
    return all;
  }();
  return list;
}

Scene::Scene() {
  skin_->SetMapper(skin_mapper_);
  broken_->SetMapper(broken_mapper_);
  marked_->SetMapper(marked_mapper_);
  marked_->GetProperty()->SetColor(0.84, 0.37, 0);
  marked_->GetProperty()->SetAmbient(0.35);
  marked_->VisibilityOff();
  chosen_->SetMapper(chosen_mapper_);
  chosen_->GetProperty()->SetColor(0.84, 0.37, 0);
  chosen_->GetProperty()->SetAmbient(0.5);
  chosen_->GetProperty()->EdgeVisibilityOn();
  chosen_->VisibilityOff();
  // They lie in the skin, and are drawn in front of it.
  chosen_mapper_->SetResolveCoincidentTopologyToPolygonOffset();
  chosen_mapper_->SetRelativeCoincidentTopologyPolygonOffsetParameters(-1, -1);
  cut_->SetMapper(cut_mapper_);
  cut_->VisibilityOff();
  for (vtkActor* actor : {skin_.Get(), cut_.Get()}) {
    actor->GetProperty()->SetInterpolationToFlat();
    const double ambient = actor == cut_ ? 0.7 : 0.25;  // colours of the cut are those of the legend
    actor->GetProperty()->SetAmbient(ambient);
    actor->GetProperty()->SetDiffuse(1 - ambient);
    actor->GetProperty()->SetEdgeColor(0.25, 0.25, 0.3);
  }
  broken_->GetProperty()->SetAmbient(0.5);
  broken_->GetProperty()->SetDiffuse(0.5);
  style_legends();
  broken_mapper_->SetScalarModeToUseCellFieldData();
  broken_mapper_->UseLookupTableScalarRangeOn();
  // Cracks lie in the faces of the skin: they are drawn in front.
  broken_mapper_->SetResolveCoincidentTopologyToPolygonOffset();
  broken_mapper_->SetRelativeCoincidentTopologyPolygonOffsetParameters(-2, -2);
  for (vtkPolyDataMapper* mapper : {skin_mapper_.Get(), cut_mapper_.Get()}) {
    mapper->SetLookupTable(colours_);
    mapper->SetScalarModeToUseCellFieldData();
    mapper->SelectColorArray(kShown);
    mapper->UseLookupTableScalarRangeOn();
  }
  caption_->GetTextProperty()->SetFontSize(14);
  caption_->GetTextProperty()->SetBackgroundOpacity(kPlateOpacity);
  for (vtkProp* prop :
       {static_cast<vtkProp*>(skin_), static_cast<vtkProp*>(broken_), static_cast<vtkProp*>(marked_),
        static_cast<vtkProp*>(chosen_), static_cast<vtkProp*>(cut_), static_cast<vtkProp*>(legend_),
        static_cast<vtkProp*>(time_legend_), static_cast<vtkProp*>(class_legend_), static_cast<vtkProp*>(mode_legend_),
        static_cast<vtkProp*>(caption_), static_cast<vtkProp*>(scale_bar_)})
    renderer_->AddViewProp(prop);
  vtkNew<vtkCallbackCommand> begin;
  begin->SetClientData(this);
  begin->SetCallback(
      [](vtkObject*, unsigned long, void* scene, void*) { static_cast<Scene*>(scene)->begin_picture(); });
  begins_ = renderer_->AddObserver(vtkCommand::StartEvent, begin);
  clear();
  set_dark(false);
}

Scene::~Scene() { renderer_->RemoveObserver(begins_); }

/// What depends on the camera and on the size of the view.
void Scene::begin_picture() {
  constexpr double kEdge = 6, kLine = 24;  // pixels of a screen of 72 dots an inch
  const double scale = renderer_->GetVTKWindow()->GetDPI() / 72.0;
  const bool axes = shows_axes_ && has_data();
  const double left = axes ? AxesCorner::kSize : kEdge;
  axes_.show(axes);
  scale_bar_->SetVisibility(axes);
  scale_bar_->set_place(left, kEdge + kLine);
  caption_->SetPosition((left + kEdge) * scale, kEdge * scale);
  axes_.follow(*renderer_);
  words_.place();
}

void Scene::show_axes(bool on) { shows_axes_ = on; }

void Scene::clear() {
  frame_ = {};
  through_.reset();
  draw_loads();
  mark(nullptr);
  for (vtkProp* prop :
       {static_cast<vtkProp*>(skin_), static_cast<vtkProp*>(broken_), static_cast<vtkProp*>(chosen_),
        static_cast<vtkProp*>(cut_), static_cast<vtkProp*>(legend_), static_cast<vtkProp*>(time_legend_),
        static_cast<vtkProp*>(class_legend_), static_cast<vtkProp*>(mode_legend_)})
    prop->VisibilityOff();
}

void Scene::show(const FrameData& frame) {
  const bool first = !has_data();
  frame_ = frame;
  through_.reset();
  if (frame_.skin == nullptr) {
    clear();
    return;
  }
  skin_->VisibilityOn();
  colour();
  draw_joints();
  draw_loads();
  if (first) reset_camera();
}

vtkIdType Scene::num_broken() const {
  return frame_.damaged == nullptr ? 0 : cracks_among(*frame_.damaged, {})->GetNumberOfPolys();
}

vtkIdType Scene::num_joints() const {
  return broken_->GetVisibility() != 0 ? broken_mapper_->GetInput()->GetNumberOfPolys() : 0;
}

void Scene::set_colouring(Colouring colouring) {
  colouring_ = colouring;
  if (has_data()) colour();
}

void Scene::set_groups(const std::vector<std::string>& names) {
  if (groups_ == names) return;
  groups_ = names;
  if (has_data()) colour();
}

void Scene::set_surfaces(SurfaceGroups surfaces) {
  surfaces_ = std::move(surfaces);
  groups_of_face_.clear();
  for (std::size_t g = 0; g < surfaces_.faces.size(); ++g)
    for (const std::int64_t face : surfaces_.faces[g]) groups_of_face_[face].push_back(g);
}

void Scene::highlight(const std::vector<std::string>& groups) {
  std::set<std::string> wanted(groups.begin(), groups.end());
  wanted.erase("");
  if (wanted == highlighted_) return;
  highlighted_ = std::move(wanted);
  if (has_data()) colour();
}

/// Number of a face as in SurfaceGroups; -1: not in the frame.
std::int64_t Scene::face_of(vtkIdType cell) const {
  vtkDataArray* id = frame_.skin->GetCellData()->GetArray("id");
  vtkDataArray* side = frame_.skin->GetCellData()->GetArray("side");
  if (id == nullptr || side == nullptr || cell < 0 || cell >= id->GetNumberOfTuples()) return -1;
  return 4 * static_cast<std::int64_t>(id->GetTuple1(cell)) + static_cast<std::int64_t>(side->GetTuple1(cell));
}

/// The faces of the surface groups that are highlighted, where the skin is drawn.
void Scene::draw_chosen() {
  std::set<std::int64_t> wanted;
  for (std::size_t g = 0; g < surfaces_.names.size() && g < surfaces_.faces.size(); ++g)
    if (highlighted_.count(surfaces_.names[g]) != 0)
      wanted.insert(surfaces_.faces[g].begin(), surfaces_.faces[g].end());
  chosen_->SetVisibility(!wanted.empty());
  chosen_mapper_->SetInputData(nullptr);
  if (wanted.empty()) return;
  vtkPolyData* skin = skin_mapper_->GetInput();
  vtkNew<vtkCellArray> triangles;
  for (vtkIdType c = 0; c < skin->GetNumberOfCells(); ++c) {
    if (wanted.count(face_of(c)) == 0) continue;
    const std::array<vtkIdType, 3> corners{3 * c, 3 * c + 1, 3 * c + 2};  // each triangle has its own three points
    triangles->InsertNextCell(3, corners.data());
  }
  vtkNew<vtkPolyData> faces;
  faces->SetPoints(skin->GetPoints());
  faces->SetPolys(triangles);
  chosen_mapper_->SetInputData(faces);
}

vtkIdType Scene::num_chosen() const {
  return chosen_->GetVisibility() != 0 ? chosen_mapper_->GetInput()->GetNumberOfPolys() : 0;
}

void Scene::show_edges(bool on) {
  for (vtkActor* actor : {skin_.Get(), cut_.Get()}) actor->GetProperty()->SetEdgeVisibility(on);
}

void Scene::show_skin(bool on) {
  solid_ = on;
  set_opacity();
}

void Scene::mark(vtkPolyData* faces) {
  marked_mapper_->SetInputData(faces);
  marked_->GetProperty()->SetEdgeVisibility(faces != nullptr && faces->GetNumberOfPolys() <= kMostWithEdges);
  marked_->SetVisibility(faces != nullptr);
  set_opacity();
}

vtkIdType Scene::num_marked() const {
  return marked_->GetVisibility() != 0 ? marked_mapper_->GetInput()->GetNumberOfPolys() : 0;
}

void Scene::set_opacity() {
  constexpr double kSeenThrough = 0.15;
  const bool marks = marked_->GetVisibility() != 0;
  for (vtkActor* actor : {skin_.Get(), cut_.Get()})
    actor->GetProperty()->SetOpacity(solid_ && !marks ? 1.0 : kSeenThrough);
  broken_->GetProperty()->SetOpacity(marks ? kSeenThrough : 1.0);
}

Scene::Picked Scene::picked_at(double x, double y) const {
  vtkNew<vtkCellPicker> picker;
  picker->PickFromListOn();
  for (vtkActor* actor : {skin_.Get(), cut_.Get()}) picker->AddPickList(actor);
  picker->SetTolerance(0);
  if (frame_.skin == nullptr || picker->Pick(x, y, 0, renderer_) == 0 || picker->GetCellId() < 0) return {};
  const bool on_cut = picker->GetActor() == cut_.Get();
  vtkPolyData& seen = on_cut ? *cut_mapper_->GetInput() : *frame_.skin;
  vtkDataArray* groups = seen.GetCellData()->GetArray("material");
  if (groups == nullptr || picker->GetCellId() >= groups->GetNumberOfTuples()) return {};
  const auto group = static_cast<std::size_t>(groups->GetTuple1(picker->GetCellId()));
  Picked picked;
  if (group < groups_.size()) picked.volume = groups_[group];
  if (on_cut) return picked;
  const auto face = groups_of_face_.find(face_of(picker->GetCellId()));
  if (face == groups_of_face_.end()) return picked;
  for (const std::size_t surface : face->second) picked.surfaces.push_back(surfaces_.names[surface]);
  return picked;
}

void Scene::set_caption(const std::string& text) { caption_->SetInput(text.c_str()); }

}  // namespace breccia::gui
