#pragma once

#include <cstdint>
#include <vector>

#include "model/model.hpp"
#include "physics/contact/state.hpp"

namespace breccia {

/// Two volumes of the mesh that overlap, and their bodies.
struct BodyOverlap {
  Index body = 0, other = 0;  ///< the same where the volumes are joined elsewhere
  Index group = 0, other_group = 0;
  double depth = 0;          ///< m, largest distance of a place inside a volume to that volume's free surface
  double length = 0;         ///< m, H of the body that is entered there
  Vec3 place{0, 0, 0};       ///< m, of that depth
  std::int64_t points = 0;   ///< contact points inside the other volume
  std::int64_t corners = 0;  ///< and corners of faces with contact points
};

/// Volumes with a contact law that overlap by more than kOverlapTolerance H in the mesh, deepest first, then by
/// volumes; those that are joined elsewhere as well. Contact points, the corners of their faces and the middles of the
/// elements behind them are looked up in all elements, those deep inside as well. A volume does not overlap itself:
/// faces of a crack that is open from the start coincide.
/// @param model  of the whole mesh; a bare one will do. O(n log n)
[[nodiscard]] std::vector<BodyOverlap> initial_overlaps(const Model& model);

/// Takes overlaps of pairs of groups with InitialOverlap::relax out: every point that is inside a contactor gets a
/// couple whose offset is the overlap, so that it makes no force until it becomes deeper. As bodies part the offset
/// shrinks with the overlap (contact_forces.hpp): no energy comes of it.
/// @param contact   points and contactors of the model or of a rank's piece, nothing touches yet
/// @param position  nodal field, m. O(n log n)
void relax_initial_overlaps(const ContactParams& params, const LocalMesh& local, const Field<double>& position,
                            ContactState& contact);

}  // namespace breccia
