#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <array>
#include <string>
#include <vector>

#include "render/vectors.hpp"

namespace breccia::gui {

/// Words of the loads beside their glyphs, none over another one. They are placed anew for every picture, since what
/// lies apart in space may cover each other on the screen.
class LoadWords {
 public:
  /// @param renderer  outlives this
  explicit LoadWords(vtkRenderer& renderer) : renderer_(renderer) {}
  void clear();
  /// @param places  in the model, where they may stand; at least one
  void add(const std::string& words, std::vector<Vector> places);
  void set_dark(bool dark);
  /// To be called when a picture begins.
  void place();

  /// Of the last picture: left, right, bottom, top in pixels.
  using Box = std::array<double, 4>;
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

 private:
  struct Label {
    vtkSmartPointer<vtkTextActor> actor;
    std::vector<Vector> places;
    std::size_t chosen =
        0;  ///< the place of the last picture, kept while it is free, so that words stay where they are
  };
  [[nodiscard]] Box box_at(const Label& label, std::size_t place) const;
  [[nodiscard]] bool is_free(const Box& box) const;
  void style(vtkTextActor& actor) const;

  vtkRenderer& renderer_;
  std::vector<Label> labels_;
  std::vector<Box> boxes_;
  bool dark_ = false;
};

}  // namespace breccia::gui
