#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "physics/contact/step/bound.hpp"
#include "physics/contact/step/contact_step.hpp"
#include "physics/contact/step/patch_tree.hpp"

namespace breccia {

/// Which patches may meet (contact_step.hpp). They are stored in a tree, whose nodes have the largest values of the
/// patches below: where even these do not change the bound none of them is evaluated. For contact_step.cpp only.
class PatchesNearby {
 public:
  /// @param patches  of the whole model, merged, not empty; they and params outlive this object
  /// @param time     s, until the next evaluation.  O(patches log patches)
  PatchesNearby(const ContactParams& params, std::span<const ContactPatch> patches, double time);

  /// Of patch p in contact with any that it may meet: the bounds that no other dominates.
  [[nodiscard]] std::vector<ContactBound> bounds(std::size_t p) const;
  /// Of a patch in contact with any of the model, whether it may meet it or not, and so no less. O(groups)
  [[nodiscard]] std::vector<ContactBound> bounds_anywhere(const ContactPatch& patch) const;

 private:
  const ContactParams& params_;
  std::span<const ContactPatch> patches_;
  double time_;
  std::vector<PatchTree::Box> boxes_;
  PatchTree tree_;
  std::vector<ContactPatch> largest_;    ///< (nodes of the tree)
  std::vector<ContactPatch> of_groups_;  ///< the largest numbers of each group that has patches
};

}  // namespace breccia
