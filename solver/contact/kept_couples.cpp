#include "contact/kept_couples.hpp"

#include <algorithm>

#include "base/index.hpp"
#include "physics/contact/couples.hpp"

namespace breccia {

namespace {}  // namespace

void KeptCouples::replaced() {
  if (!contact_.relevant.empty()) {
    all_ = contact_.couples;
    made_since_.clear();
    keep_evaluated();
  }
  couples_replaced(contact_);
}

void KeptCouples::keep_evaluated() {
  std::vector<ContactCouple>& couples = contact_.couples;
  std::size_t kept = 0;
  for (std::size_t first = 0, end = 0; first < couples.size(); first = end) {
    bool evaluated = contact_.evaluated(contact_.points[at(couples[first].point)].slot);
    for (end = first; end < couples.size() && couples[end].point == couples[first].point; ++end) {
      evaluated = evaluated || contact_.evaluated(contact_.contactors[at(couples[end].contactor)]);
    }
    for (std::size_t i = first; i < end && evaluated; ++i) couples[kept++] = couples[i];
  }
  couples.resize(kept);
}

bool KeptCouples::is_kept(Index point) const {
  if (contact_.evaluated(contact_.points[at(point)].slot)) return true;
  const auto found = std::lower_bound(contact_.couples.begin(), contact_.couples.end(), ContactCouple{point, 0},
                                      [&](const auto& a, const auto& b) { return contact_.before(a, b); });
  return found != contact_.couples.end() && found->point == point;
}

bool KeptCouples::add(std::vector<ContactCouple>& made) {
  const auto before = [&](const ContactCouple& a, const ContactCouple& b) { return contact_.before(a, b); };
  std::sort(made.begin(), made.end(), before);
  made.erase(std::unique(made.begin(), made.end()), made.end());
  // A couple with an evaluated contactor brings in all others of its point.
  const bool brings_others = std::any_of(made.begin(), made.end(), [&](const ContactCouple& c) {
    return contact_.evaluated(contact_.contactors[at(c.contactor)]) && !is_kept(c.point);
  });
  if (brings_others) {
    choose_again(made);
    return true;
  }
  if (!contact_.relevant.empty()) made_since_.insert(made_since_.end(), made.begin(), made.end());
  std::erase_if(made, [&](const ContactCouple& c) { return !is_kept(c.point); });
  add_fresh_couples(made, contact_);
  return std::any_of(made.begin(), made.end(), [&](const ContactCouple& c) {
    return !contact_.evaluated(contact_.points[at(c.point)].slot) ||
           !contact_.evaluated(contact_.contactors[at(c.contactor)]);
  });
}

/// Which of all couples are kept, now that `made` are there.
void KeptCouples::choose_again(const std::vector<ContactCouple>& made) {
  const auto before = [&](const ContactCouple& a, const ContactCouple& b) { return contact_.before(a, b); };
  std::vector<ContactCouple>& couples = contact_.couples;
  put_awake_back(contact_);
  couples.swap(all_);
  const auto middle = couples.insert(couples.end(), made_since_.begin(), made_since_.end());
  std::sort(middle, couples.end(), before);
  std::inplace_merge(couples.begin(), middle, couples.end(), before);
  made_since_.clear();
  add_fresh_couples(made, contact_);
  all_ = couples;
  keep_evaluated();
  couples_replaced(contact_);
}

}  // namespace breccia
