#include "render/class_legend.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkViewport.h>
#include <vtkWindow.h>

#include <algorithm>
#include <cmath>

namespace breccia::gui {
namespace {

/// Pixels of a screen of 72 dots an inch, of which texts are sized in points.
constexpr int kTitleSize = 13, kNameSize = 12;
constexpr double kRow = 20, kBox = 14, kGap = 6, kMargin = 10, kPad = 4;
constexpr std::size_t kLongest = 28;  // characters of a name

std::string shortened(const std::string& name) {
  if (name.size() <= kLongest) return name;
  std::size_t end = kLongest - 3;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;  // not within a character
  return name.substr(0, end) + "...";
}

void set_style(vtkTextActor& text, int size) {
  text.SetTextScaleModeToNone();
  text.GetPositionCoordinate()->SetCoordinateSystemToViewport();
  text.GetTextProperty()->SetFontSize(size);
}

}  // namespace

vtkStandardNewMacro(ClassLegend);

ClassLegend::ClassLegend() {
  set_style(*title_, kTitleSize);
  title_->GetTextProperty()->SetJustificationToRight();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(boxes_);
  mapper->SetScalarModeToUseCellData();
  box_actor_->SetMapper(mapper);
  box_actor_->GetPositionCoordinate()->SetCoordinateSystemToViewport();
}

void ClassLegend::set_classes(const std::string& title, const std::vector<Class>& classes) {
  classes_ = classes;
  title_->SetInput(title.c_str());
  names_.clear();
  for (const Class& one : classes_) {
    const auto& text = names_.emplace_back(vtkSmartPointer<vtkTextActor>::New());
    set_style(*text, kNameSize);
    text->SetInput(shortened(one.name).c_str());
    text->GetTextProperty()->SetVerticalJustificationToCentered();
    text->GetTextProperty()->SetColor(ink_.data());
  }
  Modified();
}

void ClassLegend::set_colours(double ink, double ground) {
  ink_ = {ink, ink, ink};
  plate_.set_grey(ground);
  title_->GetTextProperty()->SetColor(ink_.data());
  for (const auto& text : names_) text->GetTextProperty()->SetColor(ink_.data());
}

void ClassLegend::place(vtkViewport& viewport) {
  const double scale = viewport.GetVTKWindow()->GetDPI() / 72.0;
  const int* size = viewport.GetSize();
  const auto rows = static_cast<double>(classes_.size());
  const double row = std::min(kRow * scale, 0.9 * size[1] / (rows + 1)), box = std::min(kBox * scale, 0.8 * row);
  std::vector<std::array<double, 2>> extents;
  double widest = 0;
  for (const auto& text : names_) {
    extents.push_back({});
    text->GetSize(&viewport, extents.back().data());
    widest = std::max(widest, extents.back()[0]);
  }
  const double right = size[0] - kMargin * scale, name_x = std::floor(right - widest);
  const double box_x = std::floor(name_x - kGap * scale - box);
  const double top = hangs_ ? top_ * size[1] : top_ * size[1] + row * (rows + 1);
  title_->SetPosition(right, top - 0.8 * row);
  std::array<double, 2> title{};
  title_->GetSize(&viewport, title.data());
  const double pad = kPad * scale;
  plate_.place(std::min(box_x, right - title[0]) - pad, top - row * (rows + 1) - pad, right + pad, top + pad);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> quads;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  rows_.clear();
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    const double middle = std::floor(top - row * (static_cast<double>(i) + 1.5)), low = std::floor(middle - 0.5 * box);
    names_[i]->SetPosition(name_x, middle);
    std::array<vtkIdType, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k)
      corners[k] = points->InsertNextPoint(box_x + (k == 1 || k == 2 ? box : 0), low + (k >= 2 ? box : 0), 0);
    quads->InsertNextCell(4, corners.data());
    for (const double part : classes_[i].colour) colours->InsertNextValue(static_cast<unsigned char>(255 * part + 0.5));
    const auto pixels = [](double x) { return static_cast<int>(std::lround(x)); };
    rows_.push_back(
        {{pixels(box_x), pixels(low), pixels(box), pixels(box)},
         {pixels(name_x), pixels(middle - 0.5 * extents[i][1]), pixels(extents[i][0]), pixels(extents[i][1])}});
  }
  boxes_->SetPoints(points);
  boxes_->SetPolys(quads);
  boxes_->GetCellData()->SetScalars(colours);
}

int ClassLegend::RenderOverlay(vtkViewport* viewport) {
  if (classes_.empty()) return 0;
  place(*viewport);
  int drawn = plate_.actor()->RenderOverlay(viewport) + box_actor_->RenderOverlay(viewport);
  // A text is laid out before it is drawn over the others.
  for (const auto& text : names_) drawn += text->RenderOpaqueGeometry(viewport) + text->RenderOverlay(viewport);
  return drawn + title_->RenderOpaqueGeometry(viewport) + title_->RenderOverlay(viewport);
}

void ClassLegend::ReleaseGraphicsResources(vtkWindow* window) {
  title_->ReleaseGraphicsResources(window);
  plate_.actor()->ReleaseGraphicsResources(window);
  box_actor_->ReleaseGraphicsResources(window);
  for (const auto& text : names_) text->ReleaseGraphicsResources(window);
  vtkActor2D::ReleaseGraphicsResources(window);
}

}  // namespace breccia::gui
