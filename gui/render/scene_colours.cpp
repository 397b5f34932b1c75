#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkProperty.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "render/fragment_sizes.hpp"
#include "render/ramp.hpp"
#include "render/scene.hpp"
#include "render/value_range.hpp"

// Meaning of the colours of the skin.

namespace breccia::gui {
namespace {

using Colour = std::array<double, 3>;

/// Distinguishable with red-green colour blindness (after Okabe and Ito).
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

/// Ambient share of the light. Surfaces coloured by values are compared with the legend and need more of it; classes
/// can be distinguished in shadow as well.
constexpr double kOfValues = 0.55, kOfClasses = 0.25;

void shade(vtkActor& skin, double ambient) {
  skin.GetProperty()->SetAmbient(ambient);
  skin.GetProperty()->SetDiffuse(1 - ambient);
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
  shade(*skin_, kOfClasses);
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
  is_length(quantity) ? colour_by_length(source) : colour_by_value(source, title_of(quantity));
}

/// They are small in some runs and large in others. A fixed or given range keeps its unit.
void Scene::colour_by_length(const QuantitySource& source) {
  double most = 0;
  for (vtkDataArray* values : {frame_.skin->GetCellData()->GetArray(source.array), values_within(source.array)})
    for (vtkIdType c = 0; values != nullptr && c < values->GetNumberOfTuples(); ++c)
      most = std::max(most, std::abs(number_of(*values, c, source.component)));
  if (const auto given = given_ranges_.find(colouring_); given != given_ranges_.end()) {
    unit_of_length_ = given->second.unit;
  } else if (!hold_) {
    unit_of_length_ = prefixed_unit(most > source.noise ? most : 0, "m");
  }
  QuantitySource shown = source;
  shown.scale = 1 / unit_of_length_.size;
  colour_by_value(shown, std::string(source.name) + " [" + unit_of_length_.name + "]");
}

/// Of the values in view, or of all where a cut may show any of them.
std::array<double, 2> Scene::range_of(const QuantitySource& source, vtkPolyData& skin) const {
  std::vector<double> values;
  double most = 0;
  for (vtkDataArray* array : {skin.GetCellData()->GetArray(source.array), values_within(source.array)}) {
    if (array == nullptr) continue;
    values.reserve(values.size() + static_cast<std::size_t>(array->GetNumberOfTuples()));
    for (vtkIdType c = 0; c < array->GetNumberOfTuples(); ++c) {
      values.push_back(source.scale * number_of(*array, c, source.component));
      for (int a = 0; a < array->GetNumberOfComponents(); ++a)
        most = std::max(most, std::abs(array->GetComponent(c, a)));
    }
  }
  // Small fragments are many where they have few faces: none is an outlier.
  const double outliers = std::string_view(source.array) == kFragmentSize ? 0 : kOutliers;
  return value_range(std::move(values), noise_of(source, most), outliers);
}

void Scene::colour_by_value(const QuantitySource& source, const std::string& title) {
  shade(*skin_, kOfValues);
  const vtkSmartPointer<vtkPolyData> skin = exploded();
  choose_range(range_of(source, *skin));
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

/// @param found  of the values in view
void Scene::choose_range(std::array<double, 2> found) {
  auto [low, high] = found;
  if (hold_) {
    low = std::min(low, range_[0]);
    high = std::max(high, range_[1]);
  }
  const ColourRange given = colour_range();
  low = given.low.value_or(low);
  high = given.high.value_or(high);
  if (!(high > low)) {  // all are 0, or lie beyond the end that is given
    const double width = std::max(std::abs(low), 1e-300) * 1e-3;
    given.high&& !given.low ? low = high - width : high = low + (low == 0 ? 1.0 : width);
  }
  range_ = {low, high};
}

void Scene::set_colour_range(const ColourRange& range) {
  if (range == ColourRange{}) {
    given_ranges_.erase(colouring_);
  } else {
    given_ranges_[colouring_] = {range, unit_of_length_};
  }
  if (has_data()) colour();
}

ColourRange Scene::colour_range() const {
  const auto given = given_ranges_.find(colouring_);
  return given == given_ranges_.end() ? ColourRange{} : given->second.range;
}

}  // namespace breccia::gui
