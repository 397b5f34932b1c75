#include "physics/contact/view.hpp"

#include "physics/contact/geometry/outward.hpp"

namespace breccia {

namespace {

bool share_vertex(const LocalMesh& local, Index slot, Index other) {
  const std::array<Index, 4>&a = local.vertex[at(slot)], &b = local.vertex[at(other)];
  return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

}  // namespace

ContactView::ContactView(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt,
                         const ContactKernels& kernels, NodalForces& forces, ContactState& contact)
    : params_(params),
      local_(local),
      state_(state),
      dt_(dt),
      kernels_(kernels),
      forces_(forces),
      contact_(contact),
      rule_(face_rule(params.points_per_face)) {
  contact.elements.begin_step();
}

double ContactView::longest_delay(const ContactLaw& law, Index index, Index contactor) const {
  const auto extent = [&](Index slot) { return contact_.body_extent[at(local_.slot_body[at(slot)])]; };
  return law.friction_delay * std::min(extent(point(index).slot), extent(slot_of(contactor)));
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

double ContactView::share_of(Index index, Index contactor, const std::array<double, 4>& lambda) const {
  const ContactPoint& point = this->point(index);
  const Index own = contact_.contactor_of_slot[at(point.slot)];
  const bool both_press =
      own >= 0 && params_.points_everywhere && params_.law(group_of(slot_of(contactor)), group_of(point.slot)).active();
  if (!both_press || !rules().shares) return 1;
  return share_of_weight(sharpness(rule_, point, contact_.field[at(own)]),
                         sharpness(contact_.field[at(contactor)], lambda));
}

Outward ContactView::outward_of(const ContactPoint& point) const {
  Outward outward =
      outward_at(rule_, local_, contact_, point, [&](Index node) { return load_node(state_.position.data(), node); });
  if (!rules().corner_normals) outward.corner = Vec3::Zero();
  return outward;
}

StepElements::Block& ContactView::prepare_block(Index slot) {
  StepElements::Block& block = contact_.elements.prepare(slot);
  BlockCorners room;
  kernels_.prepare(local_.block_corners(block.index, state_.position.data(), room),
                   local_.volume.data() + at(block.index) * kLanes, block.elements.data());
  return block;
}

void ContactView::prepare_motion(StepElements::Block& block) const {
  block.moved_in = contact_.elements.step();
  BlockCorners room;
  kernels_.move_elements(local_.block_corners(block.index, state_.velocity.data(), room), block.elements.data());
}

void ContactView::prepare_forces(StepElements::Block& block) const {
  block.acted_in = contact_.elements.step();
  const double* from = forces_.block(block.index);
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        block.elements[lane].force[i][c] = from == nullptr ? 0.0 : from[(3 * c + i) * kLanes + lane];
    }
  }
}

void ContactView::add_force(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda,
                            const Vec3& force) {
  const std::array<double, 3>& shape = shape_at(point);
  if (point.slot < local_.num_own_slots) {
    StepElement& target = element_to_act_on(point.slot);
    const auto& corners = kFaceCorners[at(point.face)];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t c = 0; c < 3; ++c) target.force[i][corners[c]] += shape[c] * force[static_cast<Eigen::Index>(i)];
    }
  } else {
    const std::array<double*, 3> nodes = forces_.places(point.nodes);
    for (std::size_t i = 0; i < 3; ++i) NodalForces::add(nodes[i], shape[i], force);
  }
  const Index slot = slot_of(contactor);
  if (slot < local_.num_own_slots) {
    StepElement& other = element_to_act_on(slot);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t a = 0; a < 4; ++a) other.force[i][a] += -lambda[a] * force[static_cast<Eigen::Index>(i)];
    }
  } else {
    const std::array<double*, 4> nodes = forces_.places(local_.shared_corners[at(slot - local_.num_own_slots)]);
    for (std::size_t a = 0; a < 4; ++a) NodalForces::add(nodes[a], -lambda[a], force);
  }
}

void ContactView::store_forces() {
  contact_.elements.for_each_acted([&](const StepElements::Block& block) {
    double* to = forces_.acted_block(block.index);
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t i = 0; i < 3; ++i, to += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) to[lane] = block.elements[lane].force[i][c];
      }
    }
  });
}

const OverlapShape& ContactView::shape_of(Index contactor, Instant instant) const {
  if (!is_changed(contactor)) instant = Instant::now;
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

ContactView::Before ContactView::one_step_ago(const ContactPoint& point, Index contactor) const {
  const Index slot = slot_of(contactor);
  const double *x = state_.position.data(), *v = state_.velocity.data();
  std::array<Vec3, 4> corners = load_corners(local_, x, slot);
  const std::array<Vec3, 4> velocity = load_corners(local_, v, slot);
  for (std::size_t a = 0; a < 4; ++a) corners[a] -= dt_ * velocity[a];
  const PreparedTetra tetra = prepare(corners, local_.volume[at(slot)]);
  return {tetra, barycentric(tetra, at_point(rule_, point, x) - dt_ * at_point(rule_, point, v))};
}

}  // namespace breccia
