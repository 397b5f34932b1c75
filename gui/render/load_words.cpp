#include "render/load_words.hpp"

#include <vtkTextProperty.h>

#include "render/plate.hpp"

namespace breccia::gui {

void LoadWords::clear() {
  for (const Label& label : labels_) renderer_.RemoveViewProp(label.actor);
  labels_.clear();
  boxes_.clear();
}

void LoadWords::add(const std::string& words, std::vector<Vector> places) {
  // Loads of one group have the same places: the labels of each begin at another one.
  const std::size_t first = labels_.size() % places.size();
  Label& label = labels_.emplace_back(Label{vtkSmartPointer<vtkTextActor>::New(), std::move(places), first});
  label.actor->SetInput(words.c_str());
  label.actor->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  label.actor->PickableOff();
  label.actor->GetTextProperty()->SetFontSize(13);
  style(*label.actor);
  renderer_.AddViewProp(label.actor);
}

void LoadWords::style(vtkTextActor& actor) const {
  const double ink = dark_ ? 1 : 0, ground = plate_grey(dark_);
  actor.GetTextProperty()->SetColor(ink, ink, ink);
  actor.GetTextProperty()->SetBackgroundColor(ground, ground, ground);
  actor.GetTextProperty()->SetBackgroundOpacity(kPlateOpacity);
}

void LoadWords::set_dark(bool dark) {
  dark_ = dark;
  for (const Label& label : labels_) style(*label.actor);
}

LoadWords::Box LoadWords::box_at(const Label& label, std::size_t place) const {
  Vector at = label.places[place];
  renderer_.WorldToView(at[0], at[1], at[2]);
  renderer_.ViewToNormalizedViewport(at[0], at[1], at[2]);
  renderer_.NormalizedViewportToViewport(at[0], at[1]);
  std::array<double, 2> size{};
  label.actor->GetSize(&renderer_, size.data());
  return {at[0], at[0] + size[0], at[1], at[1] + size[1]};
}

bool LoadWords::is_free(const Box& box) const {
  constexpr double kGap = 2;  // pixels
  const int* size = renderer_.GetSize();
  if (box[0] < 0 || box[1] > size[0] || box[2] < 0 || box[3] > size[1]) return false;
  for (const Box& taken : boxes_)
    if (box[0] < taken[1] + kGap && taken[0] < box[1] + kGap && box[2] < taken[3] + kGap && taken[2] < box[3] + kGap)
      return false;
  return true;
}

void LoadWords::place() {
  boxes_.clear();
  for (Label& label : labels_) {
    Box box = box_at(label, label.chosen);
    for (std::size_t i = 0; i < label.places.size() && !is_free(box); ++i) {
      if (const Box other = box_at(label, i); is_free(other)) {
        label.chosen = i;
        box = other;
      }
    }
    // Where no place is free the words climb above those that are there.
    const double height = box[3] - box[2];
    for (std::size_t i = 0; i < labels_.size() && !is_free(box); ++i) {
      box[2] += height;
      box[3] += height;
    }
    boxes_.push_back(box);
    label.actor->SetPosition(box[0], box[2]);
  }
}

}  // namespace breccia::gui
