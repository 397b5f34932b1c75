#include "observe/fragment_labels.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/index.hpp"

namespace breccia {
namespace {

/// Two labels of one fragment, as two ranks see it.
struct Meeting {
  GlobalId here, there;
  auto operator<=>(const Meeting&) const = default;
};

Fragments fragments_of_rank(const Domain& domain) {
  FragmentFinder finder(domain.model.local);
  finder.join_linked(domain.derived.links);
  for (const ActiveJoint& joint : domain.state.joints.active) {
    if (joint.state() == JointState::holding) finder.join(joint.slot_a, joint.slot_b);
  }
  return finder.find();
}

constexpr GlobalId kNotSent = -1;

/// Every rank sends its neighbours its labels of those of their elements that are connected to others.
std::vector<Meeting> meetings(const Domain& domain, const Fragments& fragments) {
  std::vector<Communicator::ListOf<GlobalId>> lists;
  for (const SharedSlots& shared : domain.exchange.shared()) {
    std::vector<GlobalId>& labels = lists.emplace_back(Communicator::ListOf<GlobalId>{shared.rank, {}}).entries;
    for (const Index slot : shared.receive)
      labels.push_back(fragments.alone[at(slot)] != 0 ? kNotSent : fragments.of_slot[at(slot)]);
  }
  std::vector<Meeting> met;
  for (const auto& [rank, labels] : domain.exchange.communicator().exchange(lists)) {
    for (const SharedSlots& shared : domain.exchange.shared()) {
      if (shared.rank != rank) continue;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        const GlobalId here = fragments.of_slot[at(shared.send[i])];
        if (labels[i] != kNotSent && labels[i] != here) met.push_back({here, labels[i]});
      }
    }
  }
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  return met;
}

/// Labels that mean the same fragment, each with the lowest of them.
class LabelUnion {
 public:
  GlobalId lowest(GlobalId label) {
    const auto found = parent_.find(label);
    if (found == parent_.end() || found->second == label) return label;
    return found->second = lowest(found->second);
  }
  void join(GlobalId a, GlobalId b) {
    a = lowest(a);
    b = lowest(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::map<GlobalId, GlobalId> parent_;
};

}  // namespace

Fragments find_fragments(const Domain& domain) {
  Fragments fragments = fragments_of_rank(domain);
  if (domain.exchange.communicator().size() == 1) return fragments;
  const std::vector<Meeting> mine = meetings(domain, fragments);
  LabelUnion labels;
  for (const std::vector<Meeting>& part : domain.exchange.communicator().all_gather(std::span<const Meeting>(mine))) {
    for (const Meeting& meeting : part) labels.join(meeting.here, meeting.there);
  }
  const LocalMesh& local = domain.model.local;
  std::int64_t lowest_here = 0;
  for (Index s = 0; s < local.num_slots; ++s) {
    GlobalId& label = fragments.of_slot[at(s)];
    if (label < 0) continue;
    label = labels.lowest(label);
    if (local.is_original(s) && label == local.element_of_slot[at(s)]) ++lowest_here;
  }
  fragments.count = static_cast<Index>(domain.exchange.communicator().sum(lowest_here));
  return fragments;
}

const Fragments& FragmentWatch::look(const Domain& domain, std::int64_t decompositions) {
  const std::int64_t broken = domain.exchange.communicator().sum(domain.state.joints.broken);
  if (broken == broken_ && decompositions == decompositions_) return fragments_;
  fragments_ = find_fragments(domain);
  faces_.reset();
  broken_ = broken;
  decompositions_ = decompositions;
  return fragments_;
}

const std::vector<SurfaceFace>& FragmentWatch::free_faces(const Domain& domain) {
  if (!faces_) faces_ = surface_faces(domain);
  return *faces_;
}

}  // namespace breccia
