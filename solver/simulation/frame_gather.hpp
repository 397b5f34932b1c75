#pragma once

#include "output/frame.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// The frame of the whole model on the root, from the frames of the ranks' originals; entries in order of global id. Empty on
/// the other ranks. Collective.
[[nodiscard]] Frame gather_frame(const Communicator& communicator, Frame mine);

}  // namespace breccia
