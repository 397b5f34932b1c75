#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "physics/contact/contact_block.hpp"
#include "physics/contact/contact_field.hpp"
#include "physics/contact/contact_forces.hpp"
#include "physics/contact/contact_law.hpp"
#include "physics/contact/friction.hpp"

/// For contact_forces.cpp, contact_histories.cpp and contact_lanes.cpp only.
namespace breccia::contact_pass {

inline Index group_of(const LocalMesh& local, Index slot) {
  return local.block_group[static_cast<std::size_t>(slot / kLanes)];
}

inline bool share_vertex(const LocalMesh& local, Index slot, Index other) {
  const std::array<Index, 4>& a = local.vertex[static_cast<std::size_t>(slot)];
  const std::array<Index, 4>& b = local.vertex[static_cast<std::size_t>(other)];
  return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

/// A contactor that holds the point at hand.
struct Candidate {
  Index contactor;
  std::array<double, 4> lambda;
  OverlapRows rows;              ///< of the contactor that count for the point
  double g;                      ///< m, now
  Vec3 gradient;                 ///< -, of the overlap, now
  double g_before;               ///< m, with the field of one step ago
  double gained = 0;             ///< J, left to put right by couples of the point that have ended
  DelayedForce delayed{};        ///< of the same
  double turn = 0;               ///< m, gradient now times the last motion beyond what the overlap has changed by
  std::ptrdiff_t old = -1;       ///< index of its history among those of the last step, -1: none
  std::optional<Vec3> motion{};  ///< m, relative_motion(), once it has been computed
};

/// A couple of the point at hand that lies in the contactor or just beside it.
struct Nearby {
  ContactCouple* couple;
  std::array<double, 4> lambda;
  double safe;  ///< m, as in LocateBlock
};

/// A couple to be evaluated, and the position of its point.
struct Located {
  ContactCouple* couple;
  std::array<double, 4> lambda;
  double safe;  ///< m, as in LocateBlock
  Whereabouts where;
};

/// A point to be evaluated, with its couples.
struct LocatedPoint {
  PointCouples* point;
  std::span<ContactCouple> couples;
  std::size_t first;  ///< of its couples
};

/// A force that is to be added to nodes, in its turn: of a couple in the block, or known already.
struct Waiting {
  const ContactPoint* point;
  Index contactor;
  std::array<double, 4> lambda;
  Vec3 force{0, 0, 0};       ///< N, on the point
  std::ptrdiff_t lane = -1;  ///< in the block, -1: known
};

/// A couple in the block.
struct Lane {
  Index point;
  std::size_t touching;  ///< where it stands in ContactState::touching
  std::ptrdiff_t old;    ///< likewise in touching_before
};

/// Whether nothing is left of the couple but what its overlaps have gained or lost and its delayed normal force.
inline bool has_ended(const TouchingCouple& couple) {
  return !(couple.d > 0) && couple.offset == 0 && couple.force == Vec3::Zero();
}

/// Whether in addition no force of it is to be balanced.
inline bool is_settled(const TouchingCouple& couple) {
  return has_ended(couple) && couple.gained == 0 && couple.friction == Vec3::Zero() && couple.spring == Vec3::Zero();
}

/// Normal force with damping over the slope of the overlap, N, and what the damping takes, J.
struct Damping {
  double pressure, dissipated;
};

/// One call of contact_forces.
class Pass {
 public:
  Pass(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt, ContactState& contact,
       NodalForces& forces, ContactWork& work, ContactKernels kernels)
      : params_(params),
        local_(local),
        state_(state),
        dt_(dt),
        contact_(contact),
        forces_(forces),
        work_(work),
        kernels_(kernels),
        rule_(face_rule(params.points_per_face)) {}

  void run();

 private:
  [[nodiscard]] PreparedTetra prepare_element(Index slot) const;
  [[nodiscard]] const PreparedTetra& prepare_contactor(Index contactor);
  [[nodiscard]] PreparedTetra prepare_past_contactor(Index contactor);
  void look_at(PointCouples& point, std::span<ContactCouple> couples);
  void locate(std::size_t first);
  void evaluate_located();
  void evaluate_point(const LocatedPoint& located_point, std::size_t end);
  void bridge_gaps(Index point);
  [[nodiscard]] const Nearby* facing_more(const ContactPoint& point, Index candidate) const;
  void prefer_facing_sides(const ContactPoint& point, std::size_t inside);
  [[nodiscard]] Facing side_over(const ContactPoint& point, const Nearby& here) const;
  void touch_point(Index point);
  void drop_ambiguous();
  void forget_before(Index point);
  void find_histories(Index point);
  void take_over(std::size_t first, std::size_t last);
  void forget(const TouchingCouple& old, double lost = 0);
  [[nodiscard]] bool is_near(const std::array<double, 4>& lambda, Index slot, const Vec3& place) const;
  void end(const ContactPoint& point, const TouchingCouple& last, const Vec3& motion,
           const std::array<double, 4>& lambda, TouchingCouple& h);
  [[nodiscard]] Vec3 relative_motion(const ContactPoint& point, Index slot, const std::array<double, 4>& lambda) const;
  [[nodiscard]] const Vec3& motion_of(const ContactPoint& point, Candidate& candidate) const;
  [[nodiscard]] const Vec3& curl_of(Index slot);
  [[nodiscard]] Vec3 mean_turn(Index target, Index contactor);
  [[nodiscard]] bool comes_from_beside(const ContactPoint& point, Candidate& candidate, double offset) const;
  [[nodiscard]] double first_offset(Index point, Candidate& candidate) const;
  [[nodiscard]] static double go_to(const ContactLaw& law, double scale, double length, double g, TouchingCouple& h);
  [[nodiscard]] static double follow(const ContactLaw& law, double scale, double length, const Candidate& candidate,
                                     TouchingCouple& h);
  /// Gradient of the overlap by the field of one step ago.
  [[nodiscard]] Vec3 gradient_before(const Candidate& candidate) const;
  struct Before {
    PreparedTetra tetra;
    std::array<double, 4> lambda;
    OverlapRows rows;
  };
  [[nodiscard]] Before one_step_ago(const ContactPoint& point, Index contactor) const;
  void keep_step(const ContactPoint& point, double length, TouchingCouple& h, Candidate& candidate) const;
  void act(Index point, Candidate& candidate);
  void touch(Index point, Candidate& candidate, TouchingCouple& h);
  [[nodiscard]] bool press_aside(Index point);
  [[nodiscard]] bool is_ordinary(const ContactLaw& law, Index contactor) const;
  [[nodiscard]] const TouchingCouple* only_history(Index point, Index contactor);
  void pass_over_beside();
  void fill_lane(const ContactLaw& law, double length, const TouchingCouple& old, const TouchingCouple& h, double g,
                 double lost);
  void place_lane(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda,
                  const std::array<double, 4>& depth);
  void press_waiting();
  void store_results(const Waiting& waiting);
  [[nodiscard]] double press(const ContactLaw& law, const ContactPoint& point, double length, const Vec3& motion,
                             const Candidate& candidate, TouchingCouple& h);
  void balance(const ContactLaw& law, const ContactPoint& point, double length, const Vec3& motion,
               TouchingCouple& h) const;
  [[nodiscard]] Damping damp(const ContactLaw& law, const ContactPoint& point, const Vec3& motion,
                             const Candidate& candidate, double elastic) const;
  void distribute(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda, const Vec3& force);
  void add_force(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda, const Vec3& force);

  [[nodiscard]] const ContactPoint& point_at(Index point) const {
    return contact_.points[static_cast<std::size_t>(point)];
  }
  [[nodiscard]] Index slot_of(Index contactor) const {
    return contact_.contactors[static_cast<std::size_t>(contactor)];
  }
  [[nodiscard]] Index body_of(Index contactor) const {
    return local_.slot_body[static_cast<std::size_t>(slot_of(contactor))];
  }
  /// Whether the overlap field of a contactor changes in this step.
  [[nodiscard]] bool is_growing(Index contactor) const {
    return contact_.ramp_of_contactor[static_cast<std::size_t>(contactor)] >= 0;
  }
  /// Whether two contactors are of one body and share a vertex of its mesh.
  [[nodiscard]] bool are_neighbours(Index contactor, Index other) const {
    return body_of(contactor) == body_of(other) && share_vertex(local_, slot_of(contactor), slot_of(other));
  }
  [[nodiscard]] double length_of(Index slot) const {
    return contact_.body_length[static_cast<std::size_t>(local_.slot_body[static_cast<std::size_t>(slot)])];
  }
  /// s, of friction (friction.hpp)
  [[nodiscard]] double longest_delay(const ContactLaw& law, const TouchingCouple& h) const {
    const auto extent = [&](Index slot) {
      return contact_.body_extent[static_cast<std::size_t>(local_.slot_body[static_cast<std::size_t>(slot)])];
    };
    return law.friction_delay * std::min(extent(point_at(h.point).slot), extent(slot_of(h.contactor)));
  }
  [[nodiscard]] const ContactLaw& law_of(Index point, Index contactor) const {
    return params_.law(group_of(local_, point_at(point).slot), group_of(local_, slot_of(contactor)));
  }
  /// N/m, of a couple along its normal; times tangential_ratio of its friction.
  [[nodiscard]] static double stiffness(const ContactLaw& law, const ContactPoint& point, double length) {
    return point.weight * law.penalty / length;
  }
  [[nodiscard]] double stiffness(const ContactPoint& point, const TouchingCouple& h) const {
    return stiffness(law_of(h.point, h.contactor), point, length_of(slot_of(h.contactor)));
  }
  [[nodiscard]] double spring_stiffness(const ContactPoint& point, const TouchingCouple& h) const {
    return law_of(h.point, h.contactor).tangential_ratio * stiffness(point, h);
  }
  /// J, by the normal law of a couple.
  [[nodiscard]] double normal_held(const ContactPoint& point, const TouchingCouple& h) const {
    const double scale = point.weight * length_of(slot_of(h.contactor));
    return scale * normal_law::stored(law_of(h.point, h.contactor), h.d, h.d_max);
  }
  [[nodiscard]] double held(const ContactPoint& point, const TouchingCouple& h) const {
    return normal_held(point, h) + 0.5 * spring_stiffness(point, h) * h.spring.squaredNorm();
  }
  /// @pre the contactor has been evaluated in this step
  [[nodiscard]] const PreparedTetra& prepared(Index contactor) const {
    return contact_.prepared[static_cast<std::size_t>(contact_.place[static_cast<std::size_t>(contactor)])];
  }
  /// Where the work at a point is accounted: couples are computed wherever one side is at home, and accounted with
  /// their points.
  [[nodiscard]] ExactSum& account(const ContactPoint& point, ExactSum& sum) {
    return local_.is_original(point.slot) ? sum : ignored_;
  }
  /// The overlap function of a contactor that counts at lambda, of all. @pre it is not growing
  [[nodiscard]] OverlapFunction least_function_of(Index contactor, const std::array<double, 4>& lambda) const;
  /// The overlap functions of a contactor; valid until the next call.
  [[nodiscard]] const OverlapShape& shape_of(Index contactor, Instant instant = Instant::now) const;
  /// Normal of a point's face. @param dt  s, by which the nodes are taken back
  [[nodiscard]] Vec3 outward_of(const ContactPoint& point, double dt = 0) const {
    return outward_normal(point, [&](Index node) {
      const Vec3 x = load_node(state_.position.data(), node);
      return dt > 0 ? Vec3(x - dt * load_node(state_.velocity.data(), node)) : x;
    });
  }
  /// Those of a contactor's functions that count for a point. @param tetra, dt  by dt ago
  [[nodiscard]] OverlapRows rows_of(const ContactPoint& point, Index contactor, const OverlapShape& shape,
                                    const PreparedTetra& tetra, double dt = 0) const {
    return shape.rows < 2 || !has_sides(params_, contact_, contactor) ? kAllRows
                                                                      : rows_for(shape, tetra, outward_of(point, dt));
  }
  [[nodiscard]] Candidate candidate_of(const ContactPoint& point, Index contactor,
                                       const std::array<double, 4>& lambda) const;
  /// Adds the contactor to the candidates of a point if its overlap is positive now or was so before the field moved.
  void consider(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda);

  const ContactParams& params_;
  const LocalMesh& local_;
  const NodalState& state_;
  double dt_;
  ContactState& contact_;
  NodalForces& forces_;
  ContactWork& work_;
  ContactKernels kernels_;
  const FaceRule& rule_;
  std::vector<LocatedPoint> points_;   ///< a few, to be evaluated next
  std::vector<Located> located_;       ///< of these
  std::vector<Candidate> candidates_;  ///< of the point at hand, ascending
  std::vector<Nearby> inside_;         ///< of the same point, ascending: couples whose contactor holds it
  std::vector<Nearby> beside_;         ///< likewise: it lies just outside
  std::vector<bool> taken_;            ///< old histories of the point at hand that live on
  std::size_t old_ = 0;                ///< first old history not yet compared
  ExactSum ignored_;                   ///< what other ranks account

  // Couples of the points before that are evaluated side by side, and all forces from the first of these on.
  LocateBlock locate_block_;
  ContactBlock block_;
  std::array<Lane, kLanes> lanes_;
  std::size_t filled_ = 0;
  std::vector<Waiting> waiting_;

  // The last result of shape_of: several calls for one couple follow each other.
  mutable OverlapShape shape_;
  mutable Index shape_of_ = -1;
  mutable Instant shape_at_ = Instant::now;
};

}  // namespace breccia::contact_pass
