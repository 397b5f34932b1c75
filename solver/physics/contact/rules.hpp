#pragma once

namespace breccia {

/// Switches of the rules of contact, for tests and for the experiments of tests/benchmark/contact, which show what each
/// of them is for. Runs have all of them; no case can change one.
struct ContactRules {
  bool correction = true;         ///< forces are changed so that their work is what the laws store and dissipate
  bool steep_correction = true;   ///< of steep unloading curves (b > 1) with wider limits, as a pull if need be
  bool closing_pull = true;       ///< after separation a pull removes what a couple has gained
  bool remembered_gain = true;    ///< what is left of a gain or loss is corrected in the next overlap of the point
  bool gradient_switch = true;    ///< the offset takes up what a switch of the gradient does not explain
  int friction_lag_stages = 2;    ///< 0: the limit of friction follows the normal force at once
  bool friction_age = true;       ///< the delay grows with the age of the overlap; false: it is the longest at once
  bool spring_turns = true;       ///< springs turn about the normal with the surfaces
  bool shares = true;             ///< the sharper of two surfaces presses on the flatter one
  bool corner_normals = true;     ///< a point at a corner of the body faces what any of the faces there does
  bool opening_push = true;       ///< after separation a push returns what a couple has taken too much or still stores
  bool facing_sides = true;       ///< of several sides of the surface those count that face the face of the point
  bool facing_face = true;        ///< no force begins where the side that counts does not face the face of the point
  bool bridge_gaps = true;        ///< a point that pressed on an element and is now in a joint beside it stays with it
  bool one_of_neighbours = true;  ///< of neighbouring elements that hold a point the first one counts
  bool first_offset = true;       ///< what lies deeper at first than its point has moved inwards makes no force
};

}  // namespace breccia
