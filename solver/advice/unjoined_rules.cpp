#include "advice/rule_functions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/index.hpp"
#include "mesh/bodies.hpp"
#include "mesh/node_parting.hpp"
#include "mesh/tetrahedron.hpp"
#include "model/parameters.hpp"

namespace breccia {
namespace {

/// Faces of two volumes, or of two parts of one, that coincide and are not joined.
struct Touch {
  Index element = -1, other = -1;  ///< behind the first such pair of faces
  Index faces = 0;
};
using Groups = std::pair<Index, Index>;  ///< first <= second

/// What an element is part of: its volume, and its body.
std::pair<Index, Index> part_of(const Mesh& mesh, Index element) {
  return {mesh.volume_of(element), mesh.element_body[at(element)]};
}

/// Whether any group, or the mesh where all are glued, has two volumes, or a volume of two bodies.
bool has_several_parts(const case_::Case& input, const Mesh& mesh) {
  constexpr std::pair<Index, Index> kNone{-1, -1};
  std::vector<std::pair<Index, Index>> first(input.mesh.glue ? 1 : mesh.volume_groups.size(), kNone);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    auto& part = first[input.mesh.glue ? 0 : at(mesh.element_group[at(e)])];
    if (part == kNone) part = part_of(mesh, e);
    if (part != part_of(mesh, e)) return true;
  }
  return false;
}

std::map<Groups, Touch> touches_of(const case_::Case& input, const Mesh& mesh, const Topology& topology) {
  const std::vector<Index> place = coincident_nodes(mesh);
  const std::vector<std::uint8_t> broken = faces_of_surfaces(mesh, topology, input.broken_surfaces);
  std::map<std::array<Index, 3>, Index> free_faces;  // by places: the element behind
  std::map<Groups, Touch> touches;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (std::size_t f = 0; f < 4; ++f) {
      if (!topology.links[at(e)][f].free() || (broken[at(e)] >> f & 1) != 0) continue;
      std::array<Index, 3> key{};
      for (std::size_t i = 0; i < 3; ++i) key[i] = place[at(mesh.elements[at(e)][at(kFaceCorners[f][i])])];
      std::sort(key.begin(), key.end());
      const auto [known, fresh] = free_faces.emplace(key, e);
      if (fresh || part_of(mesh, known->second) == part_of(mesh, e)) continue;
      const Groups groups = std::minmax(mesh.element_group[at(known->second)], mesh.element_group[at(e)]);
      if (groups.first != groups.second && !input.mesh.glue) continue;
      Touch& touch = touches[groups];
      if (touch.faces++ == 0) touch.element = known->second, touch.other = e;
    }
  }
  return touches;
}

std::string remedy(const case_::Case& input, const std::string& group, bool of_one_volume) {
  if (of_one_volume) return "the mesh has duplicate nodes there: mesh.merge_nodes joins them, unless it is a crack.";
  if (input.mesh.glue)
    return "the mesh has their interface twice: use Coherence or BooleanFragments in the geometry, or "
           "mesh.merge_nodes.";
  const case_::Contact* contact = contact_entry(input, group, group);
  return contact != nullptr && contact->interaction == case_::Interaction::contact
             ? "mesh.glue = true makes them one solid. Without it, like stones without mortar, they interact by "
               "contact alone."
             : "mesh.glue = true makes them one solid. Without it they pass through each other, unless there is a "
               "[[contact]] of the group with itself.";
}

/// What an initial velocity does differently at different places of a body, or for different bodies.
bool varies(const case_::InitialVelocity& v) {
  return v.angular != Vec3::Zero() || v.strain_rate != Vec3::Zero() || v.random[1] > 0;
}

bool alike(const case_::InitialVelocity& a, const case_::InitialVelocity& b) {
  return a.angular == b.angular && a.strain_rate == b.strain_rate && a.random == b.random &&
         (a.random[1] == 0 || a.seed == b.seed);
}

/// (elements) 1: in the volume group or element set.
std::vector<std::uint8_t> elements_of(const Mesh& mesh, const std::string& group) {
  std::vector<std::uint8_t> in(mesh.elements.size(), 0);
  const Index volume = group_index(mesh.volume_groups, group), set = group_index(mesh.element_sets, group);
  for (std::size_t e = 0; e < in.size() && volume >= 0; ++e) in[e] = mesh.element_group[e] == volume ? 1 : 0;
  for (const Mesh::SetElement& one : mesh.set_elements) {
    if (one.group == set) in[at(one.element)] = 1;
  }
  return in;
}

}  // namespace

Sentences unjoined_volumes(const case_::Case& input, const Mesh& mesh, const Topology& topology) {
  Sentences advice;
  if (input.mesh.raster || !has_several_parts(input, mesh)) return advice;
  for (const auto& [groups, touch] : touches_of(input, mesh, topology)) {
    const std::string &first = mesh.volume_groups[at(groups.first)], &second = mesh.volume_groups[at(groups.second)];
    const Index body = mesh.element_body[at(touch.element)], other = mesh.element_body[at(touch.other)];
    advice.push_back(
        fmt::format("Volumes of {} touch along {} {} and are not joined there{}: {}",
                    groups.first == groups.second ? "\"" + first + "\"" : "\"" + first + "\" and \"" + second + "\"",
                    touch.faces, touch.faces == 1 ? "triangle" : "triangles",
                    body == other ? "" : fmt::format(" (bodies {} and {}, for one)", body, other),
                    remedy(input, first, mesh.volume_of(touch.element) == mesh.volume_of(touch.other))));
  }
  return advice;
}

Sentences part_in_motion(const case_::Case& input, const Model& model) {
  const Mesh& mesh = model.mesh;
  Sentences advice;
  for (const case_::InitialVelocity& entry : input.initial_velocities) {
    if (!varies(entry)) continue;
    const std::vector<std::uint8_t> own = elements_of(mesh, entry.group);
    std::vector<std::uint8_t> moves = own;
    for (const case_::InitialVelocity& other : input.initial_velocities) {
      if (&other == &entry || !alike(entry, other)) continue;
      const std::vector<std::uint8_t> added = elements_of(mesh, other.group);
      for (std::size_t e = 0; e < moves.size(); ++e) moves[e] |= added[e];
    }
    std::vector<std::uint8_t> is_moved(at(mesh.num_bodies), 0);
    for (std::size_t e = 0; e < own.size(); ++e) is_moved[at(mesh.element_body[e])] |= own[e];
    for (std::size_t e = 0; e < moves.size(); ++e) {
      if (moves[e] != 0 || is_moved[at(mesh.element_body[e])] == 0) continue;
      const std::string& rest = mesh.volume_groups[at(mesh.element_group[e])];
      advice.push_back(fmt::format(
          "{} (line {}) turns, stretches or draws for a part of a body: \"{}\" is joined to \"{}\" and has no such "
          "entry. The two tear at their interface in the first steps unless \"{}\" gets the same.",
          entry.origin.key, entry.origin.line, rest, entry.group, rest));
      break;
    }
  }
  return advice;
}

}  // namespace breccia
