#include <algorithm>
#include <numeric>
#include <utility>

#include "base/index.hpp"
#include "physics/contact/step/contact_step.hpp"

namespace breccia {
namespace {

using Patch = ContactPatch;

bool before(const Patch& p, const Patch& q) { return p.key() < q.key(); }

}  // namespace

void ContactPatches::sort() {
  std::vector<Index> order(list.size()), moved(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index i, Index k) { return before(list[at(i)], list[at(k)]); });
  std::vector<Patch> sorted;
  sorted.reserve(order.size());
  for (const Index i : order) {
    moved[at(i)] = static_cast<Index>(sorted.size());
    sorted.push_back(list[at(i)]);
  }
  list = std::move(sorted);
  for (Index& i : place) i = i < 0 ? -1 : moved[at(i)];
}

void ContactPatches::merge(std::vector<ContactPatch> of_all) {
  std::sort(of_all.begin(), of_all.end(), before);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < of_all.size(); ++i) {
    if (kept > 0 && of_all[kept - 1].key() == of_all[i].key())
      of_all[kept - 1].raise_all(of_all[i]);
    else
      of_all[kept++] = Patch(of_all[i]);
  }
  of_all.resize(kept);
  std::vector<Index> moved;
  moved.reserve(list.size());
  for (const Patch& mine : list)
    moved.push_back(static_cast<Index>(std::lower_bound(of_all.begin(), of_all.end(), mine, before) - of_all.begin()));
  for (Index& i : place) i = i < 0 ? -1 : moved[at(i)];
  list = std::move(of_all);
}

}  // namespace breccia
