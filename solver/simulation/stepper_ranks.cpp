#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "simulation/stepper.hpp"

/// The part of Stepper that talks to other ranks.
namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

template <class T>
std::vector<std::byte> bytes_of(const std::vector<T>& list) {
  const auto* raw = reinterpret_cast<const std::byte*>(list.data());
  return {raw, raw + list.size() * sizeof(T)};
}

template <class T>
std::vector<T> list_of(const std::vector<std::byte>& bytes) {
  std::vector<T> list(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(static_cast<void*>(list.data()), bytes.data(), bytes.size());
  return list;
}

}  // namespace

void Stepper::connect(const Communicator& communicator, std::vector<SharedElements> shared, ExchangeKind kind) {
  communicator_ = communicator;
  exchange_ = kind;
  shared_elements_ = std::move(shared);
  all_ = std::make_unique<Halo>(communicator_, halo_plan(shared_elements_), 2, exchange_);
  if (contact_) contact_->restrict_to(relevant_);
  plan_near();
  vote_.emplace(communicator, 4);
  cast_votes(false);
}

/// Originals, and elements that put forces on nodes of originals.
void Stepper::find_relevant() {
  const LocalMesh& local = model_.local;
  relevant_ = local.original;
  for (Index s = local.num_own_slots; s < local.num_slots; ++s) {
    if (local.element_of_slot[at(s)] < 0) continue;
    for (int c = 0; c < 4; ++c) {
      if (local.corner_node(s, c) < local.num_moved_nodes) relevant_[at(s)] = 1;
    }
    const Index block = s / kLanes;
    if (relevant(s) && (shared_blocks_.empty() || shared_blocks_.back() != block)) shared_blocks_.push_back(block);
  }
}

std::vector<HaloNeighbour> Stepper::halo_plan(const std::vector<SharedElements>& shared) const {
  const LocalMesh& local = model_.local;
  const auto places = [&](const std::vector<GlobalId>& ids) {
    std::vector<std::size_t> list;
    std::set<Index> known;  // a shared node goes once
    for (const GlobalId id : ids) {
      const Index slot = local.slot_of_element[at(element_with(id))];
      for (int c = 0; c < 4; ++c) {
        const Index node = local.corner_node(slot, c);
        if (slot >= local.num_own_slots && !known.insert(node).second) continue;
        list.push_back(nodal(node, 0));
      }
    }
    return list;
  };
  std::vector<HaloNeighbour> plan;
  for (const SharedElements& elements : shared) plan.push_back({elements.rank, places(elements.send), places(elements.receive)});
  return plan;
}

/// Elements whose motion the forces computed here depend on.
std::vector<std::uint8_t> Stepper::near_slots() const {
  std::vector<std::uint8_t> near = relevant_;
  for (const ModelJoint& joint : model_.joints) {
    const Index a = model_.local.slot_of_element[at(joint.face.a)], b = model_.local.slot_of_element[at(joint.face.b)];
    if (relevant(a) || relevant(b)) near[at(a)] = near[at(b)] = 1;
  }
  if (contact_) contact_->mark_coupled(near);
  return near;
}

/// Asks the owners of near proxies for them.
void Stepper::plan_near() {
  const std::vector<std::uint8_t> near = near_slots();
  std::vector<SharedElements> wanted;
  std::vector<Communicator::Parcel> parcels;
  for (const SharedElements& shared : shared_elements_) {
    SharedElements& ask = wanted.emplace_back();
    ask.rank = shared.rank;
    for (const GlobalId id : shared.receive) {
      if (near[at(model_.local.slot_of_element[at(element_with(id))])] != 0) ask.receive.push_back(id);
    }
    if (!ask.receive.empty()) parcels.push_back({ask.rank, bytes_of(ask.receive)});
  }
  for (const Communicator::Parcel& parcel : communicator_.exchange(std::move(parcels))) {
    const auto of_rank = std::find_if(wanted.begin(), wanted.end(), [&](const SharedElements& s) { return s.rank == parcel.rank; });
    DEMAND(of_rank != wanted.end(), "rank " + std::to_string(parcel.rank) + " is no neighbour");
    of_rank->send = list_of<GlobalId>(parcel.bytes);
  }
  if (near_) {
    messages_ += near_->messages();
    bytes_ += near_->bytes();
  }
  near_ = std::make_unique<Halo>(communicator_, halo_plan(wanted), 2, exchange_);
}

