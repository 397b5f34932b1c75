#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/deformation.hpp"

/// What is drawn of a frame: the skin of the bodies and the joints that are damaged. VTK only, no Qt; everything here
/// may be called from any thread, one at a time for each object.
namespace breccia::gui {

/// Corners of the face opposite to corner i, seen from outside in the same sense.
inline constexpr std::array<std::array<int, 3>, 4> kTetraFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Reads what is drawn of a VTKHDF file of the solver. nullptr: it cannot be read.
[[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> read_vtkhdf(const std::string& file);

/// Faces of the elements that are seen. Which are inner ones is found once, from the state at rest: two faces of one
/// body whose corners rest at the same places. They are drawn as well where they have come apart. Elements are named by
/// their ids, since frames of several ranks have them in other orders.
class Skin {
 public:
  /// @param rest  elements of any frame: it is moved back by the displacement. O(elements)
  explicit Skin(vtkUnstructuredGrid& rest);

  /// The faces as triangles with the arrays of their elements and, as "side", the face of the element.
  /// @param elements  any frame of the same model
  [[nodiscard]] vtkSmartPointer<vtkPolyData> draw(vtkUnstructuredGrid& elements) const;
  /// What is seen of a part alone: faces of the chosen elements but for those that two of them share. No arrays.
  /// @param chosen  by row of the frame
  [[nodiscard]] vtkSmartPointer<vtkPolyData> draw_part(vtkUnstructuredGrid& elements,
                                                       const std::vector<bool>& chosen) const;
  [[nodiscard]] std::size_t num_outer() const { return outer_.size(); }
  [[nodiscard]] std::size_t num_inner() const { return inner_.size(); }

 private:
  struct Face {
    std::int64_t element;              ///< id
    int side;                          ///< opposite corner
    std::array<std::int8_t, 3> order;  ///< corners of the element in the order of their places
  };
  std::vector<Face> outer_;
  std::vector<std::array<Face, 2>> inner_;  ///< two that rest on each other
};

/// The surface groups of a mesh: what a pick finds and a row shows. And its curves and points.
struct SurfaceGroups {
  std::vector<std::string> names;
  std::vector<std::vector<std::int64_t>> faces;            ///< of each: 4 * id of the element + side
  std::vector<std::string> curves;                         ///< and points
  std::vector<std::vector<std::array<double, 3>>> places;  ///< m, of the nodes of each
};

/// One instant, ready to be drawn.
struct FrameData {
  double time = 0;
  vtkSmartPointer<vtkPolyData> skin;              ///< nullptr: could not be read
  vtkSmartPointer<vtkPolyData> damaged;           ///< triangles of the joints that carry damage
  bool is_broken = false;                         ///< there are more fragments than bodies
  std::shared_ptr<const Skin> faces;              ///< of this model, for the next frame
  vtkSmartPointer<vtkUnstructuredGrid> elements;  ///< all of them; only read once the frame is delivered
  vtkSmartPointer<vtkUnstructuredGrid> drawn;     ///< the same, where they are drawn: displacements may be enlarged
  vtkSmartPointer<vtkUnstructuredGrid> joints;    ///< all that carry damage, as and where the drawn; nullptr: none
  Deformation deformation;                        ///< as it is drawn; what was found for it holds for the next frame
};

/// @param joints_file  empty: none is there
/// @param faces        of the same run, nullptr: found anew
[[nodiscard]] FrameData load_frame(const std::string& elements_file, const std::string& joints_file, double time,
                                   std::shared_ptr<const Skin> faces, Deformation deformation = {});

/// Adds the array "rank" to skin and elements by the owner of each element. @param owner  by id
void set_ranks(FrameData& frame, const std::vector<int>& owner);

}  // namespace breccia::gui
