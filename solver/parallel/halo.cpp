#include "parallel/halo.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "parallel/mpi_handle.hpp"

namespace breccia {

class Halo::Requests {
 public:
  std::vector<MPI_Request> list;  ///< receives, then sends, by neighbour
  std::vector<int> ranks;         ///< of the list's entries
};

Halo::Halo(const Communicator& communicator, std::vector<HaloNeighbour> neighbours, std::size_t fields)
    : communicator_(communicator), neighbours_(std::move(neighbours)), fields_(fields), requests_(std::make_unique<Requests>()) {
  for (const HaloNeighbour& n : neighbours_) {
    const std::size_t most = std::max(n.send.size(), n.receive.size()) * 3 * fields;
    DEMAND(most <= static_cast<std::size_t>(std::numeric_limits<int>::max()), std::to_string(most) + " values in a message");
    outgoing_.emplace_back(n.send.size() * 3 * fields);
    incoming_.emplace_back(n.receive.size() * 3 * fields);
  }
  DEMAND(neighbours_.empty() || communicator_.handle(), "a rank that is alone has no neighbours");
  requests_->list.assign(2 * neighbours_.size(), MPI_REQUEST_NULL);
  for (int side = 0; side < 2; ++side) {
    for (const HaloNeighbour& n : neighbours_) requests_->ranks.push_back(n.rank);
  }
}

Halo::~Halo() = default;

void Halo::gather_begin(std::span<double* const> fields) {
  DEMAND(fields.size() == fields_.size(), std::to_string(fields.size()) + " fields");
  std::copy(fields.begin(), fields.end(), fields_.begin());
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    if (incoming_[n].empty()) continue;
    check_mpi(MPI_Irecv(incoming_[n].data(), static_cast<int>(incoming_[n].size()), MPI_DOUBLE, neighbours_[n].rank,
                        static_cast<int>(Tag::halo), communicator_.handle()->comm, &requests_->list[n]),
              "MPI_Irecv");
  }
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    if (outgoing_[n].empty()) continue;
    double* out = outgoing_[n].data();
    for (const std::size_t place : neighbours_[n].send) {
      for (const double* field : fields_) {
        for (std::size_t i = 0; i < 3; ++i) *out++ = field[place + i * kHaloStride];
      }
    }
    check_mpi(MPI_Isend(outgoing_[n].data(), static_cast<int>(outgoing_[n].size()), MPI_DOUBLE, neighbours_[n].rank,
                        static_cast<int>(Tag::halo), communicator_.handle()->comm, &requests_->list[neighbours_.size() + n]),
              "MPI_Isend");
    ++messages_;
    bytes_ += static_cast<std::int64_t>(outgoing_[n].size() * sizeof(double));
  }
}

void Halo::gather_end() {
  if (neighbours_.empty()) return;
  wait_for(*communicator_.handle(), requests_->list, requests_->ranks);
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    const double* in = incoming_[n].data();
    for (const std::size_t place : neighbours_[n].receive) {
      for (double* field : fields_) {
        for (std::size_t i = 0; i < 3; ++i) field[place + i * kHaloStride] = *in++;
      }
    }
  }
}

}  // namespace breccia
