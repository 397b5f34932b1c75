#include "parallel/communicator.hpp"

#include <sched.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>

#include "base/error.hpp"
#include "parallel/mpi_handle.hpp"

namespace breccia {
namespace {

/// Sum, smallest or largest over all ranks, in place.
template <class T>
void reduce(const std::shared_ptr<Communicator::Handle>& handle, T* values, std::size_t count, MPI_Datatype type,
            MPI_Op op) {
  if (!handle) return;
  DEMAND(count <= static_cast<std::size_t>(std::numeric_limits<int>::max()), std::to_string(count) + " values");
  MPI_Request request;
  check_mpi(MPI_Iallreduce(MPI_IN_PLACE, values, static_cast<int>(count), type, op, handle->comm, &request),
            "MPI_Iallreduce");
  const int everybody = -1;
  wait_for(*handle, std::span(&request, 1), std::span(&everybody, 1));
}

template <class T>
T reduced(const std::shared_ptr<Communicator::Handle>& handle, T value, MPI_Datatype type, MPI_Op op) {
  reduce(handle, &value, 1, type, op);
  return value;
}

/// The pieces of a message.
std::vector<std::span<std::byte>> pieces(std::span<std::byte> bytes, std::size_t largest) {
  std::vector<std::span<std::byte>> parts;
  for (std::size_t at = 0; at < bytes.size(); at += largest) {
    parts.push_back(bytes.subspan(at, std::min(largest, bytes.size() - at)));
  }
  return parts;
}

std::string ranks_text(std::span<const MPI_Request> requests, std::span<const int> ranks) {
  std::string text;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (requests[i] == MPI_REQUEST_NULL) continue;
    if (ranks[i] < 0) return "all others";
    text += (text.empty() ? "rank " : ", ") + std::to_string(ranks[i]);
  }
  return text;
}

}  // namespace

Communicator::Handle::Handle(MPI_Comm of) {
  check_mpi(MPI_Comm_dup(of, &comm), "MPI_Comm_dup");
  check_mpi(MPI_Comm_set_errhandler(comm, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  check_mpi(MPI_Comm_rank(comm, &rank), "MPI_Comm_rank");
  check_mpi(MPI_Comm_size(comm, &size), "MPI_Comm_size");
}

Communicator::Handle::~Handle() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized == 0) MPI_Comm_free(&comm);
}

void check_mpi(int result, const char* call) {
  if (result == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(result, text, &length);
  throw InternalError(std::string(call) + ": " + text);
}

void wait_for(const Communicator::Handle& handle, std::span<MPI_Request> requests, std::span<const int> ranks) {
  using Clock = std::chrono::steady_clock;
  constexpr int kSpins = 2000;
  int done = 0;
  for (int spin = 0; spin < kSpins && done == 0; ++spin) {
    check_mpi(MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE),
              "MPI_Testall");
  }
  // A longer gap between two polls is of a process that was stopped, with its job or by suspension of the machine.
  constexpr double kLongestGap = 1;  // s
  Clock::time_point before = Clock::now();
  double waited = 0;
  bool told = false;
  while (done == 0) {
    sched_yield();
    check_mpi(MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE),
              "MPI_Testall");
    const Clock::time_point now = Clock::now();
    waited += std::min(std::chrono::duration<double>(now - before).count(), kLongestGap);
    before = now;
    if (done != 0 || waited < handle.patience) continue;
    const std::string text = "rank " + std::to_string(handle.rank) + " has waited " +
                             std::to_string(static_cast<long>(waited)) + " s for " + ranks_text(requests, ranks) +
                             " in phase \"" + handle.phase + "\"";
    if (!told) std::fprintf(stderr, "breccia: %s\n", text.c_str());
    told = true;
    if (waited > 2 * handle.patience)
      throw NoResponse(text + ": it does not respond; allowed: up to twice domains.patience");
  }
}

bool settled(std::span<MPI_Request> requests) {
  constexpr std::chrono::milliseconds kPatience(500);
  const auto is_null = [](MPI_Request request) { return request == MPI_REQUEST_NULL; };
  if (std::all_of(requests.begin(), requests.end(), is_null)) return true;  // also when there is no MPI
  const auto end = std::chrono::steady_clock::now() + kPatience;
  int done = 0;
  while (MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE) == MPI_SUCCESS &&
         done == 0 && std::chrono::steady_clock::now() < end) {
    sched_yield();
  }
  return done != 0;
}

int Communicator::rank() const { return handle_ ? handle_->rank : 0; }
int Communicator::size() const { return handle_ ? handle_->size : 1; }

