#pragma once

#include "contact/contactors.hpp"
#include "model/model.hpp"
#include "parallel/communicator.hpp"
#include "state/records.hpp"

namespace breccia {

/// Elements that the root sends at a time, some 20 MB.
inline constexpr Index kElementsAtATime = 32768;

/// The elements of a model at rest on all ranks, each with an equal run of ids, before they are divided by place. The
/// root holds the records of its own run and of kElementsAtATime others at most. Collective.
/// @param bare        as build_bare_model() made it, on the root; null elsewhere
/// @param contactors  of it; none chosen: no contact
[[nodiscard]] Records spread(const Communicator& communicator, const Model* bare, const Contactors& contactors);

}  // namespace breccia
