#include "physics/contact/step/contact_step.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/index.hpp"
#include "mesh/tetrahedron.hpp"
#include "physics/contact/step/bound.hpp"
#include "physics/contact/step/elements.hpp"
#include "physics/contact/step/nearby.hpp"

namespace breccia {
namespace {

using Patch = ContactPatch;

/// Whether any of a patch can be outside the sphere within `time`.
bool may_pass(const SphericalBoundary& sphere, const Patch& p, double time) {
  double distance = 0, speed = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double centre = sphere.centre[static_cast<Eigen::Index>(i)];
    const double d = std::max(p.high(Patch::box, i) - centre, centre - p.low(Patch::box, i));
    const double v = std::max(p.high(Patch::velocity, i), -p.low(Patch::velocity, i));
    distance += d * d;
    speed += v * v;
  }
  return std::sqrt(distance) + kSpeedMargin * std::sqrt(speed) * time + kSizeMargin * p.face_size() > sphere.radius;
}

}  // namespace

double stiffest_slope(const ContactLaw& law) { return law.exponent * law.penalty; }

class ContactShares::Impl {
 public:
  Impl(const ContactStepModel& model, const ContactElements& elements, const ContactPatches& patches, double time)
      : model_(model),
        elements_(elements),
        patches_(patches),
        time_(time),
        nearby_(model_.params, patches.list, time),
        near_(patches.list.size()),
        at_most_(patches.list.size(), kUnknown) {}

  [[nodiscard]] ContactShare of(Index slot) {
    ContactShare share;
    if (model_.faces.open[at(slot)] == 0) return share;
    const ContactElement& element = elements_.of(slot);
    for_each_face(model_.faces.open[at(slot)], [&](int face) {
      const auto raise_corner = [&](int corner, double omega_squared, Index against) {
        if (omega_squared > share.largest()) {
          share.face = face;
          share.against = against;
        }
        double& largest = share.omega_squared[static_cast<std::size_t>(corner)];
        largest = std::max(largest, omega_squared);
      };
      const Index place = place_of(slot, face);
      const bool at_sphere = meets_sphere(place);
      for (const int c : kFaceCorners[static_cast<std::size_t>(face)]) {
        const double area = element.area_over_mass[static_cast<std::size_t>(c)];
        const double wall = at_sphere ? wall_share(place, area) : 0.0;
        if (at_sphere) raise_corner(c, wall, -1);
        const double per_mass = element.per_mass[static_cast<std::size_t>(c)];
        for (const ContactBound& m : near(place)) raise_corner(c, wall + m.share(area, per_mass), m.against);
      }
    });
    return share;
  }

  [[nodiscard]] double at_most(Index slot) {
    double largest = 0;
    for_each_face(model_.faces.open[at(slot)],
                  [&](int face) { largest = std::max(largest, at_most_of_patch(place_of(slot, face))); });
    return largest;
  }

 private:
  static constexpr double kUnknown = -1;

  [[nodiscard]] Index place_of(Index slot, int face) const { return patches_.place[at(4 * slot + face)]; }
  [[nodiscard]] const Patch& patch(Index place) const { return patches_.list[at(place)]; }
  [[nodiscard]] bool meets_sphere(Index place) const {
    const auto& sphere = model_.params.sphere;
    return sphere && patch(place).largest[Patch::weight] > 0 && may_pass(*sphere, patch(place), time_);
  }
  [[nodiscard]] double wall_share(Index place, double area_over_mass) const {
    return model_.params.sphere->penalty * patch(place).largest[Patch::per_length] * area_over_mass;
  }
  [[nodiscard]] const std::vector<ContactBound>& near(Index place) {
    Near& near = near_[at(place)];
    if (!near.found) near = {true, nearby_.bounds(at(place))};
    return near.bounds;
  }
  [[nodiscard]] double at_most_of_patch(Index place) {
    double& most = at_most_[at(place)];
    if (most != kUnknown) return most;
    const double area = patch(place).largest[Patch::area_over_mass], per_mass = patch(place).largest[Patch::per_mass];
    const double wall = meets_sphere(place) ? wall_share(place, area) : 0.0;
    most = wall;
    for (const ContactBound& m : nearby_.bounds_anywhere(patch(place)))
      most = std::max(most, wall + m.share(area, per_mass));
    return most;
  }

  struct Near {
    bool found = false;
    std::vector<ContactBound> bounds;
  };
  ContactStepModel model_;
  const ContactElements& elements_;
  const ContactPatches& patches_;
  double time_;
  PatchesNearby nearby_;
  std::vector<Near> near_;       ///< (patches) of those that have been requested
  std::vector<double> at_most_;  ///< (patches) 1/s2, or kUnknown
};

ContactShares::ContactShares(const ContactStepModel& model, const ContactElements& elements,
                             const ContactPatches& patches, double time)
    : impl_(patches.list.empty() ? nullptr : std::make_unique<Impl>(model, elements, patches, time)) {}
ContactShares::~ContactShares() = default;

ContactShare ContactShares::of(Index slot) { return impl_ ? impl_->of(slot) : ContactShare{}; }
double ContactShares::at_most(Index slot) { return impl_ ? impl_->at_most(slot) : 0.0; }

std::vector<ContactShare> contact_shares(const ContactStepModel& model, const ContactElements& elements,
                                         const ContactPatches& patches, double time) {
  ContactShares of_slots(model, elements, patches, time);
  std::vector<ContactShare> shares(at(model.mesh.num_slots));
  for (Index s = 0; s < model.mesh.num_slots; ++s) {
    if (model.mesh.is_original(s)) shares[at(s)] = of_slots.of(s);
  }
  return shares;
}

}  // namespace breccia
