#include "parallel/halo.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "parallel/exchange_schedule.hpp"
#include "parallel/mpi_handle.hpp"

namespace breccia {

class Halo::Messages {
 public:
  std::vector<std::vector<double>> outgoing, incoming;  ///< values by neighbour
  std::vector<MPI_Request> receives, sends;             ///< by neighbour
  std::vector<int> ranks;                               ///< of the neighbours
};

Halo::Halo(const Communicator& communicator, std::vector<HaloNeighbour> neighbours, std::size_t fields,
           ExchangeKind kind)
    : communicator_(communicator),
      kind_(kind),
      neighbours_(std::move(neighbours)),
      fields_(fields),
      messages_(std::make_unique<Messages>()) {
  DEMAND(neighbours_.empty() || communicator_.handle(), "a rank that is alone has no neighbours");
  if (kind_ == ExchangeKind::pairwise) order_by_couples();
  for (const HaloNeighbour& n : neighbours_) {
    const std::size_t outgoing = 3 * (n.send.size() * fields + n.send_first.size());
    const std::size_t incoming = 3 * (n.receive.size() * fields + n.receive_first.size());
    DEMAND(std::max(outgoing, incoming) <= static_cast<std::size_t>(std::numeric_limits<int>::max()),
           std::to_string(std::max(outgoing, incoming)) + " values in a message");
    messages_->outgoing.emplace_back(outgoing);
    messages_->incoming.emplace_back(incoming);
    messages_->ranks.push_back(n.rank);
  }
  messages_->receives.assign(neighbours_.size(), MPI_REQUEST_NULL);
  messages_->sends.assign(neighbours_.size(), MPI_REQUEST_NULL);
}

Halo::~Halo() {
  // After an error in a gather MPI may still read and write what it has been given.
  const auto is_done = [](MPI_Request request) { return request == MPI_REQUEST_NULL; };
  if (!std::all_of(messages_->receives.begin(), messages_->receives.end(), is_done) || !settled(messages_->sends))
    (void)messages_.release();
}

void Halo::order_by_couples() {
  std::vector<int> mine;
  for (const HaloNeighbour& n : neighbours_) mine.push_back(n.rank);
  const std::vector<std::vector<int>> all = communicator_.all_gather(std::span<const int>(mine));
  std::vector<RankPair> pairs;
  for (int rank = 0; rank < communicator_.size(); ++rank) {
    for (const int other : all[static_cast<std::size_t>(rank)]) {
      pairs.push_back({std::min(rank, other), std::max(rank, other)});
    }
  }
  std::vector<HaloNeighbour> ordered;
  for (const std::vector<RankPair>& step : exchange_schedule(std::move(pairs))) {
    for (const RankPair& pair : step) {
      if (pair.a != communicator_.rank() && pair.b != communicator_.rank()) continue;
      const int other = pair.a == communicator_.rank() ? pair.b : pair.a;
      const auto is_other = [&](const HaloNeighbour& n) { return n.rank == other; };
      const auto found = std::find_if(neighbours_.begin(), neighbours_.end(), is_other);
      if (found != neighbours_.end()) ordered.push_back(std::move(*found));
    }
  }
  neighbours_ = std::move(ordered);
}

void Halo::pack(std::size_t neighbour) {
  double* out = messages_->outgoing[neighbour].data();
  const auto put = [&](const double* node) {
    for (std::size_t i = 0; i < 3; ++i) *out++ = node[i * kHaloStride];
  };
  for (const std::size_t place : neighbours_[neighbour].send) {
    for (const double* field : fields_) put(field + place);
  }
  for (const std::size_t place : neighbours_[neighbour].send_first) put(fields_[0] + place);
}

void Halo::receive(std::size_t neighbour) {
  std::vector<double>& values = messages_->incoming[neighbour];
  if (values.empty()) return;
  check_mpi(MPI_Irecv(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, neighbours_[neighbour].rank,
                      static_cast<int>(Tag::halo), communicator_.handle()->comm, &messages_->receives[neighbour]),
            "MPI_Irecv");
}

void Halo::send(std::size_t neighbour) {
  const std::vector<double>& values = messages_->outgoing[neighbour];
  if (values.empty()) return;
  check_mpi(MPI_Isend(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, neighbours_[neighbour].rank,
                      static_cast<int>(Tag::halo), communicator_.handle()->comm, &messages_->sends[neighbour]),
            "MPI_Isend");
  ++sent_;
  bytes_ += static_cast<std::int64_t>(values.size() * sizeof(double));
}

void Halo::wait(Way way) {
  if (neighbours_.empty()) return;
  const auto start = std::chrono::steady_clock::now();
  wait_for(*communicator_.handle(), way == Way::in ? messages_->receives : messages_->sends, messages_->ranks);
  waiting_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Halo::gather_begin(std::span<double* const> fields) {
  DEMAND(fields.size() == fields_.size(), std::to_string(fields.size()) + " fields");
  wait(Way::out);
  std::copy(fields.begin(), fields.end(), fields_.begin());
  underway_ = kind_ == ExchangeKind::pairwise ? std::min<std::size_t>(neighbours_.size(), 1) : neighbours_.size();
  for (std::size_t n = 0; n < underway_; ++n) receive(n);
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    pack(n);
    if (n < underway_) send(n);
  }
}

void Halo::gather_end() {
  if (neighbours_.empty()) return;
  wait(Way::in);
  while (underway_ < neighbours_.size()) {
    wait(Way::out);
    const std::size_t next = underway_++;  // counted before the wait, which may throw
    receive(next);
    send(next);
    wait(Way::in);
  }
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    const double* in = messages_->incoming[n].data();
    const auto take = [&](double* node) {
      for (std::size_t i = 0; i < 3; ++i) node[i * kHaloStride] = *in++;
    };
    for (const std::size_t place : neighbours_[n].receive) {
      for (double* field : fields_) take(field + place);
    }
    for (const std::size_t place : neighbours_[n].receive_first) take(fields_[0] + place);
  }
}

}  // namespace breccia
