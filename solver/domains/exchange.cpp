#include "domains/exchange.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"

namespace breccia {
namespace {

/// Places of the nodes of the slots in nodal fields.
class NodePlaces {
 public:
  explicit NodePlaces(const LocalMesh& local) : local_(local), listed_(at(local.num_nodes), -1) {}
  /// A shared node is listed once.
  [[nodiscard]] std::vector<std::size_t> of(const std::vector<Index>& slots) {
    std::vector<std::size_t> places;
    for (const Index slot : slots) {
      for (int c = 0; c < 4; ++c) {
        const Index node = local_.corner_node(slot, c);
        if (std::exchange(listed_[at(node)], list_) != list_) places.push_back(nodal(node, 0));
      }
    }
    ++list_;
    return places;
  }

 private:
  const LocalMesh& local_;
  std::vector<Index> listed_;  ///< (nodes) the last list it is in
  Index list_ = 0;
};

std::vector<HaloNeighbour> halo_plan(const LocalMesh& local, const std::vector<SharedSlots>& shared) {
  NodePlaces places(local);
  std::vector<HaloNeighbour> plan;
  for (const SharedSlots& slots : shared) {
    HaloNeighbour& neighbour = plan.emplace_back();
    neighbour.rank = slots.rank;
    neighbour.send = places.of(slots.send);
    neighbour.receive = places.of(slots.receive);
    neighbour.send_first = places.of(slots.send_position);
    neighbour.receive_first = places.of(slots.receive_position);
  }
  return plan;
}

double flag(bool value) { return value ? 1.0 : 0.0; }

}  // namespace

std::vector<SharedSlots> shared_slots(const std::vector<SharedElements>& shared, const Mesh& mesh,
                                      const LocalMesh& local) {
  const auto slots = [&](const std::vector<GlobalId>& ids) {
    std::vector<Index> list;
    list.reserve(ids.size());
    for (const GlobalId id : ids) list.push_back(local.slot_of_element[at(mesh.element_with(id))]);
    return list;
  };
  std::vector<SharedSlots> lists;
  lists.reserve(shared.size());
  for (const SharedElements& elements : shared)
    lists.push_back({elements.rank, slots(elements.send), slots(elements.receive)});
  return lists;
}

void Exchange::connect(const Communicator& communicator, const Model& model, std::vector<SharedSlots> shared,
                       ExchangeKind kind, bool verify) {
  communicator_ = communicator;
  kind_ = kind;
  shared_ = std::move(shared);
  if (verify) all_ = std::make_unique<Halo>(communicator_, halo_plan(model.local, shared_), 2, kind_);
  reduction_.emplace(communicator, 8);
}

void Exchange::begin_reduction(const Clock& clock, const Signals& signals) {
  if (alone()) return;
  begun_after_ = clock.steps - 1;
  reduction_->begin(std::array{signals.max_speed, flag(failed()), flag(!signals.released_here.empty()),
                               flag(signals.sent.stop), flag(signals.sent.broke), flag(signals.sent.checkpoint),
                               flag(signals.sent.writing), static_cast<double>(signals.sent.orders)});
}

void Exchange::finish_reduction(const Clock& clock, Signals& signals) {
  signals.motion = signals.max_speed * clock.dt_before;
  signals.released = !signals.released_here.empty();
  signals.received = signals.sent;
  signals.fastest = signals.max_speed;
  signals.fastest_step = clock.steps - 1;
  if (alone()) return;
  communicator_.set_phase("reduction of the last step");
  const std::span<const double> largest = reduction_->finish();
  const double before_first = clock.steps == 0 ? clock.dt : 0;
  signals.motion = largest[0] * std::max({clock.dt_before, clock.dt_earlier, before_first});
  signals.fastest = largest[0];
  signals.fastest_step = begun_after_;
  signals.released = largest[2] > 0;
  signals.received = {largest[3] > 0, largest[4] > 0, largest[5] > 0, largest[6] > 0,
                      static_cast<std::uint64_t>(largest[7])};
  if (largest[1] > 0) agree_on_failure();
}

void Exchange::conclude(const Clock& clock, Signals& signals) {
  finish_reduction(clock, signals);
  agree_on_failure();
  reduction_.reset();
}

void Exchange::fail(const std::string& message) {
  if (failure_) return;
  failure_ = message;
  if (alone()) throw SimulationError(message);
}

void Exchange::agree_on_failure() const {
  communicator_.agree([&] {
    if (failure_) throw SimulationError(*failure_);
  });
}

const SharedSlots& Exchange::neighbour(int rank) const {
  const auto found = std::find_if(shared_.begin(), shared_.end(), [&](const SharedSlots& s) { return s.rank == rank; });
  DEMAND(found != shared_.end(), "rank " + std::to_string(rank) + " is no neighbour");
  return *found;
}

/// Requests near proxies from their owners, by their places in the shared list: the place, or ~place if the position
/// suffices.
void Exchange::plan_near(const LocalMesh& local, std::span<const std::uint8_t> near,
                         std::span<const std::uint8_t> moving) {
  std::vector<SharedSlots> wanted;
  std::vector<Communicator::ListOf<Index>> lists;
  for (const SharedSlots& shared : shared_) {
    SharedSlots& ask = wanted.emplace_back();
    ask.rank = shared.rank;
    std::vector<Index>& places = lists.emplace_back(Communicator::ListOf<Index>{shared.rank, {}}).entries;
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
  std::vector<HaloNeighbour> plan = halo_plan(local, wanted);
  moving_.clear();
  for (const HaloNeighbour& of_rank : plan)
    moving_.insert(moving_.end(), of_rank.receive.begin(), of_rank.receive.end());
  near_ = std::make_unique<Halo>(communicator_, std::move(plan), 2, kind_);
  sent_.assign(at(local.num_own_blocks()), 0);
  for (const SharedSlots& shared : wanted) {
    for (const auto* slots : {&shared.send, &shared.send_position}) {
      for (const Index slot : *slots) {
        if (slot < local.num_own_slots) sent_[at(slot / kLanes)] = 1;
      }
    }
  }
}

void Exchange::begin_gather(Field<double>& position, Field<double>& velocity) const {
  if (near_) near_->gather_begin(std::array{position.data(), velocity.data()});
}

void Exchange::finish_gather() const {
  if (near_) near_->gather_end();
}

double Exchange::fastest_received(const Field<double>& velocity) const {
  double largest = 0;
  for (const std::size_t place : moving_) {
    const double *v = velocity.data() + place, y = v[kHaloStride], z = v[2 * kHaloStride];
    largest = std::max(largest, v[0] * v[0] + y * y + z * z);
  }
  return std::sqrt(largest);
}

void Exchange::gather_all(Field<double>& position, Field<double>& velocity) const {
  if (!all_) return;
  all_->gather_begin(std::array{position.data(), velocity.data()});
  all_->gather_end();
}

std::int64_t Exchange::messages() const {
  return messages_ + (near_ ? near_->messages() : 0) + (all_ ? all_->messages() : 0);
}
std::int64_t Exchange::bytes() const { return bytes_ + (near_ ? near_->bytes() : 0) + (all_ ? all_->bytes() : 0); }

namespace {

struct MovedElement {
  std::int64_t place;  ///< among what is shared
  detection::Corners corners;
};

}  // namespace

/// Every rank sends the others those of its elements that have come near to theirs.
std::vector<std::uint8_t> Exchange::receive_positions(const LocalMesh& local, const std::vector<std::uint8_t>& relevant,
                                                      const Extent& mine, double distance, Field<double>& position) {
  const auto extents = communicator_.all_gather(std::span(&mine, 1));
  std::vector<Communicator::ListOf<MovedElement>> lists;
  for (const SharedSlots& shared : shared_) {
    const Extent& theirs = extents[static_cast<std::size_t>(shared.rank)][0];
    std::vector<MovedElement>& moved = lists.emplace_back(Communicator::ListOf<MovedElement>{shared.rank, {}}).entries;
    for (std::size_t i = 0; i < shared.send.size(); ++i) {
      const detection::Corners corners = load_corners(local, position.data(), shared.send[i]);
      if (extent_of(corners).near(theirs, distance)) moved.push_back({static_cast<std::int64_t>(i), corners});
    }
    if (moved.empty()) continue;
    ++messages_;
    bytes_ += static_cast<std::int64_t>(moved.size() * sizeof(MovedElement));
  }
  std::vector<std::uint8_t> current = relevant;
  for (const auto& [rank, elements] : communicator_.exchange(lists)) {
    const std::vector<Index>& receive = neighbour(rank).receive;
    for (const MovedElement& element : elements) {
      const Index slot = receive[static_cast<std::size_t>(element.place)];
      for (int c = 0; c < 4; ++c)
        store_node(position.data(), local.corner_node(slot, c), element.corners[static_cast<std::size_t>(c)]);
      current[at(slot)] = 1;
    }
  }
  return current;
}

std::vector<CoupleRecord> Exchange::receive_touching(const ContactSearch& contact) const {
  std::vector<Communicator::ListOf<CoupleRecord>> lists;
  for (const SharedSlots& shared : shared_) lists.push_back({shared.rank, contact.touching_of(shared.send)});
  std::vector<CoupleRecord> received;
  for (const auto& [rank, touching] : communicator_.exchange(lists))
    received.insert(received.end(), touching.begin(), touching.end());
  return received;
}

}  // namespace breccia
