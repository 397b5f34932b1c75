#pragma once

#include <array>
#include <vector>

#include "base/index.hpp"
#include "base/types.hpp"
#include "mesh/tetrahedron.hpp"
#include "physics/contact/step/contact_step.hpp"

namespace breccia {

/// What the open faces of elements add (ContactElement), with the slopes of law and field as contact_forces uses them.
/// For elements.cpp only.
class ContactSurface {
 public:
  /// @param shared  whether elements that share nodes will be requested: O(their faces). The model outlives this object
  ContactSurface(const ContactStepModel& model, bool shared);

  /// O(1)
  [[nodiscard]] ContactElement element(Index slot) const;

 private:
  template <class F>
  void for_each_open(Index slot, F&& f) const {
    if (model_.mesh.element_of_slot[at(slot)] >= 0) for_each_face(model_.faces.open[at(slot)], f);
  }
  template <class F>
  void for_each_shared_corner(F&& f) const;

  void set_corners(Index slot, ContactElement& element) const;
  [[nodiscard]] double steepness(Index slot, int face) const;
  [[nodiscard]] double slope_squared(Index slot, const std::array<double, 4>& row) const;
  void improve_scale();
  [[nodiscard]] Mat3 face_matrix(Index slot, int face) const;

  const ContactStepModel& model_;
  double tangential_;
  bool one_point_;
  std::vector<double> scale_;  ///< (shared nodes) x
  std::vector<Mat3> shared_;   ///< (shared nodes) A_i
};

}  // namespace breccia
