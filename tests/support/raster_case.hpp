#pragma once

#include <array>
#include <charconv>
#include <string>

namespace breccia::test {

/// A case of equal boxes of cubes that lie beside each other, each a body of 24 tetrahedra a cube, at rest for one
/// stage. A test names what it is about, in SI units, and adds the rest of the case as text: see raster_case().
struct RasterCase {
  std::string title{};                ///< empty: none
  std::string group = "raster";       ///< volume group of all boxes; their sides are `<group>.x0` to `<group>.z1`
  std::array<int, 3> cells{1, 1, 1};  ///< cubes of one box along x, y, z
  double cell_size = 0.01;            ///< m, edge of a cube
  std::array<int, 3> boxes{1, 1, 1};  ///< boxes along x, y, z
  double gap = 0;                     ///< m, between neighbouring boxes along every axis
  std::string mesh{};                 ///< more lines of [mesh.raster]

  double young = 1e9;     ///< Pa
  double poisson = 0.2;   ///< 1
  double density = 1000;  ///< kg/m3
  std::string joints{};   ///< of the material; empty: "breakable" with a tensile strength, "unbreakable" with a penalty
                          ///< factor alone, else "none"
  std::string material{};  ///< more lines of [[material]]

  // [[joint]] of the group: there is none where all are 0; what is 0 is left to its default.
  double penalty_factor = 0;    ///< 1
  double tensile_strength = 0;  ///< Pa
  double shear_strength = 0;    ///< Pa
  double energy_mode_1 = 0;     ///< J/m2
  double joint_friction = 0;    ///< 1, coefficient once it is broken

  double contact_penalty = 0;   ///< Pa, of contact between all bodies; 0: no contact
  double contact_friction = 0;  ///< 1, coefficient of that contact

  std::string sections{};  ///< whole sections before the stage
  double end = 1e-3;       ///< s, of the stage; 0: no stage
};

/// The case as text of TOML. The stage comes last: lines that are added are keys of the stage until a section begins.
inline std::string raster_case(const RasterCase& c) {
  const auto number = [](double value) {  // the shortest text that reads as the same number
    std::array<char, 32> text{};
    return std::string(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
  };
  const auto unless_one = [](const std::string& key, const std::array<int, 3>& n) {
    if (n == std::array{1, 1, 1}) return std::string();
    return key + " = [" + std::to_string(n[0]) + ", " + std::to_string(n[1]) + ", " + std::to_string(n[2]) + "]\n";
  };
  const auto unless_zero = [&](const std::string& key, double value) {
    return value == 0 ? std::string() : key + " = " + number(value) + "\n";
  };
  const std::string joint = unless_zero("penalty_factor", c.penalty_factor) +
                            unless_zero("tensile_strength", c.tensile_strength) +
                            unless_zero("shear_strength", c.shear_strength) +
                            unless_zero("energy_mode_1", c.energy_mode_1) + unless_zero("friction", c.joint_friction);
  const std::string joints = c.tensile_strength != 0 ? "breakable" : joint.empty() ? "none" : "unbreakable";
  const std::string group = "group = \"" + c.group + "\"\n";

  std::string text = c.title.empty() ? "" : "title = \"" + c.title + "\"\n";
  text += "[mesh.raster]\n" + unless_one("cells", c.cells) + "cell_size = " + number(c.cell_size) + "\n";
  text += unless_one("boxes", c.boxes) + unless_zero("gap", c.gap) + (c.group == "raster" ? "" : group) + c.mesh;
  text += "[[material]]\n" + group + "young = " + number(c.young) + "\npoisson = " + number(c.poisson) + "\n";
  text += "density = " + number(c.density) + "\njoints = \"" + (c.joints.empty() ? joints : c.joints) + "\"\n";
  text += c.material;
  if (!joint.empty()) text += "[[joint]]\n" + group + joint;
  if (c.contact_penalty != 0) {
    text += "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = " + number(c.contact_penalty) + "\n";
    text += unless_zero("friction", c.contact_friction);
  }
  text += c.sections;
  if (c.end != 0) text += "[[stage]]\nend = " + number(c.end) + "\n";
  return text;
}

}  // namespace breccia::test
