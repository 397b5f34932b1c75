#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "render/frame_data.hpp"

/// Loads and constraints as they are seen on a model at rest. VTK only.
namespace breccia::gui {

/// Glyph of a load: distinguished by shape, not by colour.
enum class LoadShape {
  arrow,         ///< with one head: prescribed motion, gravity
  double_arrow,  ///< with two heads: initial velocity
  pressure,      ///< arrows along the normals of the faces, onto them where it is positive
  support,       ///< cones that stand on the faces, one for each constrained axis
  random,        ///< arrows with two heads that point anywhere: random velocities
  stretch,   ///< arrows with a foot, each as long as the velocity at its face: stretching about the centre of a body
  spin,      ///< an arc about an axis through the centre of each body
  absorbing  ///< discs that shrink away from the faces, as waves that leave
};
inline constexpr std::size_t kNumLoadShapes = 8;

struct Load {
  LoadShape shape = LoadShape::arrow;
  std::string group;  ///< volume or surface group; empty: the whole model
  /// Of arrows, any length; of a pressure: its sign comes first; of a stretching: rates along the axes, 1/s; of a spin:
  /// rad/s about the axes.
  std::array<double, 3> direction{};
  std::array<bool, 3> axes{};                 ///< of a support
  std::string words;                          ///< stands beside the glyphs
  std::map<std::string, double> densities{};  ///< kg/m3, by volume group, of a stretching and a spin
};

struct LoadGlyphs {
  vtkSmartPointer<vtkPolyData> mesh;  ///< triangles
  /// Ends of the glyphs that are away from the model, of each: where its words may stand.
  std::vector<std::array<double, 3>> places;
  bool inner = false;  ///< on faces within the model, as those of a slit: they are hidden by it
  [[nodiscard]] int count() const { return static_cast<int>(places.size()); }
};

/// At most some dozens of glyphs, spread over the faces of the group; none: it is not seen.
/// @param skin      with the arrays "material", "id" and "side", each triangle with points of its own
/// @param elements  the model of that skin, where faces are found that the skin does not have, and centres of bodies,
///                  with "body" and "material"; nullptr: unknown, and what goes by centres is not drawn
/// @param volumes   names of the volume groups in the order of "material"
[[nodiscard]] LoadGlyphs draw_load(vtkPolyData& skin, vtkUnstructuredGrid* elements,
                                   const std::vector<std::string>& volumes, const SurfaceGroups& surfaces,
                                   const Load& load);

}  // namespace breccia::gui
