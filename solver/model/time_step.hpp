#pragma once

#include <string>
#include <vector>

#include "mesh/corner_clusters.hpp"
#include "model/model.hpp"
#include "model/stage_loads.hpp"
#include "physics/contact/step/elements.hpp"
#include "physics/element_shares.hpp"
#include "physics/largest_eigenvalue.hpp"
#include "physics/stable_step.hpp"

namespace breccia {

/// What evaluations of the stable step keep for the next one; none of it changes their results.
struct StepMemory {
  explicit StepMemory(const StepModel& model) : elements(model) {}
  ElementShares elements;
  ContactElements contacts;
  Index limiter = -1;  ///< slot of the original with the shortest step of this rank, when that was last found
};

/// The stable step of a model, as far as the discretisation decides it.
///
/// The bound by element is cheap and follows the deformation; at rest the true limit of the linear system without
/// contact is larger by a ratio that is found once by iteration and kept: fracture makes nothing stiffer. Contact is
/// added to each element by physics/contact/step/contact_step.hpp.
class TimeStep {
 public:
  /// @param ranks  the other ranks, where the ratio is not known yet (WholeModel::step_ratio) and the model is a piece:
  /// then collective, and O(elements) times some dozens. @pre model outlives this object
  explicit TimeStep(const Model& model, const RankOperations& ranks = {});

  /// Bound of the originals at these positions without contact, with what limits it.
  [[nodiscard]] StableStep bound(const Field<double>& position, const MaterialMemory& memory = {}) const;
  /// As `bound`, but the true limit, s.
  [[nodiscard]] double limit(const Field<double>& position, const MaterialMemory& memory = {}) const {
    return ratio_ * bound(position, memory).step;
  }
  [[nodiscard]] double ratio() const { return ratio_; }

  [[nodiscard]] StepModel step_model(const MaterialMemory& memory = {}) const;
  /// Faces that have nothing across them now. @param clusters  of contact: faces that have broken; may be null
  [[nodiscard]] ContactFaces open_faces(const CornerClusters* clusters) const;
  /// (num_nodes) 1: a stage's constraints prescribe its motion in all directions.
  [[nodiscard]] std::vector<std::uint8_t> held_nodes(const std::vector<NodalConstraint>& constraints) const;
  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] StepMemory& memory() const { return memory_; }

 private:
  void mark_faces();

  const Model& model_;
  std::vector<bool> touched_;  ///< (volume groups) whether anything can touch it
  JointLinks links_;
  std::vector<JointStiffness> joints_;
  ContactFaces at_rest_;  ///< open: from the start; pointed: if it comes to be open
  double ratio_ = 1.0;
  mutable StepMemory memory_;
};

/// "the joint between elements 17 and 43".
[[nodiscard]] std::string limit_text(const StableStep& step);

/// What is wrong with a step that the case gives, in a sentence; empty: it is stable. @param dt  s; 0: none given
/// @param step  of the model at present
[[nodiscard]] std::string given_step_text(double dt, const StableStep& step);

}  // namespace breccia
