#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/exact_sum.hpp"
#include "base/index.hpp"
#include "discretisation/nodal_forces.hpp"
#include "physics/contact/block.hpp"
#include "physics/contact/evaluate.hpp"
#include "physics/contact/geometry/field.hpp"
#include "physics/contact/params.hpp"
#include "physics/contact/state.hpp"
#include "physics/number_vector.hpp"

/// For the sources of physics/contact alone.
namespace breccia {

/// What one step of contact reads: points, contactors and their overlap fields, now and one step ago. What is computed
/// of an element is computed once a step, when it is first needed, and kept in the scratch of ContactState.
class ContactView {
 public:
  /// @param dt  s, from t_(n-1) to t_n. All arguments outlive this object; of `contact` only scratch is written
  ContactView(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt,
              const ContactKernels& kernels, NodalForces& forces, ContactState& contact);
  /// Adds a force on a point, N, to the nodes of its face, and its reaction to those of the contactor.
  void add_force(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda, const Vec3& force);
  /// Stores the forces of all elements. To be called once, at the end of the step.
  void store_forces();

  [[nodiscard]] const ContactParams& params() const { return params_; }
  [[nodiscard]] const ContactRules& rules() const { return params_.rules; }
  [[nodiscard]] const LocalMesh& local() const { return local_; }
  [[nodiscard]] const NodalState& nodes() const { return state_; }
  [[nodiscard]] double dt() const { return dt_; }

  [[nodiscard]] const ContactPoint& point(Index index) const { return contact_.points[at(index)]; }
  [[nodiscard]] Index slot_of(Index contactor) const { return contact_.contactors[at(contactor)]; }
  [[nodiscard]] Index body_of(Index contactor) const { return local_.slot_body[at(slot_of(contactor))]; }
  /// H, m, of a contactor's body.
  [[nodiscard]] double length_of(Index contactor) const { return contact_.body_length[at(body_of(contactor))]; }
  [[nodiscard]] const ContactLaw& law_of(Index point, Index contactor) const {
    return params_.law(group_of(this->point(point).slot), group_of(slot_of(contactor)));
  }
  /// Laws and sizes of a couple alone.
  /// @param share  of the weight of the point
  [[nodiscard]] ContactPair<double> pair_of(Index point, Index contactor, double share) const {
    return {
        .law = law_of(point, contactor), .weight = share * this->point(point).weight, .length = length_of(contactor)};
  }
  /// Share of its weight with which a point begins to press on a contactor (geometry/outward.hpp).
  [[nodiscard]] double share_of(Index point, Index contactor, const std::array<double, 4>& lambda) const;
  /// s, longest delay of friction (law/lag.hpp).
  [[nodiscard]] double longest_delay(const ContactLaw& law, Index point, Index contactor) const;
  /// Whether two contactors are of one body and share a vertex of its mesh.
  [[nodiscard]] bool are_neighbours(Index contactor, Index other) const;
  [[nodiscard]] bool shares_vertex(Index point, Index contactor) const;

  /// Adds to a sum over the points of this rank's originals: couples are computed wherever one side is at home, and
  /// accounted with their points.
  void account(const ContactPoint& point, double joules, ExactSum& sum) const {
    if (local_.is_original(point.slot)) sum.add(joules);
  }

  [[nodiscard]] Vec3 place_of(const ContactPoint& point) const {
    return at_point(rule_, point, state_.position.data());
  }
  [[nodiscard]] const std::array<double, 3>& shape_at(const ContactPoint& point) const { return rule_.shape[point.k]; }
  /// Motion of the point relative to the contactor's material at lambda during the last step, m.
  [[nodiscard]] Vec3 relative_motion(const ContactPoint& point, Index contactor,
                                     const std::array<double, 4>& lambda) const;
  [[nodiscard]] Outward outward_of(const ContactPoint& point) const;

  /// The element of a slot where it is now; and with its motion.
  [[nodiscard]] const StepElement& element(Index slot) { return block_with(slot).elements[at(slot % kLanes)]; }
  [[nodiscard]] const StepElement& moving_element(Index slot) {
    StepElements::Block& block = block_with(slot);
    if (block.moved_in != contact_.elements.step()) prepare_motion(block);
    return block.elements[at(slot % kLanes)];
  }
  /// Requests what the location of a couple will read.
  void prefetch(const AwakeCouple& couple) const {
    __builtin_prefetch(&contact_.points[at(couple.point)]);
    contact_.elements.prefetch(couple.slot);
  }
  [[nodiscard]] const PreparedTetra& tetra_of(Index contactor) { return element(slot_of(contactor)).tetra; }

  /// Whether the overlap field of a contactor changes in this step.
  [[nodiscard]] bool is_changed(Index contactor) const { return contact_.change_of_contactor[at(contactor)] >= 0; }
  [[nodiscard]] bool has_sides(Index contactor) const {
    return rules().facing_sides && breccia::has_sides(params_, contact_, contactor);
  }
  [[nodiscard]] bool has_several_sides(Index contactor) const {
    return rules().facing_sides && breccia::has_several_sides(params_, contact_, contactor);
  }
  /// The overlap functions of a contactor; valid until the next call.
  [[nodiscard]] const OverlapShape& shape_of(Index contactor, Instant instant = Instant::now) const;
  /// The overlap function of a contactor that counts at lambda, of all.
  [[nodiscard]] OverlapFunction least_function_of(Index contactor, const std::array<double, 4>& lambda) const;

  /// A contactor and the place of a point in it one step ago.
  struct Before {
    PreparedTetra tetra;
    std::array<double, 4> lambda;
  };
  [[nodiscard]] Before one_step_ago(const ContactPoint& point, Index contactor) const;

 private:
  [[nodiscard]] Index group_of(Index slot) const { return local_.block_group[at(slot / kLanes)]; }
  [[nodiscard]] StepElements::Block& block_with(Index slot) {
    StepElements::Block* block = contact_.elements.prepared(slot);
    return block != nullptr ? *block : prepare_block(slot);
  }
  StepElements::Block& prepare_block(Index slot);
  void prepare_motion(StepElements::Block& block) const;
  void prepare_forces(StepElements::Block& block) const;
  [[nodiscard]] StepElement& element_to_act_on(Index slot) {
    StepElements::Block& block = block_with(slot);
    if (block.acted_in != contact_.elements.step()) prepare_forces(block);
    return block.elements[at(slot % kLanes)];
  }

  const ContactParams& params_;
  const LocalMesh& local_;
  const NodalState& state_;
  double dt_;
  const ContactKernels& kernels_;
  NodalForces& forces_;
  ContactState& contact_;
  const FaceRule& rule_;

  // The last result of shape_of: several calls for one couple follow each other.
  mutable OverlapShape shape_;
  mutable Index shape_of_ = -1;
  mutable Instant shape_at_ = Instant::now;
};

}  // namespace breccia