void Communicator::set_phase(const char* phase) const {
  if (handle_) handle_->phase = phase;
}

void Communicator::set_patience(double seconds) const {
  if (handle_) handle_->patience = seconds;
}

double Communicator::patience() const { return handle_ ? handle_->patience : 0.0; }

void Communicator::make_progress() const {
  int found = 0;
  if (handle_)
    check_mpi(MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, handle_->comm, &found, MPI_STATUS_IGNORE), "MPI_Iprobe");
}

int Communicator::fortran_handle() const { return handle_ ? static_cast<int>(MPI_Comm_c2f(handle_->comm)) : -1; }

void Communicator::barrier() const { (void)sum(std::int64_t{0}); }

double Communicator::min(double value) const { return reduced(handle_, value, MPI_DOUBLE, MPI_MIN); }
double Communicator::max(double value) const { return reduced(handle_, value, MPI_DOUBLE, MPI_MAX); }
std::int64_t Communicator::max(std::int64_t value) const { return reduced(handle_, value, MPI_INT64_T, MPI_MAX); }
std::int64_t Communicator::sum(std::int64_t value) const { return reduced(handle_, value, MPI_INT64_T, MPI_SUM); }

void Communicator::sum(std::span<std::int64_t> values) const {
  reduce(handle_, values.data(), values.size(), MPI_INT64_T, MPI_SUM);
}

void Communicator::max(std::span<double> values) const {
  reduce(handle_, values.data(), values.size(), MPI_DOUBLE, MPI_MAX);
}

void Communicator::broadcast(std::vector<std::byte>& bytes) const {
  if (!handle_) return;
  const auto send = [&](std::span<std::byte> piece) {
    MPI_Request request;
    check_mpi(MPI_Ibcast(piece.data(), static_cast<int>(piece.size()), MPI_BYTE, 0, handle_->comm, &request),
              "MPI_Ibcast");
    const int awaited = is_root() ? -1 : 0;
    wait_for(*handle_, std::span(&request, 1), std::span(&awaited, 1));
  };
  auto length = static_cast<std::int64_t>(bytes.size());
  send(std::as_writable_bytes(std::span(&length, 1)));
  bytes.resize(static_cast<std::size_t>(length));
  for (const std::span<std::byte> piece : pieces(bytes, handle_->largest_message)) send(piece);
}

std::vector<std::vector<std::byte>> Communicator::all_gather_bytes(std::span<const std::byte> mine) const {
  if (!handle_) return {{mine.begin(), mine.end()}};
  const auto ranks = static_cast<std::size_t>(size());
  const int everybody = -1;
  const auto finished = [&](MPI_Request request) {
    wait_for(*handle_, std::span(&request, 1), std::span(&everybody, 1));
  };
  MPI_Request request;
  std::vector<std::int64_t> lengths(ranks);
  const auto length = static_cast<std::int64_t>(mine.size());
  check_mpi(MPI_Iallgather(&length, 1, MPI_INT64_T, lengths.data(), 1, MPI_INT64_T, handle_->comm, &request),
            "MPI_Iallgather");
  finished(request);

  std::vector<std::vector<std::byte>> lists(ranks);
  for (std::size_t r = 0; r < ranks; ++r) lists[r].resize(static_cast<std::size_t>(lengths[r]));
  // MPI counts and places by int: in rounds, of each of which all ranks' shares fit into one message.
  const std::int64_t longest = *std::max_element(lengths.begin(), lengths.end());
  const auto share = static_cast<std::int64_t>(std::max<std::size_t>(1, handle_->largest_message / ranks));
  std::vector<int> counts(ranks), places(ranks);
  std::vector<std::byte> round;
  for (std::int64_t done = 0; done < longest; done += share) {
    const auto count_of = [&](std::int64_t whole) {
      return static_cast<int>(std::clamp<std::int64_t>(whole - done, 0, share));
    };
    for (std::size_t r = 0; r < ranks; ++r) {
      counts[r] = count_of(lengths[r]);
      places[r] = r == 0 ? 0 : places[r - 1] + counts[r - 1];
    }
    round.resize(static_cast<std::size_t>(places.back()) + static_cast<std::size_t>(counts.back()));
    check_mpi(MPI_Iallgatherv(mine.data() + std::min(done, length), count_of(length), MPI_BYTE, round.data(),
                              counts.data(), places.data(), MPI_BYTE, handle_->comm, &request),
              "MPI_Iallgatherv");
    finished(request);
    for (std::size_t r = 0; r < ranks; ++r)
      std::copy_n(round.begin() + places[r], counts[r], lists[r].begin() + std::min(done, lengths[r]));
  }
  return lists;
}

