#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "simulation/stepper.hpp"

/// The part of Stepper that talks to other ranks.
namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

void Stepper::connect(const Communicator& communicator, const std::vector<SharedElements>& shared, ExchangeKind kind) {
  communicator_ = communicator;
  exchange_ = kind;
  const auto slots = [&](const std::vector<GlobalId>& ids) {
    std::vector<Index> list;
    for (const GlobalId id : ids) list.push_back(model_.local.slot_of_element[at(element_with(id))]);
    return list;
  };
  for (const SharedElements& elements : shared)
    shared_.push_back({elements.rank, slots(elements.send), slots(elements.receive)});
  if (contact_ && contact_->verifies()) all_ = std::make_unique<Halo>(communicator_, halo_plan(shared_), 2, exchange_);
  if (contact_) contact_->restrict_to(relevant_);
  find_joined();
  plan_near();
  reduction_.emplace(communicator, 6);
  begin_reduction();
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

std::vector<HaloNeighbour> Stepper::halo_plan(const std::vector<SharedSlots>& shared) const {
  const LocalMesh& local = model_.local;
  std::vector<Index> listed(at(local.num_nodes), -1);  // the last list a shared node is in: it goes once
  Index number = 0;
  const auto places = [&](const std::vector<Index>& slots) {
    std::vector<std::size_t> list;
    for (const Index slot : slots) {
      for (int c = 0; c < 4; ++c) {
        const Index node = local.corner_node(slot, c);
        if (std::exchange(listed[at(node)], number) != number) list.push_back(nodal(node, 0));
      }
    }
    ++number;
    return list;
  };
  std::vector<HaloNeighbour> plan;
  for (const SharedSlots& slots : shared) {
    plan.push_back({slots.rank, places(slots.send), places(slots.receive), places(slots.send_position),
                    places(slots.receive_position)});
  }
  return plan;
}

void Stepper::find_joined() {
  joined_ = relevant_;
  for (const ModelJoint& joint : model_.joints) {
    const Index a = model_.local.slot_of_element[at(joint.face.a)], b = model_.local.slot_of_element[at(joint.face.b)];
    if (relevant(a) || relevant(b)) joined_[at(a)] = joined_[at(b)] = 1;
  }
}

/// Elements on whose positions the forces computed here depend.
std::vector<std::uint8_t> Stepper::near_slots() const {
  std::vector<std::uint8_t> near = joined_;
  if (contact_) contact_->mark_coupled(near);
  return near;
}

/// Elements on whose velocities they depend as well: those that contact may touch, and of shared nodes (viscosity).
std::vector<std::uint8_t> Stepper::moving_slots() const {
  std::vector<std::uint8_t> moving(relevant_.size(), 0);
  std::fill(moving.begin() + model_.local.num_own_slots, moving.end(), std::uint8_t{1});
  if (contact_) contact_->mark_coupled(moving);
  return moving;
}

const SharedSlots& Stepper::neighbour(int rank) const {
  const auto found = std::find_if(shared_.begin(), shared_.end(), [&](const SharedSlots& s) { return s.rank == rank; });
  DEMAND(found != shared_.end(), "rank " + std::to_string(rank) + " is no neighbour");
  return *found;
}

/// Asks the owners of near proxies for them, by their places among what is shared: the place, or ~place if the position
/// suffices.
void Stepper::plan_near() {
  const std::vector<std::uint8_t> near = near_slots(), moving = moving_slots();
  std::vector<SharedSlots> wanted;
  std::vector<Communicator::ListOf<Index>> lists;
  for (const SharedSlots& shared : shared_) {
    SharedSlots& ask = wanted.emplace_back(shared.rank);
    std::vector<Index>& places = lists.emplace_back(shared.rank).entries;
    for (std::size_t i = 0; i < shared.receive.size(); ++i) {
      const Index slot = shared.receive[i], place = static_cast<Index>(i);
      if (near[at(slot)] == 0) continue;
      (moving[at(slot)] != 0 ? ask.receive : ask.receive_position).push_back(slot);
      places.push_back(moving[at(slot)] != 0 ? place : ~place);
    }
  }
  for (const auto& [rank, places] : communicator_.exchange(lists)) {
    const auto k = static_cast<std::size_t>(&neighbour(rank) - shared_.data());
    for (const Index place : places) {
      (place >= 0 ? wanted[k].send : wanted[k].send_position)
          .push_back(shared_[k].send[at(place >= 0 ? place : ~place)]);
    }
  }
  if (near_) {
    messages_ += near_->messages();
    bytes_ += near_->bytes();
  }
  near_ = std::make_unique<Halo>(communicator_, halo_plan(wanted), 2, exchange_);
  sent_.assign(at(model_.local.num_own_blocks()), 0);
  for (const SharedSlots& shared : wanted) {
    for (const auto* slots : {&shared.send, &shared.send_position}) {
      for (const Index slot : *slots) {
        if (slot < model_.local.num_own_slots) sent_[at(slot / kLanes)] = 1;
      }
    }
  }
  plan_order();
}

std::int64_t Stepper::messages() const {
  return messages_ + (near_ ? near_->messages() : 0) + (all_ ? all_->messages() : 0);
}
std::int64_t Stepper::bytes() const { return bytes_ + (near_ ? near_->bytes() : 0) + (all_ ? all_->bytes() : 0); }

/// What all ranks said in the last step.
void Stepper::finish_reduction() {
  motion_anywhere_ = max_speed_ * dt_before_;
  news_ = !releasing_.empty();
  signals_ = sent_signals_;
  if (!reduction_) return;
  const auto lap = timer_.measure(Phase::communication);
  communicator_.set_phase("reduction of the last step");
  const std::span<const double> largest = reduction_->finish();
  motion_anywhere_ = largest[0] * std::max(dt_before_, dt_earlier_);
  news_ = largest[2] > 0;
  signals_ = {largest[3] > 0, largest[4] > 0, static_cast<std::uint64_t>(largest[5])};
  if (largest[1] > 0) agree_on_failure();
}

void Stepper::agree_on_failure() {
  communicator_.agree([&] {
    if (failure_) throw SimulationError(*failure_);
  });
}

void Stepper::begin_reduction() {
  if (!reduction_) return;
  const auto flag = [](bool value) { return value ? 1.0 : 0.0; };
  reduction_->begin(std::array{max_speed_, flag(failure_.has_value()), flag(!releasing_.empty()),
                               flag(sent_signals_.stop), flag(sent_signals_.broke),
                               static_cast<double>(sent_signals_.orders)});
}

void Stepper::conclude() {
  finish_reduction();
  agree_on_failure();
  reduction_.reset();
}

/// Joints that came apart on any rank in the last step.
void Stepper::receive_releases() {
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

/// Where ranks have to wait for each other they do so here, at the beginning of a step, one wait after the other: what
/// makes one of them late in the rest of it is waited for once.
void Stepper::update_contact() {
  if (!contact_) return;
  bool due = false, meets_others = false;
  communicator_.set_phase("contact search");
  {
    const auto lap = timer_.measure(Phase::search);
    due = contact_->due(state_, motion_anywhere_, communicator_);
  }
  if (reduction_ && (due || all_)) {
    const auto lap = timer_.measure(Phase::communication);
    if (all_) gather(*all_, state_.position);
    if (due) receive_positions(contact_->search_reach(motion_anywhere_));
  }
  {
    const auto lap = timer_.measure(Phase::search);
    // In this order, so that what fracture makes touch is known as such also when nothing has been searched yet.
    if (due) contact_->search(state_, motion_anywhere_, current_);
    if (!freed_.empty()) meets_others = contact_->release_faces(freed_);
  }
  if (reduction_ && (due || news_)) {
    const auto lap = timer_.measure(Phase::communication);
    if (due || communicator_.max(static_cast<std::int64_t>(meets_others)) != 0) {
      exchange_touching();
      plan_near();
      gather(*near_, state_.position);
    }
  }
  contact_->verify(state_);
}

namespace {

struct MovedElement {
  std::int64_t place;  ///< among what is shared
  detection::Corners corners;
};

}  // namespace

/// Every rank tells the others where those of its elements are that have come near to what matters to them.
void Stepper::receive_positions(double distance) {
  const Extent mine = contact_->extent(state_.position);
  const auto extents = communicator_.all_gather(std::span(&mine, 1));
  std::vector<Communicator::ListOf<MovedElement>> lists;
  for (const SharedSlots& shared : shared_) {
    const Extent& theirs = extents[static_cast<std::size_t>(shared.rank)][0];
    std::vector<MovedElement>& moved = lists.emplace_back(shared.rank).entries;
    for (std::size_t i = 0; i < shared.send.size(); ++i) {
      const detection::Corners corners = load_corners(model_.local, state_.position.data(), shared.send[i]);
      if (extent_of(corners).near(theirs, distance)) moved.push_back({static_cast<std::int64_t>(i), corners});
    }
    if (moved.empty()) continue;
    ++messages_;
    bytes_ += static_cast<std::int64_t>(moved.size() * sizeof(MovedElement));
  }
  current_ = relevant_;
  for (const auto& [rank, elements] : communicator_.exchange(lists)) {
    const std::vector<Index>& receive = neighbour(rank).receive;
    for (const MovedElement& element : elements) {
      const Index slot = receive[static_cast<std::size_t>(element.place)];
      for (int c = 0; c < 4; ++c)
        store_node(state_.position.data(), model_.local.corner_node(slot, c),
                   element.corners[static_cast<std::size_t>(c)]);
      current_[at(slot)] = 1;
    }
  }
}

/// Every rank tells its neighbours what the points of their proxies touch.
void Stepper::exchange_touching() {
  std::vector<Communicator::ListOf<CoupleRecord>> lists;
  for (const SharedSlots& shared : shared_) lists.push_back({shared.rank, contact_->touching_of(shared.send)});
  std::vector<CoupleRecord> heard;
  for (const auto& [rank, touching] : communicator_.exchange(lists))
    heard.insert(heard.end(), touching.begin(), touching.end());
  contact_->adopt(heard);
}

void Stepper::send_proxies() {
  const auto lap = timer_.measure(Phase::communication);
  communicator_.set_phase("gather of proxies");
  near_->gather_begin(std::array{state_.next_position.data(), state_.velocity.data()});
}

void Stepper::receive_proxies() {
  if (!near_) return;
  const auto lap = timer_.measure(Phase::communication);
  communicator_.set_phase("gather of proxies");
  near_->gather_end();
}

void Stepper::gather(Halo& halo, Field<double>& position) {
  halo.gather_begin(std::array{position.data(), state_.velocity.data()});
  halo.gather_end();
}

}  // namespace breccia
