#include "physics/contact/step/upper_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "base/index.hpp"
#include "physics/contact/geometry/point.hpp"

namespace breccia {
namespace {

/// A patch with the largest numbers of a group.
ContactPatch patch_of_group(const ContactParams& params, Index group, const double* numbers) {
  using Largest = ContactElements::Largest;
  const FaceRule& rule = face_rule(params.points_per_face);
  ContactPatch patch;
  patch.group = group;
  patch.largest[ContactPatch::area_over_mass] = numbers[Largest::area_over_mass];
  patch.largest[ContactPatch::per_mass] = numbers[Largest::per_mass];
  patch.largest[ContactPatch::steepness] = numbers[Largest::steepness];
  patch.largest[ContactPatch::per_length] = numbers[Largest::per_length];
  patch.largest[ContactPatch::weight] =
      *std::max_element(rule.share.begin(), rule.share.begin() + rule.num_points) * numbers[Largest::area];
  return patch;
}

}  // namespace

ContactUpperBounds::ContactUpperBounds(const ContactStepModel& model, const ContactElements& elements)
    : model_(model), elements_(elements), numbers_(elements.largest()), groups_(at(model.params.num_groups)) {
  numbers_.resize(groups_.size() * ContactElements::Largest::count, 0.0);
}

void ContactUpperBounds::update() {
  const ContactParams& params = model_.params;
  std::vector<ContactPatch> patches;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const double* numbers = &numbers_[g * ContactElements::Largest::count];
    patches.push_back(patch_of_group(params, static_cast<Index>(g), numbers));
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    const std::array<double, ContactPatch::count>& numbers = patches[g].largest;
    group.bounds.clear();
    for (const ContactPatch& other : patches) add_bounds(contact_bounds(params, patches[g], other), group.bounds);
    group.wall = params.sphere ? params.sphere->penalty * numbers[ContactPatch::per_length] : 0.0;
    group.most = share(group, numbers[ContactPatch::area_over_mass], numbers[ContactPatch::per_mass]);
  }
}

double ContactUpperBounds::share(const Group& group, double area_over_mass, double per_mass) {
  double largest = 0;
  for (const ContactBound& bound : group.bounds) largest = std::max(largest, bound.share(area_over_mass, per_mass));
  return group.wall * area_over_mass + largest;
}

ContactShare ContactUpperBounds::of(Index slot) const {
  const ContactElement& element = elements_.of(slot);
  const Group& group = groups_[at(model_.mesh.block_group[at(slot / kLanes)])];
  ContactShare bound;
  for_each_face(model_.faces.open[at(slot)], [&](int face) {
    for (const int c : kFaceCorners[at(face)])
      bound.omega_squared[at(c)] = share(group, element.area_over_mass[at(c)], element.per_mass[at(c)]);
  });
  return bound;
}

ContactPatches patches_around(const ContactStepModel& model, const ContactElements& elements,
                              const Field<double>& position, const Field<double>& velocity, double coarsening,
                              Index slot) {
  constexpr double kFaceSizes = 2.0;  // from the element: further away the bound is lower in most cases
  const ContactElement& element = elements.of(slot);
  const double reach = kFaceSizes * *std::max_element(element.longest.begin(), element.longest.end());
  const LocalMesh& mesh = model.mesh;
  const Vec3 middle = load_node(position.data(), mesh.corner_node(slot, 0));
  std::vector<Index> slots;
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (model.faces.open[at(s)] == 0 || !mesh.is_original(s)) continue;
    const Vec3 away = load_node(position.data(), mesh.corner_node(s, 0)) - middle;
    if (away.cwiseAbs().maxCoeff() <= reach) slots.push_back(s);
  }
  ContactPatches patches = contact_patches(model, elements, position, velocity, coarsening, slots);
  // Parts of a body may look folded where the whole is not.
  for (ContactPatch& patch : patches.list)
    std::copy_n(&patch.largest[ContactPatch::box], 6, &patch.largest[ContactPatch::reference_box]);
  return patches;
}

}  // namespace breccia
