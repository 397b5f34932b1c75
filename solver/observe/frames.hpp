#pragma once

#include <vector>

#include "discretisation/fragments.hpp"
#include "domains/domain.hpp"
#include "observe/free_faces.hpp"
#include "output/frames/frame.hpp"

namespace breccia {

/// What a picture shows besides the domain's state.
struct FrameLabels {
  const Fragments& fragments;             ///< of the elements, for elements and surface
  const std::vector<SurfaceFace>& faces;  ///< all free ones, for the surface
  std::vector<double> cost;               ///< (originals) relative, ascending by id, for elements and surface
  double load = 1;                        ///< working time of this rank over that of the mean rank, for the domain
};

/// Frame of this rank's originals at the domain's time; read only. Collective with values at points.
/// @param parts  the others stay empty
[[nodiscard]] Frame make_frame(const Domain& domain, std::int64_t number, const FrameParts& parts,
                               const FrameLabels& labels);

}  // namespace breccia
