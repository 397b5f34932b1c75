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

vtkSmartPointer<vtkDataArray> numbers_of(vtkDataArray* values, int component, double scale) {
  auto numbers = vtkSmartPointer<vtkDoubleArray>::New();
  numbers->SetName(Scene::kShown);
  numbers->SetNumberOfValues(values == nullptr ? 0 : values->GetNumberOfTuples());
  for (vtkIdType c = 0; c < numbers->GetNumberOfValues(); ++c)
    numbers->SetValue(c, scale * number_of(*values, c, component));
  return numbers;
}

/// The words of a legend stand beside the model, where there is little room.
std::string in_two_lines(std::string title) {
  constexpr std::size_t kNarrow = 18;
  const std::size_t half = title.rfind(' ', title.size() / 2 + 3);
  if (title.size() > kNarrow && half != std::string::npos) title[half] = '\n';
  return title;
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
    default:
      colour_by_quantity(*quantity_of(colouring_));
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

void Scene::colour_by_quantity(Quantity quantity) {
  const QuantitySource& source = source_of(quantity);
  is_displacement(quantity) ? colour_by_displacement(source) : colour_by_value(source, title_of(quantity));
}

/// They are small in some runs and large in others. A range that is held or given keeps its unit.
void Scene::colour_by_displacement(const QuantitySource& source) {
  double most = 0;
  for (vtkDataArray* values : {frame_.skin->GetCellData()->GetArray(source.array), values_within(source.array)})
    for (vtkIdType c = 0; values != nullptr && c < values->GetNumberOfTuples(); ++c)
      most = std::max(most, std::abs(number_of(*values, c, source.component)));
  if (const auto given = given_ranges_.find(colouring_); given != given_ranges_.end()) {
    unit_of_displacement_ = given->second.unit;
  } else if (!hold_) {
    unit_of_displacement_ = prefixed_unit(most, "m");
  }
  QuantitySource shown = source;
  shown.scale = 1 / unit_of_displacement_.size;
  colour_by_value(shown, std::string(source.name) + " [" + unit_of_displacement_.name + "]");
}

void Scene::colour_by_value(const QuantitySource& source, const std::string& title) {
  const vtkSmartPointer<vtkPolyData> skin = exploded();
  double low = 0, high = 0;
  bool any = false;
  for (vtkDataArray* values : {skin->GetCellData()->GetArray(source.array), values_within(source.array)})
    for (vtkIdType c = 0; values != nullptr && c < values->GetNumberOfTuples(); ++c) {
      const double x = source.scale * number_of(*values, c, source.component);
      low = any ? std::min(low, x) : x;
      high = any ? std::max(high, x) : x;
      any = true;
    }
  choose_range(low, high);
  fill_ramp(*colours_);
  colours_->SetTableRange(range_[0], range_[1]);
  legend_->SetTitle(in_two_lines(title).c_str());
  legend_->VisibilityOn();
  class_legend_->VisibilityOff();
  shown_ = [source](vtkCellData& cells) {
    return numbers_of(cells.GetArray(source.array), source.component, source.scale);
  };
  skin->GetCellData()->AddArray(shown_(*skin->GetCellData()));
  skin_mapper_->SetInputData(skin);
}

/// @param low, high  of the values in view
void Scene::choose_range(double low, double high) {
  if (hold_) {
    low = std::min(low, range_[0]);
    high = std::max(high, range_[1]);
  }
  const ColourRange given = colour_range();
  low = given.low.value_or(low);
  high = given.high.value_or(high);
  if (!(high > low)) {  // all are equal, or lie beyond the end that is given
    const double width = std::max(std::abs(low), 1e-300) * 1e-3;
    given.high&& !given.low ? low = high - width : high = low + (low == 0 ? 1.0 : width);
  }
  range_ = {low, high};
}

void Scene::set_colour_range(const ColourRange& range) {
  if (range == ColourRange{}) {
    given_ranges_.erase(colouring_);
  } else {
    given_ranges_[colouring_] = {range, unit_of_displacement_};
  }
  if (has_data()) colour();
}

ColourRange Scene::colour_range() const {
  const auto given = given_ranges_.find(colouring_);
  return given == given_ranges_.end() ? ColourRange{} : given->second.range;
}

}  // namespace breccia::gui
