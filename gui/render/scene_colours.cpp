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

/// Cells of one class mostly follow each other: it is looked up where it changes. Class, and the first cell that is
/// not of it.
std::vector<std::pair<std::int64_t, vtkIdType>> stretches_of(vtkDataArray* values) {
  std::vector<std::pair<std::int64_t, vtkIdType>> stretches;
  for (vtkIdType c = 0; values != nullptr && c < values->GetNumberOfTuples(); ++c) {
    const auto value = static_cast<std::int64_t>(values->GetComponent(c, 0));
    if (stretches.empty() || stretches.back().first != value) stretches.emplace_back(value, c);
    stretches.back().second = c + 1;
  }
  return stretches;
}

vtkSmartPointer<vtkDataArray> places_of(vtkDataArray* values, const std::map<std::int64_t, int>& seen) {
  auto places = vtkSmartPointer<vtkIntArray>::New();
  places->SetName(Scene::kShown);
  places->SetNumberOfValues(values == nullptr ? 0 : values->GetNumberOfTuples());
  vtkIdType at = 0;
  for (const auto& [value, end] : stretches_of(values))
    for (const int place = seen.at(value); at < end; ++at) places->SetValue(at, place);
  return places;
}

/// @param component  < 0: the magnitude
double number_of(vtkDataArray& values, vtkIdType cell, int component) {
  if (component >= 0) return values.GetComponent(cell, component);
  double sum = 0;
  for (int a = 0; a < values.GetNumberOfComponents(); ++a)
    sum += values.GetComponent(cell, a) * values.GetComponent(cell, a);
  return std::sqrt(sum);
}

vtkSmartPointer<vtkDataArray> numbers_of(vtkDataArray* values, int component, double scale) {
  auto numbers = vtkSmartPointer<vtkDoubleArray>::New();
  numbers->SetName(Scene::kShown);
  numbers->SetNumberOfValues(values == nullptr ? 0 : values->GetNumberOfTuples());
  for (vtkIdType c = 0; c < numbers->GetNumberOfValues(); ++c)
    numbers->SetValue(c, scale * number_of(*values, c, component));
  return numbers;
}

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
    case Colouring::displacement:
      colour_by_displacement(-1);
      break;
    case Colouring::displacement_x:
    case Colouring::displacement_y:
    case Colouring::displacement_z:
      colour_by_displacement(static_cast<int>(colouring_) - static_cast<int>(Colouring::displacement_x));
      break;
  }
  draw_cut();
  draw_chosen();
}

/// Of all elements, where a cut shows any of them: colours stay as they are wherever it goes.
vtkDataArray* Scene::values_within(const char* array) const {
  return cut_plane_ && frame_.elements != nullptr ? frame_.elements->GetCellData()->GetArray(array) : nullptr;
}

void Scene::colour_by_class(const char* array, const std::vector<std::string>& names, const char* title) {
  constexpr std::size_t kMostNamed = 12;
  const vtkSmartPointer<vtkPolyData> skin = exploded();
  std::map<std::int64_t, int> seen;  // value -> its place among those present
  for (vtkDataArray* values : {skin->GetCellData()->GetArray(array), values_within(array)})
    for (const auto& [value, end] : stretches_of(values)) seen.emplace(value, 0);
  int next = 0;
  for (auto& [value, place] : seen) place = next++;
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
  shown_ = [array = std::string(array), seen](vtkCellData& cells) {
    return places_of(cells.GetArray(array.c_str()), seen);
  };
  skin->GetCellData()->AddArray(shown_(*skin->GetCellData()));
  skin_mapper_->SetInputData(skin);
}

/// They are small in some runs and large in others. A range that is held keeps its unit. @param component  < 0: none
void Scene::colour_by_displacement(int component) {
  double most = 0;
  for (vtkDataArray* values : {frame_.skin->GetCellData()->GetArray("displacement"), values_within("displacement")})
    for (vtkIdType c = 0; values != nullptr && c < values->GetNumberOfTuples(); ++c)
      most = std::max(most, std::abs(number_of(*values, c, component)));
  if (!hold_) unit_of_displacement_ = prefixed_unit(most, "m");
  const std::string name = component < 0 ? "displacement" : std::string("displacement ") + "xyz"[component];
  colour_by_value("displacement", component, 1 / unit_of_displacement_.size,
                  (name + " [" + unit_of_displacement_.name + "]").c_str());
}

void Scene::colour_by_value(const char* array, int component, double scale, const char* title) {
  const vtkSmartPointer<vtkPolyData> skin = exploded();
  double low = 0, high = 0;
  bool any = false;
  for (vtkDataArray* values : {skin->GetCellData()->GetArray(array), values_within(array)})
    for (vtkIdType c = 0; values != nullptr && c < values->GetNumberOfTuples(); ++c) {
      const double x = scale * number_of(*values, c, component);
      low = any ? std::min(low, x) : x;
      high = any ? std::max(high, x) : x;
      any = true;
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
  shown_ = [array = std::string(array), component, scale](vtkCellData& cells) {
    return numbers_of(cells.GetArray(array.c_str()), component, scale);
  };
  skin->GetCellData()->AddArray(shown_(*skin->GetCellData()));
  skin_mapper_->SetInputData(skin);
}

}  // namespace breccia::gui
