#include "physics/contact/view.hpp"

namespace breccia {

namespace {

bool share_vertex(const LocalMesh& local, Index slot, Index other) {
  const std::array<Index, 4>&a = local.vertex[at(slot)], &b = local.vertex[at(other)];
  return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

}  // namespace

ContactView::ContactView(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt,
                         ContactState& contact)
    : params_(params),
      local_(local),
      state_(state),
      dt_(dt),
      contact_(contact),
      rule_(face_rule(params.points_per_face)) {
  ++contact.calls;
  contact.prepared.resize(contact.in_couples.size());
  contact.prepared_in.resize(contact.in_couples.size(), 0);
  contact.turns.resize(at(local.num_slots));
}

const ContactLaw& ContactView::law_of(Index index, Index contactor) const {
  return params_.law(group_of(point(index).slot), group_of(slot_of(contactor)));
}

double ContactView::longest_delay(Index index, Index contactor) const {
  const auto extent = [&](Index slot) { return contact_.body_extent[at(local_.slot_body[at(slot)])]; };
  return law_of(index, contactor).friction_delay * std::min(extent(point(index).slot), extent(slot_of(contactor)));
}

bool ContactView::are_neighbours(Index contactor, Index other) const {
  return body_of(contactor) == body_of(other) && share_vertex(local_, slot_of(contactor), slot_of(other));
}

bool ContactView::shares_vertex(Index index, Index contactor) const {
  return share_vertex(local_, point(index).slot, slot_of(contactor));
}

Vec3 ContactView::relative_motion(const ContactPoint& point, Index contactor,
                                  const std::array<double, 4>& lambda) const {
  const double* v = state_.velocity.data();
  const Index slot = slot_of(contactor);
  Vec3 relative = at_point(rule_, point, v);
  for (int a = 0; a < 4; ++a) relative -= lambda[at(a)] * load_node(v, local_.corner_node(slot, a));
  return dt_ * relative;
}

/// Of an element's velocities, 1/s; 0 of an inert one. An element is in many couples: once a step.
const Vec3& ContactView::curl_of(Index slot) {
  ElementTurn& turn = contact_.turns[at(slot)];
  if (turn.in == contact_.calls) return turn.curl;
  turn = {Vec3::Zero(), contact_.calls};
  const Index contactor = contact_.contactor_of_slot[at(slot)];
  const PreparedTetra tetra = contactor >= 0 ? prepare_past_contactor(contactor) : prepare_element(slot);
  if (inert(tetra)) return turn.curl;
  const std::array<Vec3, 4> v = load_corners(local_, state_.velocity.data(), slot);
  for (std::size_t c = 1; c < 4; ++c) {
    const std::array<double, 3>& row = tetra.gradient[c - 1];
    turn.curl += Vec3(row[0], row[1], row[2]).cross(v[c] - v[0]);
  }
  return turn.curl;
}

Vec3 ContactView::mean_rotation(const ContactPoint& point, Index contactor) {
  return 0.25 * dt_ * (curl_of(point.slot) + curl_of(slot_of(contactor)));
}

Vec3 ContactView::outward_of(const ContactPoint& point, double dt) const {
  return outward_normal(point, [&](Index node) {
    const Vec3 x = load_node(state_.position.data(), node);
    return dt > 0 ? Vec3(x - dt * load_node(state_.velocity.data(), node)) : x;
  });
}

PreparedTetra ContactView::prepare_element(Index slot) const {
  return prepare(load_corners(local_, state_.position.data(), slot), local_.volume[at(slot)]);
}

const PreparedTetra& ContactView::prepare_contactor(Index contactor) {
  const std::size_t place = at(contact_.place[at(contactor)]);
  if (contact_.prepared_in[place] != contact_.calls) {
    contact_.prepared_in[place] = contact_.calls;
    contact_.prepared[place] = prepare_element(slot_of(contactor));
  }
  return contact_.prepared[place];
}

PreparedTetra ContactView::prepare_past_contactor(Index contactor) {
  const bool in_couples = contact_.place[at(contactor)] >= 0;
  return in_couples ? prepare_contactor(contactor) : prepare_element(slot_of(contactor));
}

const OverlapShape& ContactView::shape_of(Index contactor, Instant instant) const {
  if (!is_growing(contactor)) instant = Instant::now;
  if (contactor != shape_of_ || instant != shape_at_) {
    shape_ = overlap_shape(params_, local_, contact_, contactor, instant);
    shape_of_ = contactor;
    shape_at_ = instant;
  }
  return shape_;
}

OverlapFunction ContactView::least_function_of(Index contactor, const std::array<double, 4>& lambda) const {
  if (params_.field == OverlapField::body)
    return least_function(contact_.height[at(contactor)], contact_.field[at(contactor)], lambda);
  const OverlapShape& shape = shape_of(contactor);
  const std::size_t row = least_row(shape, lambda);
  return {row_value(shape, row, lambda), shape.row[row]};
}

OverlapRows ContactView::rows_of(const ContactPoint& point, Index contactor, const OverlapShape& shape,
                                 const PreparedTetra& tetra, double dt) const {
  return shape.rows < 2 || !has_sides(contactor) ? kAllRows : rows_for(shape, tetra, outward_of(point, dt));
}

ContactView::Before ContactView::one_step_ago(const ContactPoint& point, Index contactor) const {
  const Index slot = slot_of(contactor);
  const double *x = state_.position.data(), *v = state_.velocity.data();
  std::array<Vec3, 4> corners = load_corners(local_, x, slot);
  const std::array<Vec3, 4> velocity = load_corners(local_, v, slot);
  for (std::size_t a = 0; a < 4; ++a) corners[a] -= dt_ * velocity[a];
  const PreparedTetra tetra = prepare(corners, local_.volume[at(slot)]);
  const OverlapShape& shape = shape_of(contactor, Instant::step_before);
  return {tetra, barycentric(tetra, at_point(rule_, point, x) - dt_ * at_point(rule_, point, v)),
          inert(tetra) ? kAllRows : rows_of(point, contactor, shape, tetra, dt_)};
}

}  // namespace breccia
