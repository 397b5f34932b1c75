#pragma once

#include "model/model.hpp"
#include "unit/case/case_files.hpp"
#include "unit/mesh/sample_meshes.hpp"

namespace breccia::test {

/// Two boxes glued at x = 1 m (kTwoBoxes), all joints breakable; the interface is the weakest, "right" the strongest.
inline const std::string kTwoBoxesCase = R"([mesh]
file = "geometry.geo"
glue = true
[[material]]
group = "left"
young = "40 GPa"
poisson = 0.2
density = 2400
[[material]]
group = "right"
young = "40 GPa"
poisson = 0.2
density = 2400
[[joint]]
group = "left"
penalty_factor = 100
tensile_strength = "5 MPa"
shear_strength = "15 MPa"
energy_mode_1 = "100 J/m2"
[[joint]]
group = "right"
penalty_factor = 100
tensile_strength = "8 MPa"
shear_strength = "24 MPa"
energy_mode_1 = "100 J/m2"
[[joint]]
between = ["left", "right"]
penalty_factor = 100
tensile_strength = "1 MPa"
shear_strength = "3 MPa"
energy_mode_1 = "100 J/m2"
[[contact]]
between = ["left", "*"]
penalty = "400 GPa"
plateau = "4 GPa"
[[contact]]
between = ["right", "right"]
penalty = "300 GPa"
[[stage]]
end = "1 ms"
local_damping = 0.25
mass_damping = 3
[[stage.constraint]]
group = "bottom"
fixed = "xyz"
)";

/// The case with its geometry beside it. @param overrides  key=value
inline case_::Case two_boxes_case(const std::vector<std::string>& overrides = {},
                                  const std::string& text = kTwoBoxesCase) {
  static const case_::CaseFolder folder;  // the mesh is read when the model is built
  folder.write("geometry.geo", kTwoBoxes);
  return case_::read_case(folder.write("case.toml", text), overrides);
}

}  // namespace breccia::test
