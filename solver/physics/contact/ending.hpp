#pragma once

#include <optional>
#include <vector>

#include "physics/contact/forces.hpp"
#include "physics/contact/view.hpp"

/// For the sources of physics/contact alone.
namespace breccia {

/// A force of a couple that is known already, N, on the point.
struct KnownForce {
  Index point = 0, contactor = 0;
  std::array<double, 4> lambda{};
  Vec3 force{0, 0, 0};
};

/// What becomes of couples whose overlap has ended.
class EndedCouples {
 public:
  EndedCouples(ContactView& view, ContactState& contact, ContactWork& work)
      : view_(view), contact_(contact), work_(work) {}

  /// A couple that no candidate continues: the stored energy of the normal law was returned as work, or is returned by
  /// a push where the point has left across an edge, or is dissipated where a crack has opened; the spring is released.
  /// What is left of it, if anything, is appended to ContactState::touching, and its force to forces().
  /// @param lost  J, by the normal law in this step
  void end(const TouchingCouple& old, double lost = 0);

  /// A couple exerts no force by its law any more: the pull that removes what it has gained, N.
  /// @param last  one step ago;  @param h  read and written: force, gained, gained_before
  [[nodiscard]] Vec3 pull(const ContactPair<double>& pair, const PairHistory<double>& last, const Vec3& motion,
                          PairHistory<double>& h) const;

  /// In the order in which they came, since the last clear().
  [[nodiscard]] const std::vector<KnownForce>& forces() const { return forces_; }
  void clear() { forces_.clear(); }

 private:
  struct Escape {
    double overlap;  ///< m, of the place that it has left to
    double left;     ///< J, still stored; none: it has left through the side that it pressed on
    bool is_over;    ///< it cannot be returned
  };
  [[nodiscard]] Escape escape_of(const TouchingCouple& old, const ContactPair<double>& pair,
                                 const std::array<double, 4>& lambda, const Vec3& motion) const;
  [[nodiscard]] Vec3 way_out(const TouchingCouple& old, const std::array<double, 4>& lambda, const Vec3& motion,
                             bool across_edge) const;
  [[nodiscard]] Vec3 push(const ContactPair<double>& pair, const Vec3& outward, const Vec3& motion,
                          PairHistory<double>& h) const;
  Vec3 account_force(const Vec3& motion, PairHistory<double>& h) const;
  void keep(const TouchingCouple& ended, double overlap, const ContactPair<double>& pair,
            const std::array<double, 4>& lambda, const Vec3& place);
  [[nodiscard]] bool is_near(const std::array<double, 4>& lambda, Index slot, const Vec3& place) const;

  ContactView& view_;
  ContactState& contact_;
  ContactWork& work_;
  std::vector<KnownForce> forces_;
};

/// Whether nothing is left of the couple but what its overlaps have gained or lost and its delayed normal force.
[[nodiscard]] inline bool has_ended(const PairHistory<double>& h) {
  return !(h.d > 0) && h.offset == 0 && h.force == Vec3::Zero();
}

}  // namespace breccia
