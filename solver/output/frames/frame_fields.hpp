#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>

#include "output/frames/frame.hpp"

namespace breccia {

// The arrays of a frame: what files and in-situ channels show of it, listed once. A new field is a member of Frame, a
// line here, and what fills it in observe/frames.cpp; what elements of a bulk law remember is
// shown by the law's own list.

/// Arrays for computation, not only for display: files store them in 64 bits.
inline bool kept_in_64_bits(std::string_view name) { return name == "mass"; }

/// Stress and motion, of cells and of points.
template <class Values, class Visit>
void for_each_stress_and_motion(const Values& v, Visit&& visit) {
  visit("stress", v.stress, 6);
  visit("von_mises", v.von_mises, 1);
  visit("principal", v.principal, 3);
  visit("velocity", v.velocity, 3);
  visit("displacement", v.displacement, 3);
}

/// What elements and free faces have in common.
template <class Visit>
void for_each_cell_array(const Frame::Elements& e, Visit&& visit) {
  visit("id", e.id, 1);
  visit("body", e.body, 1);
  visit("material", e.material, 1);
  visit("rank", e.rank, 1);
  visit("fragment", e.fragment, 1);
  for_each_stress_and_motion(e, visit);
  visit("cost", e.cost, 1);
  for (const Frame::StateField& field : e.state) visit(field.name, field.values, field.components);
}

/// Values at points.
template <class Visit>
void for_each_array(const Frame::AtPoints& p, Visit&& visit) {
  for_each_stress_and_motion(p, visit);
  for (const Frame::StateField& field : p.state) visit(field.name, field.values, field.components);
}

/// Calls visit(name, values, components) for every array of the elements, in the order of files and channels.
template <class Visit>
void for_each_array(const Frame::Elements& e, Visit&& visit) {
  for_each_cell_array(e, visit);
  visit("mass", e.mass, 1);
  visit("neighbour", e.neighbour, 4);
}

/// Of joints that may change, too. @tparam J  Frame::Joints or const Frame::Joints
template <class J, class Visit>
requires std::same_as<std::remove_const_t<J>, Frame::Joints>
void for_each_array(J& j, Visit&& visit) {
  visit("id", j.id, 1);
  visit("damage", j.damage, 1);
  visit("mode", j.mode, 1);
  visit("opening", j.opening, 1);
  visit("slip", j.slip, 1);
  visit("broken", j.broken, 1);
  visit("time_of_failure", j.time_of_failure, 1);
  visit("state", j.state, 1);
  visit("energy", j.energy, 1);
}

template <class Visit>
void for_each_array(const Frame::Contacts& c, Visit&& visit) {
  visit("id", c.id, 1);
  visit("point", c.point, 1);
  visit("normal_force", c.normal_force, 3);
  visit("tangential_force", c.tangential_force, 3);
  visit("force", c.force, 3);
  visit("slip_velocity", c.slip_velocity, 3);
  visit("body", c.body, 1);
  visit("other_body", c.other_body, 1);
  visit("other_element", c.other_element, 1);
}

template <class Visit>
void for_each_array(const Frame::Surface& s, Visit&& visit) {
  for_each_cell_array(s.cells, visit);
  visit("face", s.face, 1);
  visit("crack", s.crack, 1);
}

template <class Visit>
void for_each_array(const Frame::Domain& d, Visit&& visit) {
  visit("rank", d.rank, 1);
  visit("elements", d.elements, 1);
  visit("joints", d.joints, 1);
  visit("couples", d.couples, 1);
  visit("load", d.load, 1);
}

}  // namespace breccia
