#include "physics/contact/forces.hpp"

#include <span>
#include <string>

#include "base/error.hpp"
#include "physics/contact/ending.hpp"
#include "physics/contact/geometry/field.hpp"
#include "physics/contact/locate.hpp"
#include "physics/contact/queue.hpp"
#include "physics/contact/resolve.hpp"
#include "physics/contact/spherical_boundary.hpp"
#include "physics/contact/view.hpp"

namespace breccia {

namespace {

ContactKernels kernels_for(Simd simd) {
  DEMAND(simd_available(simd), std::string(name_of(simd)));
  switch (simd) {
    case Simd::avx512:
      return contact_kernels_avx512();
    case Simd::avx2:
      return contact_kernels_avx2();
    case Simd::sse2:
      break;
  }
  return contact_kernels_sse2();
}

}  // namespace

void contact_forces(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt,
                    ContactState& contact, NodalForces& forces, ContactWork& work, Simd simd, bool side_by_side) {
  const ContactKernels kernels = side_by_side ? kernels_for(simd) : contact_kernels_scalar();
  contact.touching_before.swap(contact.touching);
  contact.touching.clear();
  work.stored = work.friction_stored = ExactSum{};
  work.touching = 0;
  spherical_boundary(params, local, state, dt, contact, forces, work.stored);
  ContactView view(params, local, state, dt, kernels, forces, contact);
  EndedCouples ended(view, contact, work);
  Resolver resolver(view, contact, ended);
  PairQueue queue(view, resolver, ended, contact, work, kernels);
  Locator locator(view, contact, kernels);
  locator.for_each_point([&](Index point, std::span<const Nearby> inside, std::span<Nearby> beside) {
    const std::span<const Candidate> candidates = resolver.candidates(point, inside, beside);
    queue.push_forces_of_ended();
    queue.push(point, candidates);
  });
  resolver.finish();
  queue.push_forces_of_ended();
  queue.finish();
  view.store_forces();
  contact.fresh.clear();
  end_changes(contact);
}

}  // namespace breccia
