#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/ending.hpp"
#include "physics/contact/view.hpp"

/// For the sources of physics/contact alone.
namespace breccia {

/// A couple of the point at hand whose point lies in the contactor or just beside it.
struct Nearby {
  AwakeCouple* couple;
  std::array<double, 4> lambda;
  double safe;  ///< m, as in LocateBlock
};

/// A contactor that holds the point at hand.
struct Candidate {
  Index contactor;
  std::array<double, 4> lambda;
  OverlapRows rows;             ///< functions of the contactor that count for the point
  std::array<double, 4> depth;  ///< m, coefficients of the one that is the overlap
  double g, g_before;           ///< m, the overlap by the field of now and of one step ago
  double gained = 0;            ///< J, left to correct by couples of the point that have ended
  DelayedForce delayed{};       ///< of the same
  std::ptrdiff_t old = -1;      ///< index of its history among those of the last step, -1: none
};

/// What the rules make of a couple once its motion in the last step is known.
struct Adjusted {
  double offset;          ///< m
  double overlap_before;  ///< m
  double turn = 0;        ///< m, as in ContactPair
};

/// From points to couples: which elements contain a point, which side of their surface counts, which history continues,
/// and which overlap makes no force. These are the only rules of contact; what follows from them is evaluate.hpp.
class Resolver {
 public:
  Resolver(ContactView& view, ContactState& contact, EndedCouples& ended)
      : view_(view), contact_(contact), ended_(ended) {}

  /// Candidates of a point with their histories, ascending; valid until the next call. Couples of the last step that
  /// none of them continues end, as do those of all points before.
  /// @param inside, beside  couples whose contactor holds it; just beside which it lies. Ascending. To be called for
  /// points in ascending order
  [[nodiscard]] std::span<Candidate> candidates(Index point, std::span<const Nearby> inside, std::span<Nearby> beside);
  /// After the last point: all other couples of the last step end.
  void finish();

  /// @param h         of the last step, or zero for a new couple
  /// @param motion    m;  @param gradient  of the overlap now
  [[nodiscard]] Adjusted adjust(Index point, const Candidate& candidate, const PairHistory<double>& h,
                                const Vec3& motion, const Vec3& gradient) const;

 private:
  [[nodiscard]] Candidate candidate_of(const ContactPoint& point, Index contactor,
                                       const std::array<double, 4>& lambda) const;
  [[nodiscard]] OverlapRows sides_for(const ContactPoint& point, Index contactor) const;
  void consider(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda);
  void bridge_gaps(Index point, std::span<Nearby> beside);
  void drop_ambiguous();
  void end_before(Index point);
  void find_histories(Index point);
  void continue_histories(std::size_t first, std::size_t last);
  [[nodiscard]] double first_offset(Index point, const Candidate& candidate, const Vec3& motion,
                                    const Vec3& gradient) const;
  void switch_gradient(const ContactPoint& point, const Candidate& candidate, const TouchingCouple& old,
                       const Vec3& motion, const Vec3& gradient, Adjusted& now) const;
  [[nodiscard]] bool comes_from_beside(const ContactPoint& point, const Candidate& candidate, const Vec3& motion) const;
  [[nodiscard]] Vec3 gradient_before(const Candidate& candidate, const Vec3& gradient) const;
  [[nodiscard]] bool is_fresh(const ContactCouple& couple) const;

  ContactView& view_;
  ContactState& contact_;
  EndedCouples& ended_;
  std::vector<Candidate> candidates_;  ///< of the point at hand, ascending
  std::vector<bool> continued_;        ///< old histories of the point at hand
  std::size_t old_ = 0;                ///< first old history not yet compared
};

}  // namespace breccia
