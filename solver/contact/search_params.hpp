#pragma once

#include <vector>

#include "case/case.hpp"
#include "detection/point_body/search.hpp"
#include "mesh/topology.hpp"
#include "model/model.hpp"

namespace breccia {

/// How contact is searched, and by whom.
struct ContactSearchParams {
  detection::Algorithm algorithm = detection::Algorithm::packed_tree;
  double cell = 0;                    ///< m; 0: chosen by the algorithm
  double buffer = 0;                  ///< m; 0: chosen at every search (CoupleSearch)
  bool verify = false;                ///< compare the couples that touch with brute force at every step
  std::vector<bool> breakable;        ///< (volume groups) inner faces may be freed
  bool everywhere = true;             ///< every free face carries points; false: only `faces`
  int across = -1;                    ///< axis of a plane model, whose sides carry no points and are no surface
  std::vector<Topology::Face> faces;  ///< faces that may carry points; one side of an inner face is enough
};

/// The case's section [detection], and what the search has to know of the model.
[[nodiscard]] ContactSearchParams search_params(const case_::Case& input, const Model& model);

}  // namespace breccia
