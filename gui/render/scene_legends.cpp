#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkMath.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>
#include <vtkVariant.h>

#include <algorithm>

#include "render/cracks.hpp"
#include "render/prefixed_unit.hpp"
#include "render/ramp.hpp"
#include "render/scene.hpp"

// The damaged joints, and the legends beside the model.

namespace breccia::gui {
namespace {

using Colour = std::array<double, 3>;

constexpr const char* kFailure = "shown time of failure";  ///< array that the joints are coloured by
/// Joints by mode; 0 is that of a surface that was broken from the start.
constexpr std::array<Colour, 4> kModes{{{0.5, 0.5, 0.5}, {0.90, 0.12, 0.12}, {0.12, 0.30, 0.90}, {0.75, 0.15, 0.80}}};
constexpr std::array<const char*, 4> kModeNames{"of no mode", "opening (I)", "sliding (II)", "mixed"};

void place_legend(vtkScalarBarActor& legend, double x, double y, double width, double height) {
  legend.SetPosition(x, y);
  legend.SetPosition2(width, height);
  legend.SetUnconstrainedFontSize(true);
  legend.GetTitleTextProperty()->SetFontSize(13);
  legend.GetLabelTextProperty()->SetFontSize(12);
  legend.SetVerticalTitleSeparation(6);
  for (vtkTextProperty* text : {legend.GetTitleTextProperty(), legend.GetLabelTextProperty()}) {
    text->SetBold(0);
    text->SetItalic(0);
    text->SetShadow(0);
  }
  legend.SetLabelFormat("%.3g");
  legend.SetNumberOfLabels(5);
  legend.DrawBackgroundOn();
  legend.GetBackgroundProperty()->SetOpacity(kPlateOpacity);
}

}  // namespace

void Scene::style_legends() {
  mode_colours_->SetNumberOfTableValues(static_cast<vtkIdType>(kModes.size()));
  for (std::size_t i = 0; i < kModes.size(); ++i)
    mode_colours_->SetTableValue(static_cast<vtkIdType>(i), kModes[i][0], kModes[i][1], kModes[i][2]);
  mode_colours_->IndexedLookupOn();
  for (std::size_t i = 0; i < kModes.size(); ++i)
    mode_colours_->SetAnnotation(vtkVariant(static_cast<int>(i)), kModeNames[i]);
  fill_ramp(*time_colours_);
  constexpr double kGrey = 0.55;  // of joints that are damaged and hold
  time_colours_->SetNanColor(kGrey, kGrey, kGrey, 1);
  legend_->SetLookupTable(colours_);
  time_legend_->SetLookupTable(time_colours_);
  place_legend(*legend_, 0.82, 0.45, 0.17, 0.5);
  place_legend(*time_legend_, 0.82, 0.03, 0.17, 0.38);
  class_legend_->set_top(0.97);
  mode_legend_->set_bottom(0.05);
}

void Scene::set_joint_colouring(JointColouring colouring) {
  joint_colouring_ = colouring;
  if (has_data()) draw_joints();
}

void Scene::set_least_damage(const std::optional<double>& least) {
  least_damage_ = least;
  if (has_data()) draw_joints();
}

void Scene::draw_joints() {
  const bool may = frame_.damaged != nullptr && joint_colouring_ != JointColouring::hidden;
  const vtkSmartPointer<vtkPolyData> joints = may ? cracks_among(*frame_.damaged, least_damage_) : nullptr;
  const bool any = joints != nullptr && joints->GetNumberOfPolys() > 0;
  const bool by_time = any && joint_colouring_ == JointColouring::time_of_failure &&
                       joints->GetCellData()->HasArray("time_of_failure") != 0;
  broken_->SetVisibility(any);
  mode_legend_->SetVisibility(any && !by_time);
  time_legend_->SetVisibility(by_time);
  failure_range_ = {0, 0};
  if (!any) return;
  by_time ? colour_joints_by_time(*joints) : colour_joints_by_mode(*joints);
  broken_mapper_->SetInputData(joints);
}

/// The legend has the modes that are seen.
void Scene::colour_joints_by_mode(vtkPolyData& joints) {
  vtkDataArray* modes = joints.GetCellData()->GetArray("mode");
  std::array<bool, kModes.size()> is_seen{};
  for (vtkIdType c = 0; modes != nullptr && c < modes->GetNumberOfTuples(); ++c)
    if (const auto mode = static_cast<std::size_t>(modes->GetComponent(c, 0)); mode < is_seen.size())
      is_seen[mode] = true;
  std::vector<ClassLegend::Class> classes;
  for (std::size_t i = 0; i < kModes.size(); ++i)
    if (is_seen[i]) classes.push_back({kModes[i], kModeNames[i]});
  mode_legend_->set_classes(least_damage_ ? "damaged joints" : "broken joints", classes);
  broken_mapper_->SetLookupTable(mode_colours_);
  broken_mapper_->SelectColorArray("mode");
}

/// Those that hold have no time (-1): they are grey.
void Scene::colour_joints_by_time(vtkPolyData& joints) {
  vtkDataArray* times = joints.GetCellData()->GetArray("time_of_failure");
  double first = 0, last = 0;
  bool any = false;
  for (vtkIdType c = 0; c < times->GetNumberOfTuples(); ++c) {
    const double t = times->GetComponent(c, 0);
    if (t < 0) continue;
    first = any ? std::min(first, t) : t;
    last = any ? std::max(last, t) : t;
    any = true;
  }
  failure_range_ = {first, last};
  const PrefixedUnit unit = prefixed_unit(last, "s");
  vtkNew<vtkDoubleArray> shown;
  shown->SetName(kFailure);
  for (vtkIdType c = 0; c < times->GetNumberOfTuples(); ++c) {
    const double t = times->GetComponent(c, 0);
    shown->InsertNextValue(t < 0 ? vtkMath::Nan() : t / unit.size);
  }
  joints.GetCellData()->AddArray(shown);
  time_colours_->SetTableRange(first / unit.size, (last > first ? last : first + unit.size) / unit.size);
  const std::string holds = least_damage_ ? "\ngrey: holds" : "";
  time_legend_->SetTitle(("time of\nfailure [" + unit.name + "]" + holds).c_str());
  broken_mapper_->SetLookupTable(time_colours_);
  broken_mapper_->SelectColorArray(kFailure);
}

void Scene::set_dark(bool dark) {
  dark_ = dark;
  if (has_data()) colour();  // what is dim is near the ground
  const double low = dark ? 0.10 : 0.86, high = dark ? 0.20 : 0.98, ink = dark ? 0.92 : 0.1;
  renderer_->GradientBackgroundOn();
  renderer_->SetBackground(low, low, low + 0.02);
  renderer_->SetBackground2(high, high, high + 0.02);
  const double ground = plate_grey(dark);
  for (vtkScalarBarActor* bar : {legend_.Get(), time_legend_.Get()}) {
    for (vtkTextProperty* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()})
      text->SetColor(ink, ink, ink);
    bar->GetBackgroundProperty()->SetColor(ground, ground, ground);
  }
  caption_->GetTextProperty()->SetColor(ink, ink, ink);
  caption_->GetTextProperty()->SetBackgroundColor(ground, ground, ground);
  for (ClassLegend* legend : {class_legend_.Get(), mode_legend_.Get()}) legend->set_colours(ink, ground);
  words_.set_dark(dark);
  scale_bar_->set_dark(dark);
  axes_.set_dark(dark);
}

}  // namespace breccia::gui
