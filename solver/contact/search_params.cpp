#include "contact/search_params.hpp"

namespace breccia {
namespace {

detection::Algorithm algorithm_of(case_::DetectionAlgorithm algorithm) {
  switch (algorithm) {
    case case_::DetectionAlgorithm::ms:
      return detection::Algorithm::ms;
    case case_::DetectionAlgorithm::ms_slices:
      return detection::Algorithm::ms_slices;
    case case_::DetectionAlgorithm::brute_force:
      return detection::Algorithm::brute_force;
    case case_::DetectionAlgorithm::sorted_grid:
      return detection::Algorithm::sorted_grid;
    case case_::DetectionAlgorithm::packed_tree:
      break;
  }
  return detection::Algorithm::packed_tree;
}

}  // namespace

ContactSearchParams search_params(const case_::Case& input, const Model& model) {
  ContactSearchParams params;
  params.algorithm = algorithm_of(input.detection.algorithm);
  params.cell = input.detection.cell;
  params.buffer = input.detection.buffer;
  params.verify = input.detection.verify;
  params.breakable = model.breakable;
  params.everywhere = model.contact_everywhere;
  if (model.plane) params.across = model.plane->axis;
  params.faces = model.contact_faces;
  return params;
}

}  // namespace breccia