std::int64_t Stepper::messages() const { return messages_ + (all_ ? all_->messages() + near_->messages() : 0); }
std::int64_t Stepper::bytes() const { return bytes_ + (all_ ? all_->bytes() + near_->bytes() : 0); }

/// What all ranks said at the end of the last step.
void Stepper::hear_votes() {
  max_speed_anywhere_ = max_speed_;
  news_ = !releasing_.empty();
  if (!vote_) return;
  const auto lap = timer_.measure(Phase::communication);
  communicator_.set_phase("votes at the end of a step");
  const std::span<const double> largest = vote_->take();
  max_speed_anywhere_ = largest[0];
  stop_agreed_ = largest[2] > 0;
  news_ = largest[3] > 0;
  if (!(largest[1] > 0)) return;
  communicator_.agree([&] {
    if (failure_) throw SimulationError(*failure_);
  });
}

void Stepper::cast_votes(bool stop) {
  if (!vote_) {
    stop_agreed_ = stop;
    return;
  }
  vote_->post(std::array{max_speed_, failure_ ? 1.0 : 0.0, stop ? 1.0 : 0.0, releasing_.empty() ? 0.0 : 1.0});
}

void Stepper::conclude() {
  hear_votes();
  vote_.reset();
}

/// Joints that came apart on any rank in the last step.
void Stepper::hear_releases() {
  freed_.clear();
  if (!news_) return;
  const auto lap = timer_.measure(Phase::communication);
  communicator_.set_phase("news of joints that came apart");
  for (const std::vector<GlobalId>& of_rank : communicator_.all_gather(std::span<const GlobalId>(releasing_))) {
    for (const GlobalId id : of_rank) {
      const Index a = element_with(id / 4);
      if (a < model_.mesh.num_elements() && model_.mesh.element_id(a) == id / 4) {
        freed_.push_back({model_.local.slot_of_element[at(a)], static_cast<int>(id % 4)});
      }
    }
  }
  releasing_.clear();
}

void Stepper::update_contact() {
  bool due = false;
  communicator_.set_phase("contact search");
  {
    const auto lap = timer_.measure(Phase::search);
    due = contact_->due(state_, max_speed_anywhere_, dt_before_, communicator_);
  }
  const bool stale = vote_ && (due || news_ || contact_->verifies());
  if (stale) {
    const auto lap = timer_.measure(Phase::communication);
    all_->gather_begin(std::array{state_.position.data(), state_.velocity.data()});
    all_->gather_end();
  }
  {
    const auto lap = timer_.measure(Phase::search);
    // In this order, so that what fracture makes touch is known as such also when nothing has been searched yet.
    if (due) contact_->search(state_, max_speed_anywhere_ * dt_before_);
    if (!freed_.empty()) contact_->release_faces(freed_);
  }
  if (stale) {
    const auto lap = timer_.measure(Phase::communication);
    exchange_touching();
    plan_near();
  }
  contact_->verify(state_);
}

/// Every rank tells its neighbours what the points of their proxies touch.
void Stepper::exchange_touching() {
  std::vector<Communicator::Parcel> parcels;
  for (const SharedElements& shared : shared_elements_) {
    std::vector<CoupleRecord> touching;
    for (const GlobalId id : shared.send) contact_->touching_of(id, touching);
    if (!touching.empty()) parcels.push_back({shared.rank, bytes_of(touching)});
  }
  std::vector<CoupleRecord> heard;
  for (const Communicator::Parcel& parcel : communicator_.exchange(std::move(parcels))) {
    const auto of_rank = list_of<CoupleRecord>(parcel.bytes);
    heard.insert(heard.end(), of_rank.begin(), of_rank.end());
  }
  contact_->adopt(heard);
}

void Stepper::gather_proxies() {
  if (!near_) return;
  const auto lap = timer_.measure(Phase::communication);
  communicator_.set_phase("gather of proxies");
  near_->gather_begin(std::array{state_.next_position.data(), state_.velocity.data()});
  near_->gather_end();
}

}  // namespace breccia
