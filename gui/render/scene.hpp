#pragma once

#include <vtkActor.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>

#include <array>
#include <string>
#include <vector>

#include "render/frame_data.hpp"

namespace breccia::gui {

/// What the colour of the skin means.
enum class Colouring { group, body, fragment, rank, speed, von_mises, tension };

/// The colourings with their names for people, units among them.
[[nodiscard]] const std::vector<std::pair<Colouring, std::string>>& colourings();

/// The 3D picture: skin of the bodies, damaged joints by mode, legend, title. Colours are told apart by a legend in
/// words as well.
class Scene {
 public:
  Scene();

  [[nodiscard]] vtkRenderer* renderer() { return renderer_; }

  void show(const FrameData& frame);
  void clear();
  void set_colouring(Colouring colouring);
  [[nodiscard]] Colouring colouring() const { return colouring_; }
  /// Names of the volume groups in the order of the array "material".
  void set_groups(const std::vector<std::string>& names) { groups_ = names; }
  /// The group that is shown bright while others are dim; empty: all alike.
  void highlight(const std::string& group);
  /// The group of what is seen at a pixel, from the lower left corner; empty: nothing is there.
  [[nodiscard]] std::string group_at(double x, double y) const;
  /// Keeps the range of colours of the present picture for those that follow, so that they can be compared.
  void hold_range(bool on) { hold_ = on; }
  /// How far parts of different ranks are moved apart: 0 not at all.
  void set_explode(double share);
  /// Draws these faces and looks through the others at them; nullptr: none.
  void mark(vtkPolyData* faces);
  [[nodiscard]] vtkIdType num_marked() const;
  void show_edges(bool on);
  void show_skin(bool on);
  void set_dark(bool dark);
  void set_caption(const std::string& text);
  /// Looks at everything from a corner.
  void reset_camera();
  [[nodiscard]] bool has_data() const { return frame_.skin != nullptr; }
  [[nodiscard]] vtkIdType num_faces() const { return frame_.skin == nullptr ? 0 : frame_.skin->GetNumberOfCells(); }
  [[nodiscard]] vtkIdType num_broken() const;
  /// Range of what is coloured, for the legend.
  [[nodiscard]] std::array<double, 2> range() const { return range_; }

 private:
  void colour();
  void set_opacity();
  void colour_by_class(const char* array, const std::vector<std::string>& names, const char* title);
  void colour_by_value(const char* array, int component, double scale, const char* title);
  [[nodiscard]] vtkSmartPointer<vtkPolyData> exploded() const;

  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkPolyDataMapper> skin_mapper_, broken_mapper_, marked_mapper_;
  vtkNew<vtkActor> skin_, broken_, marked_;
  vtkNew<vtkLookupTable> colours_, mode_colours_;
  vtkNew<vtkScalarBarActor> legend_, mode_legend_;
  vtkNew<vtkTextActor> caption_;
  FrameData frame_;
  std::vector<std::string> groups_;
  std::string highlighted_;
  Colouring colouring_ = Colouring::group;
  double explode_ = 0;
  std::array<double, 2> range_{0, 1};
  bool hold_ = false, solid_ = true;
};

}  // namespace breccia::gui
