#pragma once

#include <functional>
#include <memory>

#include "case/case.hpp"
#include "contact/displacement.hpp"
#include "domains/balance.hpp"
#include "domains/decomposition.hpp"
#include "domains/domain.hpp"
#include "domains/global_step.hpp"
#include "model/time_step.hpp"

namespace breccia {

/// The present state of a rank's partition, from which other partitions can continue, also with another search.
struct Snapshot {
  WholeModel whole;
  Records mine;                ///< the rank's originals
  std::vector<double> weight;  ///< their costs
  Continuation state;          ///< the rank's fields of the model
  DomainSpec domains;
  double motion = 0;      ///< m, largest of a node in a step
  std::size_t stage = 0;  ///< of the case
  bool in_stage = true;   ///< it has begun; false: a stage of another case has ended, or was left
};

/// A rank's part of the model: its originals and proxies, and everything that is built upon them. When a node has moved
/// so far that proxies may be missing, or when accumulated waiting exceeds the cost of a new division, elements are
/// assigned to domains again and the partition is rebuilt from their records.
class Partition {
 public:
  /// Collective. @param model  on the root, null elsewhere: on several ranks a bare one is enough (build_bare_model)
  /// @param between  called between parts of the work that may take a second; what it throws, on all ranks, ends it
  /// @pre input outlives this object
  Partition(const case_::Case& input, const Communicator& communicator, std::unique_ptr<Model> model,
            const std::function<void()>& between = {});
  /// Continues from another partition. Collective. @pre input differs from that partition's in what the elements of the
  /// snapshot do not depend on: [detection], [domains], and what the table of keys lets change (fixed_by_state)
  Partition(const case_::Case& input, const Communicator& communicator, Snapshot from);

  [[nodiscard]] Domain& domain() { return *domain_; }
  [[nodiscard]] const Domain& domain() const { return *domain_; }
  [[nodiscard]] const State& state() const { return domain_->state; }
  [[nodiscard]] const Model& model() const { return *model_; }
  [[nodiscard]] const WholeModel& whole() const { return model_->whole; }
  [[nodiscard]] const Communicator& communicator() const { return communicator_; }
  [[nodiscard]] std::int64_t decompositions() const { return decompositions_; }  ///< so far, the first included

  /// Throws InputError on all ranks where a stage of the case is to break what has no breakable joints. Collective.
  void refuse_what_cannot_break() const;
  /// Breaks the stage's surfaces and lets its loads act; the step's length stays. Collective.
  void begin_stage(const case_::Stage& stage);
  [[nodiscard]] std::vector<double> costs() const {
    return balance_.weights(*domain_);
  }  ///< of the originals, ascending by id
  [[nodiscard]] double imbalance() const {
    return balance_.imbalance();
  }                                                              ///< largest over mean working time of the ranks
  [[nodiscard]] double load() const { return balance_.load(); }  ///< this rank's over the mean working time

  /// After every step: a new decomposition if one is due. Collective.
  void keep_up();
  /// The partition as it is, which ends with it: no more steps. Collective. @pre a stage has begun
  [[nodiscard]] Snapshot snapshot();
  /// The same during a run, which continues. Pending requests between ranks are not included. Collective, so that the
  /// failure of a rank is received: then throws SimulationError on all. @pre a stage has begun
  [[nodiscard]] Snapshot copy() const;
  /// The same of this rank alone, where none has failed. Without MPI.
  [[nodiscard]] Snapshot copy_of_rank() const;
  /// Stable step of the whole model at present under the constraints of the stage. Collective.
  /// @param steps  of it until the next call
  [[nodiscard]] StableStep stable_step(double steps) const;
  /// Its length alone, s, in less time. Collective. @param range  as for global_step_length
  [[nodiscard]] double step_length(double steps, const StepRange& range = {}) const;
  /// The same under the constraints of another stage.
  [[nodiscard]] double step_length(const case_::Stage& stage, double steps) const;

 private:
  void start_alone(const std::function<void()>& poll);
  void start_divided(const std::function<void()>& poll);
  void relax_overlaps();
  void start_piece(const std::function<void()>& poll);
  void divide_again();
  [[nodiscard]] Snapshot opened() const;  ///< but for its state
  [[nodiscard]] StepState step_state() const;
  [[nodiscard]] double first_motion() const;
  [[nodiscard]] double stretch() const;
  [[nodiscard]] RankOperations rank_operations() const;
  void decompose_anew(WholeModel whole, Records mine, const std::vector<double>& weight, const Continuation& from);
  void rebuild(WholeModel whole, Records mine, const std::vector<double>& weight, const Continuation& from);
  void build(const Piece& piece, WholeModel whole, const Continuation& from);
  [[nodiscard]] bool left_reach();
  [[nodiscard]] bool balancing_pays();

  const case_::Case& input_;
  Communicator communicator_;
  std::unique_ptr<Model> model_;
  DomainSpec domains_;
  std::unique_ptr<Domain> domain_;
  std::unique_ptr<TimeStep> time_step_;
  const case_::Stage* stage_ = nullptr;
  std::int64_t decompositions_ = 1;
  Balance balance_;
  double decomposition_s_ = 0;  ///< s, that the last decomposition took on the slowest rank
  Reach reach_;
  double motion_ = 0;  ///< m, largest of a node in a step, at present
  DisplacementWatch moved_{kMotionLate};
  Field<double> anchor_;  ///< nodal field, positions at the decomposition, from which moved_ counts
};

}  // namespace breccia
