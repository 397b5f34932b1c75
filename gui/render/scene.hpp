#pragma once

#include <vtkActor.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "render/axes_corner.hpp"
#include "render/class_legend.hpp"
#include "render/cut.hpp"
#include "render/element_quantity.hpp"
#include "render/frame_data.hpp"
#include "render/load_glyphs.hpp"
#include "render/load_words.hpp"
#include "render/prefixed_unit.hpp"
#include "render/scale_bar.hpp"

namespace breccia::gui {

/// What the colour of the skin means.
enum class Colouring {
  group,
  body,
  fragment,
  rank,
  first_quantity  ///< those from here on are made by colouring_by
};

[[nodiscard]] constexpr Colouring colouring_by(Quantity quantity) {
  return static_cast<Colouring>(static_cast<int>(Colouring::first_quantity) + static_cast<int>(quantity));
}
/// None for a colouring by classes.
[[nodiscard]] std::optional<Quantity> quantity_of(Colouring colouring);

/// The ends of the colours as they are given, in the unit of the legend; none: that of value_range.
struct ColourRange {
  std::optional<double> low, high;
  bool operator==(const ColourRange&) const = default;
};

/// What the colour of the joints means; hidden: they are not drawn.
enum class JointColouring { mode, time_of_failure, hidden };

/// View direction: from a corner above the model, or along an axis.
enum class LookFrom { corner, plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };

/// The colourings with their names for people, units among them.
[[nodiscard]] const std::vector<std::pair<Colouring, std::string>>& colourings();

/// The 3D picture: skin of the bodies, cracks by mode, legend, title. A legend also names the colours in words.
class Scene {
 public:
  Scene();
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  [[nodiscard]] vtkRenderer* renderer() { return renderer_; }
  /// Of the axes, for the layer above.
  [[nodiscard]] vtkRenderer* axes_renderer() { return axes_.renderer(); }

  void show(const FrameData& frame);
  void clear();
  void set_colouring(Colouring colouring);
  [[nodiscard]] Colouring colouring() const { return colouring_; }
  void set_joint_colouring(JointColouring colouring);
  /// Which joints are drawn beside the cracks: those that hold with at least so much damage. @param least  none: none
  void set_least_damage(const std::optional<double>& least);
  /// Names of the volume groups in the order of the array "material".
  void set_groups(const std::vector<std::string>& names);
  [[nodiscard]] const std::vector<std::string>& groups() const { return groups_; }
  void set_surfaces(SurfaceGroups surfaces);
  /// Volume groups that are shown bright while others are dim, and surface groups whose faces are marked; none: all
  /// alike.
  void highlight(const std::vector<std::string>& groups);
  /// Faces that are marked as those of surface groups.
  [[nodiscard]] vtkIdType num_chosen() const;
  /// What is seen at a pixel, from the lower left corner.
  struct Picked {
    std::string volume;                 ///< its group; empty: nothing is there
    std::vector<std::string> surfaces;  ///< groups that the face belongs to
  };
  [[nodiscard]] Picked picked_at(double x, double y) const;
  /// Of the present colouring, until it is given anew: each has its own. A quantity keeps its unit meanwhile.
  void set_colour_range(const ColourRange& range);
  /// All that were given are found anew: another model follows.
  void forget_colour_ranges() { given_ranges_.clear(); }
  [[nodiscard]] ColourRange colour_range() const;
  /// Keeps the range of colours of the present picture for those that follow, so that they can be compared.
  void hold_range(bool on) { hold_ = on; }
  /// How far parts of different ranks are moved apart: 0 not at all.
  void set_explode(double share);
  /// Cuts the model open: half of it is hidden, and the elements that the plane goes through are seen in it.
  void set_cut(const std::optional<CutPlane>& plane);
  /// Elements that are seen cut through.
  [[nodiscard]] vtkIdType num_cut() const;
  /// The arrays of those, the one that they are coloured by among them; nullptr: there are none.
  [[nodiscard]] vtkCellData* cut_values() const;
  /// From where to where the model reaches along a direction, m; { 0, 0 }: nothing is there.
  [[nodiscard]] std::array<double, 2> extent(const Vector& normal) const;
  /// Draws these faces and makes the others transparent; nullptr: none.
  void mark(vtkPolyData* faces);
  [[nodiscard]] vtkIdType num_marked() const;
  /// Loads and constraints as glyphs with their words, at the places of their groups.
  void set_loads(std::vector<Load> loads);
  void show_loads(bool on);
  /// Glyphs that are drawn.
  [[nodiscard]] int num_glyphs() const { return num_glyphs_; }
  void show_edges(bool on);
  void show_skin(bool on);
  void set_dark(bool dark);
  void set_caption(const std::string& text);
  [[nodiscard]] std::string caption() const { return caption_->GetInput() == nullptr ? "" : caption_->GetInput(); }
  /// The direction that is drawn upwards, of length one along an axis, from the next look_from() on.
  void set_up(const std::array<double, 3>& up) { up_ = up; }
  [[nodiscard]] const std::array<double, 3>& up() const { return up_; }
  /// Shows the whole model from there.
  void look_from(LookFrom where);
  void reset_camera() { look_from(LookFrom::corner); }
  /// The view direction.
  [[nodiscard]] Vector look() const;
  /// The axes in the corner and the scale bar.
  void show_axes(bool on);
  [[nodiscard]] bool has_data() const { return frame_.skin != nullptr; }
  [[nodiscard]] vtkIdType num_faces() const { return frame_.skin == nullptr ? 0 : frame_.skin->GetNumberOfCells(); }
  [[nodiscard]] vtkIdType num_broken() const;
  /// Joints that are drawn.
  [[nodiscard]] vtkIdType num_joints() const;
  [[nodiscard]] bool is_broken() const { return frame_.is_broken; }
  [[nodiscard]] const ClassLegend& class_legend() const { return *class_legend_; }
  [[nodiscard]] const ScaleBar& scale_bar() const { return *scale_bar_; }
  [[nodiscard]] const LoadWords& load_words() const { return words_; }
  /// Range of the times of failure that the joints are coloured by, s; { 0, 0 }: by something else, or none has failed.
  [[nodiscard]] std::array<double, 2> failure_range() const { return failure_range_; }
  /// Range of what is coloured, for the legend.
  [[nodiscard]] std::array<double, 2> range() const { return range_; }