std::vector<Communicator::Parcel> Communicator::exchange(std::vector<Parcel> parcels) const {
  const auto by_rank = [](const Parcel& a, const Parcel& b) { return a.rank < b.rank; };
  std::sort(parcels.begin(), parcels.end(), by_rank);
  if (!handle_) return parcels;
  constexpr std::int64_t kNone = -1;
  const auto ranks = static_cast<std::size_t>(size());
  std::vector<std::int64_t> give(ranks, kNone), get(ranks, kNone);
  for (const Parcel& parcel : parcels) {
    std::int64_t& length = give.at(static_cast<std::size_t>(parcel.rank));
    DEMAND(length == kNone, "two parcels for rank " + std::to_string(parcel.rank));
    length = static_cast<std::int64_t>(parcel.bytes.size());
  }
  MPI_Request counts;
  check_mpi(MPI_Ialltoall(give.data(), 1, MPI_INT64_T, get.data(), 1, MPI_INT64_T, handle_->comm, &counts),
            "MPI_Ialltoall");
  const int everybody = -1;
  wait_for(*handle_, std::span(&counts, 1), std::span(&everybody, 1));

  std::vector<Parcel> received;
  std::vector<MPI_Request> requests;
  std::vector<int> partners;
  for (int r = 0; r < size(); ++r) {
    const std::int64_t length = get[static_cast<std::size_t>(r)];
    if (length == kNone) continue;
    received.push_back({r, std::vector<std::byte>(static_cast<std::size_t>(length))});
  }
  const auto post = [&](auto&& start, auto&& piece, int partner) {
    requests.emplace_back();
    partners.push_back(partner);
    check_mpi(start(piece.data(), static_cast<int>(piece.size()), MPI_BYTE, partner, static_cast<int>(Tag::parcel),
                    handle_->comm, &requests.back()),
              "MPI_Isend or MPI_Irecv");
  };
  for (Parcel& parcel : received) {
    if (parcel.rank == rank()) continue;
    for (const auto& piece : pieces(std::span(parcel.bytes), handle_->largest_message)) {
      post(MPI_Irecv, piece, parcel.rank);
    }
  }
  for (Parcel& parcel : parcels) {
    if (parcel.rank == rank()) {
      std::find_if(received.begin(), received.end(), [&](const Parcel& p) { return p.rank == rank(); })->bytes =
          std::move(parcel.bytes);
      continue;
    }
    for (const auto& piece : pieces(std::span(parcel.bytes), handle_->largest_message)) {
      post(MPI_Isend, piece, parcel.rank);
    }
  }
  wait_for(*handle_, requests, partners);
  return received;
}

// --- PendingReduction
// -----------------------------------------------------------------------------------------------------------

class PendingReduction::Request {
 public:
  Request(std::shared_ptr<Communicator::Handle> handle, std::size_t count)
      : handle_(std::move(handle)), mine_(count), all_(count) {}
  Request(const Request&) = delete;
  Request& operator=(const Request&) = delete;
  ~Request() = default;
  [[nodiscard]] bool is_settled() { return settled(std::span(&request_, 1)); }

  void begin(std::span<const double> values) {
    std::copy(values.begin(), values.end(), mine_.begin());
    if (!handle_) {
      all_ = mine_;
      return;
    }
    check_mpi(MPI_Iallreduce(mine_.data(), all_.data(), static_cast<int>(mine_.size()), MPI_DOUBLE, MPI_MAX,
                             handle_->comm, &request_),
              "MPI_Iallreduce");
  }
  std::span<const double> finish() {
    const int everybody = -1;
    if (handle_) wait_for(*handle_, std::span(&request_, 1), std::span(&everybody, 1));
    return all_;
  }

 private:
  std::shared_ptr<Communicator::Handle> handle_;
  std::vector<double> mine_, all_;
  MPI_Request request_ = MPI_REQUEST_NULL;
};

PendingReduction::PendingReduction(const Communicator& communicator, std::size_t count)
    : request_(std::make_unique<Request>(communicator.handle(), count)) {}
PendingReduction::PendingReduction(PendingReduction&&) noexcept = default;
PendingReduction& PendingReduction::operator=(PendingReduction&& other) noexcept {
  std::swap(request_, other.request_);  // a pending request is completed by the other
  return *this;
}

PendingReduction::~PendingReduction() {
  // An error that others do not know of must not wait for them; MPI may still write into what it has been given.
  if (request_ && !request_->is_settled()) (void)request_.release();
}

void PendingReduction::begin(std::span<const double> values) { request_->begin(values); }
std::span<const double> PendingReduction::finish() { return request_->finish(); }

}  // namespace breccia
