#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "render/ramp.hpp"
#include "render/scene.hpp"

// What the colours of the skin tell.

namespace breccia::gui {
namespace {

using Colour = std::array<double, 3>;

/// Told apart by people who see no red or no green as well (after Okabe and Ito).
constexpr std::array<Colour, 8> kClasses{{{0.34, 0.71, 0.91},
                                          {0.90, 0.62, 0.0},
                                          {0.0, 0.62, 0.45},
                                          {0.80, 0.47, 0.65},
                                          {0.94, 0.89, 0.26},
                                          {0.0, 0.45, 0.70},
                                          {0.84, 0.37, 0.0},
                                          {0.6, 0.6, 0.6}}};

}  // namespace

void Scene::colour() {
  switch (colouring_) {
    case Colouring::group:
      colour_by_class("material", groups_, "group");
      break;
    case Colouring::body:
      colour_by_class("body", {}, "body");
      break;
    case Colouring::fragment:
      colour_by_class("fragment", {}, "fragment");
      break;
    case Colouring::rank:
      colour_by_class("rank", {}, "rank");
      break;
    case Colouring::speed:
      colour_by_value("velocity", -1, 1, "speed [m/s]");
      break;
    case Colouring::von_mises:
      colour_by_value("von_mises", 0, 1e-6, "von Mises [MPa]");
      break;
    case Colouring::tension:
      colour_by_value("principal", 0, 1e-6, "largest principal\nstress [MPa]");
      break;
  }
  draw_chosen();
}

void Scene::colour_by_class(const char* array, const std::vector<std::string>& names, const char* title) {
  constexpr std::size_t kMostNamed = 12;
  const vtkSmartPointer<vtkPolyData> skin = exploded();
  vtkDataArray* values = skin->GetCellData()->GetArray(array);
  vtkNew<vtkIntArray> shown;
  shown->SetName(kShown);
  std::map<std::int64_t, int> seen;  // value -> its place among those present
  // Faces of one class mostly follow each other: it is looked up where it changes.
  const vtkIdType count = values == nullptr ? 0 : values->GetNumberOfTuples();
  std::vector<std::pair<std::int64_t, vtkIdType>> stretches;  // class, and the first face that is not of it
  for (vtkIdType c = 0; c < count; ++c) {
    const auto value = static_cast<std::int64_t>(values->GetComponent(c, 0));
    if (stretches.empty() || stretches.back().first != value) stretches.emplace_back(value, c);
    stretches.back().second = c + 1;
  }
  for (const auto& [value, end] : stretches) seen.emplace(value, 0);
  int next = 0;
  for (auto& [value, place] : seen) place = next++;
  shown->SetNumberOfValues(count);
  vtkIdType at = 0;
  for (const auto& [value, end] : stretches) {
    const int place = seen[value];
    for (; at < end; ++at) shown->SetValue(at, place);
  }
  const bool dims = colouring_ == Colouring::group &&
                    std::any_of(names.begin(), names.end(), [&](const auto& n) { return highlighted_.count(n) != 0; });
  colours_->ResetAnnotations();
  std::vector<ClassLegend::Class> classes;
  colours_->SetNumberOfTableValues(std::max<vtkIdType>(1, static_cast<vtkIdType>(seen.size())));
  for (const auto& [value, place] : seen) {
    Colour c = kClasses[static_cast<std::size_t>(place) % kClasses.size()];
    const auto index = static_cast<std::size_t>(value);
    const std::string name = index < names.size() ? names[index] : std::to_string(value);
    if (dims && highlighted_.count(name) == 0)
      for (double& part : c) part = (dark_ ? 0.25 : 0.75) + 0.1 * part;
    colours_->SetTableValue(place, c[0], c[1], c[2]);
    if (seen.size() > kMostNamed) continue;
    colours_->SetAnnotation(vtkVariant(place), name);
    classes.push_back({c, name});
  }
  colours_->SetTableRange(0, std::max(1.0, static_cast<double>(seen.size()) - 1));
  colours_->SetIndexedLookup(seen.size() <= kMostNamed);
  range_ = {0, static_cast<double>(seen.size()) - 1};
  class_legend_->set_classes(title, classes);
  class_legend_->SetVisibility(!classes.empty());
  legend_->VisibilityOff();
  skin->GetCellData()->AddArray(shown);
  skin_mapper_->SetInputData(skin);
}

void Scene::colour_by_value(const char* array, int component, double scale, const char* title) {
  const vtkSmartPointer<vtkPolyData> skin = exploded();
  vtkDataArray* values = skin->GetCellData()->GetArray(array);
  vtkNew<vtkDoubleArray> shown;
  shown->SetName(kShown);
  double low = 0, high = 0;
  for (vtkIdType c = 0; values != nullptr && c < values->GetNumberOfTuples(); ++c) {
    double x = 0;
    if (component < 0) {
      for (int a = 0; a < values->GetNumberOfComponents(); ++a) x += std::pow(values->GetComponent(c, a), 2);
      x = std::sqrt(x);
    } else {
      x = values->GetComponent(c, component);
    }
    shown->InsertNextValue(scale * x);
    low = c == 0 ? scale * x : std::min(low, scale * x);
    high = c == 0 ? scale * x : std::max(high, scale * x);
  }
  if (!(high > low)) high = low + 1;
  if (hold_) {
    low = std::min(low, range_[0]);
    high = std::max(high, range_[1]);
  }
  range_ = {low, high};
  fill_ramp(*colours_);
  colours_->SetTableRange(low, high);
  legend_->SetTitle(title);
  legend_->VisibilityOn();
  class_legend_->VisibilityOff();
  skin->GetCellData()->AddArray(shown);
  skin_mapper_->SetInputData(skin);
}

}  // namespace breccia::gui
