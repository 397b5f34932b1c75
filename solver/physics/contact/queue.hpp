#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/block.hpp"
#include "physics/contact/ending.hpp"
#include "physics/contact/resolve.hpp"

/// For the sources of physics/contact alone.
namespace breccia {

/// Couples in contact wait here for a block of eight to be full, are evaluated side by side, and their forces are added
/// in the order in which they came.
class PairQueue {
 public:
  PairQueue(ContactView& view, const Resolver& resolver, EndedCouples& ended, ContactState& contact, ContactWork& work,
            const ContactKernels& kernels)
      : view_(view),
        resolver_(resolver),
        ended_(ended),
        contact_(contact),
        work_(work),
        kernels_(kernels),
        rules_{.correction = view.rules().correction,
               .steep_correction = view.rules().steep_correction,
               .friction_age = view.rules().friction_age,
               .second_stage = view.rules().friction_lag_stages > 1} {}

  /// Couples of a point. To be called for points in ascending order
  void push(Index point, std::span<const Candidate> candidates);
  /// The forces of couples that have ended since the last call.
  void push_forces_of_ended();
  /// Evaluates what waits. To be called after the last couple.
  void finish();

 private:
  /// A couple in the block.
  struct Lane {
    Index point;
    std::size_t place;
    Candidate candidate;
    double offset;  ///< m, before evaluation
  };
  /// A force that is known, to be added before that of a lane.
  struct Waiting {
    std::size_t before;
    KnownForce known;
  };

  void push(Index point, const Candidate& candidate, std::size_t place);
  void evaluate();
  void fill_place(const ContactPoint& point, const Candidate& candidate, std::size_t lane);
  void fill_laws(Index point, const Candidate& candidate, std::size_t lane);
  void adjust(std::size_t lane);
  [[nodiscard]] double damping_before(std::size_t lane) const;
  [[nodiscard]] PairHistory<double> history_before(const Candidate& candidate) const;
  void take_results(std::size_t lane);
  void end_inside(std::size_t lane);
  void sort_disordered();
  void add_force(const KnownForce& known);

  ContactView& view_;
  const Resolver& resolver_;
  EndedCouples& ended_;
  ContactState& contact_;
  ContactWork& work_;
  const ContactKernels& kernels_;
  EvaluationRules rules_;
  PairBlock block_;
  std::array<Lane, kLanes> lanes_;
  std::size_t filled_ = 0;
  std::vector<Waiting> waiting_;         ///< ascending
  std::vector<std::size_t> disordered_;  ///< places in ContactState::touching whose couple ended within its contactor
};

}  // namespace breccia
