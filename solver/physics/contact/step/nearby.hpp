#pragma once

#include <cstdint>
#include <memory>
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
  /// @param time     s, until the next evaluation.  O(patches)
  PatchesNearby(const ContactParams& params, std::span<const ContactPatch> patches, double time);

  /// Of patch p in contact with any that it may meet: the bounds that no other dominates. O(log patches); the first
  /// call makes the tree, O(patches log patches)
  [[nodiscard]] std::vector<ContactBound> bounds(std::size_t p);
  /// Of a patch in contact with any of the model, whether it may meet it or not, and so no less. O(groups)
  [[nodiscard]] std::vector<ContactBound> bounds_anywhere(const ContactPatch& patch) const;

 private:
  const ContactParams& params_;
  std::span<const ContactPatch> patches_;
  double time_;
  struct Tree {
    Tree(std::span<const ContactPatch> patches, double time);
    std::vector<PatchTree::Box> boxes;
    PatchTree tree;
    std::vector<ContactPatch> largest;  ///< (nodes of the tree)
  };
  std::unique_ptr<Tree> tree_;
  std::vector<ContactPatch> of_groups_;  ///< the largest numbers of each group that has patches
};

}  // namespace breccia
