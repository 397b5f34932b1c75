#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "discretisation/joint_links.hpp"
#include "discretisation/local_mesh.hpp"

namespace breccia {

/// What still hangs together.
struct Fragments {
  std::vector<GlobalId> of_slot;    ///< (num_slots) smallest global element id of the fragment, -1 for padding
  std::vector<std::uint8_t> alone;  ///< (num_slots) 1: a fragment of one element, or padding
  Index count = 0;
};

/// Connected components of the elements: through nodes they share, and through the joints named. The result does not
/// depend on the order of the calls. Near O(elements + joints).
class FragmentFinder {
 public:
  /// Joins elements that share nodes.
  explicit FragmentFinder(const LocalMesh& mesh);

  /// The joint between two slots has not failed.
  void join(Index slot, Index other);
  /// Joins across every intact joint of the sweep (link codes below 12).
  void join_linked(const JointLinks& links);

  [[nodiscard]] Fragments find();

 private:
  [[nodiscard]] Index root(Index slot);

  const LocalMesh& mesh_;
  std::vector<Index> parent_;  ///< (num_slots) towards the slot with the smallest global id
};

}  // namespace breccia