  static constexpr const char* kShown = "shown";  ///< array that skin and cut are coloured by

 private:
  void colour();
  void draw_cut();
  void draw_chosen();
  void draw_loads();
  void draw_joints();
  void begin_picture();
  void colour_joints_by_mode(vtkPolyData& joints);
  void colour_joints_by_time(vtkPolyData& joints);
  void style_legends();
  void fit_beside(double middle);
  [[nodiscard]] std::int64_t face_of(vtkIdType cell) const;
  void set_opacity();
  void colour_by_class(const char* array, const std::vector<std::string>& names, const char* title);
  void colour_by_quantity(Quantity quantity);
  void colour_by_length(const QuantitySource& source);
  void colour_by_value(const QuantitySource& source, const std::string& title);
  void choose_range(std::array<double, 2> found);
  [[nodiscard]] std::array<double, 2> range_of(const QuantitySource& source, vtkPolyData& skin) const;
  [[nodiscard]] vtkDataArray* values_within(const char* array) const;
  [[nodiscard]] std::map<int, Vector> explode_ways() const;
  [[nodiscard]] vtkSmartPointer<vtkPolyData> exploded() const;
  [[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> exploded_elements() const;

  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkPolyDataMapper> skin_mapper_, broken_mapper_, marked_mapper_, chosen_mapper_, cut_mapper_;
  vtkNew<vtkActor> skin_, broken_, marked_, chosen_, cut_;
  vtkNew<vtkPlane> clip_;
  vtkNew<vtkLookupTable> colours_, mode_colours_, time_colours_;
  vtkNew<vtkScalarBarActor> legend_, time_legend_;
  vtkNew<ClassLegend> class_legend_, mode_legend_;
  vtkNew<vtkTextActor> caption_;
  vtkNew<ScaleBar> scale_bar_;
  AxesCorner axes_;
  unsigned long begins_ = 0;  ///< observer of pictures that begin
  FrameData frame_;
  std::vector<std::string> groups_;
  std::set<std::string> highlighted_;
  SurfaceGroups surfaces_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> groups_of_face_;
  std::vector<Load> loads_;
  std::vector<vtkSmartPointer<vtkActor>> glyphs_;
  LoadWords words_{*renderer_};
  Colouring colouring_ = Colouring::group;
  JointColouring joint_colouring_ = JointColouring::mode;
  std::optional<double> least_damage_;
  std::array<double, 3> up_{0, 1, 0};
  std::array<double, 2> failure_range_{0, 0};
  double explode_ = 0;
  std::optional<CutPlane> cut_plane_;
  std::optional<Cut> through_;  ///< the frame in view in that direction; none: not worked out yet
  struct GivenRange {
    ColourRange range;
    PrefixedUnit unit;  ///< of a length
  };
  std::map<Colouring, GivenRange> given_ranges_;
  PrefixedUnit unit_of_length_;
  std::function<vtkSmartPointer<vtkDataArray>(vtkCellData&)> shown_;  ///< what cells are coloured by, of their arrays
  int num_glyphs_ = 0;
  std::array<double, 2> range_{0, 1};
  bool hold_ = false, solid_ = true, dark_ = false, shows_loads_ = true, shows_axes_ = true;
};

}  // namespace breccia::gui
