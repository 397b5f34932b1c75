#ifndef brecciaConnectivity_h
#define brecciaConnectivity_h

#include <vector>

#include "brecciaData.h"

namespace breccia {

/// What elements are connected with.
struct Connectivity {
  enum Face : unsigned char {
    free_face = 0,  ///< of the body's surface
    held = 1,       ///< by an element across
    cracked = 2     ///< no more: its joint has failed
  };
  std::vector<vtkTypeInt64> fragment;  ///< (elements) smallest element id of the part that hangs together
  std::vector<unsigned char> face;     ///< (elements, 4) Face
};

/// Connected parts through faces whose joint has not failed, across ranks.
/// @param broken  ids of the failed joints that this rank knows of, 4 element + face; those of elements that are not
/// here as well Collective. Near O(elements) and, for the communication, O(faces between ranks + failed joints). The
/// result does not depend on the distribution of elements and joints.
Connectivity Connect(const Elements& elements, const std::vector<vtkTypeInt64>& broken, const Ranks& ranks);

}  // namespace breccia

#endif
