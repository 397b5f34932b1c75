#pragma once

#include <array>
#include <vector>

#include "base/time_function.hpp"
#include "physics/absorbing.hpp"
#include "physics/constraints.hpp"
#include "physics/loads.hpp"
#include "physics/nodal_load.hpp"

namespace breccia {

/// What acts on the model during one stage.
struct StageLoads {
  std::vector<SurfaceLoad> surfaces;
  std::vector<NodalLoad> forces;
  std::vector<NodalConstraint> constraints;
  AbsorbingSurfaces absorbing;
  std::array<TimeFunction, 3> gravity;  ///< m/s2
  double mass_damping = 0;              ///< 1/s
  double local_damping = 0;             ///< share of the unbalanced force
};

}  // namespace breccia
