#pragma once

#include "case/case.hpp"
#include "contact/search_params.hpp"
#include "domains/domain.hpp"
#include "model/model.hpp"
#include "model/parameters.hpp"
#include "support/raster_case.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::test {

constexpr double kCubeEdge = 0.01;     // m
constexpr double kCubeDensity = 2000;  // kg/m3
constexpr double kCubeStep = 1e-8;     // s

/// A box of two cubes along x, each of 24 elements, with a slit of four faces between them that holds until it is
/// broken. @param more  lines of the case, before the stage
inline case_::Case two_cubes(const std::string& more = "") {
  return case_::read_text(raster_case({.group = "box",
                                       .cells = {2, 1, 1},
                                       .mesh = "slit = { lower = [0.01, 0, 0], upper = [0.01, 0.01, 0.01] }\n",
                                       .density = kCubeDensity,
                                       .penalty_factor = 10,
                                       .tensile_strength = 1e6,
                                       .energy_mode_1 = 10,
                                       .sections = more}) +
                          "name = \"rest\"\n");
}

/// The cubes in their stage, with a step far below the stable one.
struct CubesDomain {
  explicit CubesDomain(const std::string& more = "")
      : input(two_cubes(more)), model(build_model(input)), domain(model, search_params(input, model)) {
    if (domain.contact) model.whole.contactor_size = domain.contact->searches().contactor_size();
    begin_stage(domain, stage_loads(input.stages[0], model), kCubeStep);
  }

  const case_::Case input;
  Model model;
  Domain domain;
};

}  // namespace breccia::test
