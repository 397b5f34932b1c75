#pragma once

#include <vector>

#include "domains/domain.hpp"
#include "output/frames/frame.hpp"

namespace breccia {

/// Values at the corners of this rank's originals, ascending by id, four an element.
///
/// A mean includes the elements that meet at a vertex of the mesh and are connected there, from face to face through
/// joints that have not failed, or by a node that they share: v_0 + sum m_i (v_i - v_0) / sum m_i, by ascending id. It
/// is bitwise the same on any number of ranks, and uniform values are unchanged. At a failed joint each side has its
/// own mean.
/// O(originals) and, for parts of several ranks, one exchange forth and back. Collective.
[[nodiscard]] Frame::AtPoints corner_values(const Domain& domain);

/// The values at some of the places.
[[nodiscard]] Frame::AtPoints picked(const Frame::AtPoints& values, const std::vector<std::size_t>& places);

}  // namespace breccia
