#pragma once

#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "model/model.hpp"

namespace breccia {

/// What is known of a body in a stage.
struct Solid {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = Vec3::Constant(std::numeric_limits<double>::lowest());
  double speed = std::numeric_limits<double>::max();  ///< m/s, of waves, the slowest
  double edge = std::numeric_limits<double>::max();   ///< m, H of contact
  bool held = false;                                  ///< somewhere, in the stage
  bool whole = false;                                 ///< all of it is constrained along all axes
  bool pressed = false;                               ///< a pressure or traction of the stage acts on it

  [[nodiscard]] bool exists() const { return speed < std::numeric_limits<double>::max(); }
  [[nodiscard]] double size() const { return (high - low).norm(); }
  /// s, in which a wave crosses it.
  [[nodiscard]] double crossing() const { return exists() ? size() / speed : 0.0; }
};

/// Density times speed of a wave, of a volume group, Pa s/m.
[[nodiscard]] double impedance(const Model& model, std::size_t group);

/// The bodies of a model, each known by its number.
class Solids {
 public:
  /// @param model  stays; of the whole mesh, a bare one will do. O(elements)
  explicit Solids(const Model& model);

  /// The solid of an element.
  [[nodiscard]] std::size_t number(Index element) const {
    return static_cast<std::size_t>(model_.mesh.element_body[static_cast<std::size_t>(element)]);
  }
  [[nodiscard]] const Solid& operator[](std::size_t number) const { return all_[number]; }
  /// Their number.
  [[nodiscard]] std::size_t end() const { return all_.size(); }

  /// Which of them the constraints of a stage hold, and its pressures, tractions and forces act on.
  /// O(elements x entries)
  void hold(const case_::Stage& stage);

  /// The largest crossing time of a wave, s.
  [[nodiscard]] double slowest_crossing() const;

  /// Largest wave transit time of the solids that are constrained, supported or pressed, s; 0: none.
  [[nodiscard]] double slowest_at_rest() const;

  /// Whether two solids lie on each other: there is contact and their boxes touch.
  [[nodiscard]] bool touch(std::size_t one, std::size_t other) const;

  /// Calls f(element, whether the group is a volume) for the elements of a volume group, behind the faces of a surface
  /// group, or around the nodes of a curve or point.
  template <class F>
  void for_each_element(const std::string& group, F&& f) const {
    const Mesh& mesh = model_.mesh;
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      if (mesh.volume_groups[static_cast<std::size_t>(mesh.element_group[static_cast<std::size_t>(e)])] == group)
        f(e, true);
    }
    for (std::size_t s = 0; s < mesh.surface_groups.size(); ++s) {
      if (mesh.surface_groups[s] != group) continue;
      for (const Topology::Face& face : model_.topology.surface_groups[s]) f(face.element, false);
    }
    const Index nodes = corner_group(mesh, group);
    if (group_index(mesh.volume_groups, group) >= 0 || nodes < std::ssize(mesh.surface_groups)) return;
    for (const CornerTag& tag : model_.corner_tags) {
      if (tag.group == nodes) f(static_cast<Index>(tag.element), false);
    }
  }

 private:
  Solid& of(Index element) { return all_[number(element)]; }
  [[nodiscard]] bool lies_on_another(std::size_t i) const;

  const Model& model_;
  std::vector<Solid> all_;  ///< (bodies)
};

}  // namespace breccia
