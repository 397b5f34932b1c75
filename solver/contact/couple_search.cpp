#include "contact/couple_search.hpp"

#include <algorithm>
#include <limits>

#include "base/index.hpp"

namespace breccia {

namespace {

constexpr double kSmallestBuffer = 0.1, kLargestBuffer = 0.4;  ///< shares of the mean size, see the class comment
constexpr double kBufferSteps = 20;                            ///< steps that a chosen buffer should last for

}  // namespace

double largest_buffer(double asked, double contactor_size) {
  return asked > 0 ? std::max(asked, kSmallestBuffer * contactor_size) : kLargestBuffer * contactor_size;
}

CoupleSearch::CoupleSearch(const ContactSearchParams& search, const ContactSurface& surface,
                           const ContactState& contact, double contactor_size)
    : asked_buffer_(search.buffer),
      surface_(surface),
      contact_(contact),
      detection_(detection::make_search(search.algorithm, search.cell)),
      size_(contactor_size) {}

void CoupleSearch::expect_late_speeds() {
  constexpr int kSpeedDelay = 1;
  moved_ = DisplacementWatch(kSpeedDelay);
}

bool CoupleSearch::due(const NodalState& nodes, const KnownMotion& motion, const Communicator& communicator) {
  if (!surface_.any_law()) return false;
  if (!searched_) return true;
  moved_.step(motion.length);
  return moved_.used_up(0.5 * buffer_, motion.unforeseen, surface_.model().local, nodes.position, reference_,
                        communicator);
}

double CoupleSearch::used_up(const NodalState& nodes, const Communicator& communicator) const {
  const double moved = relative_displacement(surface_.model().local, nodes.position, reference_, communicator);
  return std::min(1.0, moved / (0.5 * buffer_));
}

double CoupleSearch::always_found() const { return 0.5 * kSmallestBuffer * size_; }

double CoupleSearch::buffer_for(double step_length) const {
  const double largest = largest_buffer(asked_buffer_, size_);
  return asked_buffer_ > 0 ? largest : std::clamp(2 * kBufferSteps * step_length, kSmallestBuffer * size_, largest);
}

void CoupleSearch::search(const NodalState& nodes, double step_length, std::span<const std::uint8_t> current,
                          std::vector<ContactCouple>& couples) {
  buffer_ = buffer_for(step_length);
  reference_ = nodes.position;
  detection::Corners unknown;
  unknown.fill(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  corners_.clear();
  for (const Index slot : contact_.contactors) {
    const bool known = current.empty() || current[at(slot)] != 0;
    corners_.push_back(known ? load_corners(surface_.model().local, reference_.data(), slot) : unknown);
  }
  choose(current);
  chosen_.positions.clear();
  for (const Index p : chosen_.points) chosen_.positions.push_back(position(contact_.points[at(p)]));

  detection_->search(chosen_.positions, chosen_.corners, buffer_, chosen_.found);
  couples.clear();
  for (const detection::Couple& c : chosen_.found) {
    const Index point = chosen_.points[at(c.point)], contactor = chosen_.contactors[at(c.contactor)];
    if (surface_.may_touch(point, contactor)) couples.push_back({point, contactor});
  }
  searched_ = true;
  grid_built_ = false;
  moved_.restart();
}

/// All points and contactors of evaluated elements, and what may be in couples with these, of groups with a law.
void CoupleSearch::choose(std::span<const std::uint8_t> current) {
  const bool alone = contact_.relevant.empty();
  if (!alone) find_roles(current);
  chosen_.contactors.clear();
  chosen_.corners.clear();
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Index slot = contact_.contactors[c];
    if (!surface_.may_be_pressed(slot)) continue;
    if (!alone && !contact_.evaluated(slot) && chosen_.roles[at(slot)] == HaloRole::none) continue;
    chosen_.contactors.push_back(static_cast<Index>(c));
    chosen_.corners.push_back(corners_[c]);
  }
  chosen_.points.clear();
  for (const Index p : contact_.order) {
    const Index slot = contact_.points[at(p)].slot;
    if (!surface_.may_press(slot)) continue;
    if (alone || contact_.evaluated(slot) || chosen_.roles[at(slot)] == HaloRole::contactor_and_points)
      chosen_.points.push_back(p);
  }
}

void CoupleSearch::find_roles(std::span<const std::uint8_t> current) {
  const LocalMesh& local = surface_.model().local;
  chosen_.extents.assign(at(local.num_slots), Extent{});
  for (Index s = 0; s < local.num_slots; ++s) {
    const bool known = local.element_of_slot[at(s)] >= 0 && (current.empty() || current[at(s)] != 0);
    if (known || contact_.evaluated(s)) chosen_.extents[at(s)] = extent_of(load_corners(local, reference_.data(), s));
  }
  find_halo_roles(contact_, chosen_.extents, buffer_, std::max(size_, buffer_), chosen_.roles);
}

Vec3 CoupleSearch::position(const ContactPoint& point) const {
  return at_point(face_rule(surface_.model().params.points_per_face), point, reference_.data());
}

void CoupleSearch::contactors_of(const Vec3& point, std::vector<Index>& contactors) {
  if (!grid_built_) grid_.build(corners_, buffer_);
  grid_built_ = true;
  grid_.couples_of(point, contactors);
}

}  // namespace breccia
