#include "advice/rule_functions.hpp"

#include <fmt/core.h>
#include <string>

#include "base/index.hpp"

namespace breccia {
namespace {

/// Faces of a surface by what is across them.
struct Faces {
  std::int64_t free = 0, joined = 0;
  std::int64_t shared = 0;  ///< elements on both sides with the same nodes
  [[nodiscard]] std::int64_t all() const { return free + joined + shared; }
};

Faces faces_of(const Model& model, const std::string& surface) {
  const Mesh& mesh = model.mesh;
  Faces faces;
  for (std::size_t s = 0; s < mesh.surface_groups.size(); ++s) {
    if (mesh.surface_groups[s] != surface) continue;
    for (const Topology::Face& face : model.topology.surface_groups[s]) {
      const FaceLink& link = model.topology.links[at(face.element)][at(face.face)];
      if (!link.inner())
        ++faces.free;
      else if (model.whole.pair_of(mesh.element_group[at(face.element)], mesh.element_group[at(link.neighbour)]) >= 0)
        ++faces.joined;
      else
        ++faces.shared;
    }
  }
  faces.joined /= 2;  // an inner surface lists both sides
  faces.shared /= 2;
  return faces;
}

std::string words_of(const case_::Origin& origin, const char* key) {
  return fmt::format("{}{} (line {})", origin.key, key, origin.line);
}

}  // namespace

Sentences load_within_the_model(const case_::Case& input, const Model& model) {
  Sentences advice;
  for (const case_::Stage& stage : input.stages) {
    for (const case_::Pressure& pressure : stage.pressures) {
      const Faces faces = faces_of(model, pressure.surface);
      if (faces.shared == 0) continue;
      advice.push_back(fmt::format(
          "{} does nothing on {} of the {} faces of \"{}\": there are elements on both sides that share their nodes, "
          "on "
          "which the pressures of the two sides cancel. Joints there (a [[joint]] between the groups of the two sides) "
          "can open under it.",
          words_of(pressure.origin, ""), faces.shared, faces.all(), pressure.surface));
    }
    for (const std::string& surface : stage.absorbing) {
      const Faces faces = faces_of(model, surface);
      if (faces.free == faces.all()) continue;
      advice.push_back(fmt::format(
          "{} damps the inside of the model: {} of the {} faces of \"{}\" have elements on both sides. An absorbing "
          "boundary has to be a free surface.",
          words_of(stage.origin, ".absorbing"), faces.all() - faces.free, faces.all(), surface));
    }
  }
  return advice;
}

}  // namespace breccia
