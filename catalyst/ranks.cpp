#include "catalyst/ranks.hpp"

#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "catalyst/pipeline_error.hpp"

namespace breccia::insitu {

Ranks::Ranks(std::int32_t communicator, double patience) : patience_(patience) {
  if (communicator == -1) return;
  MPI_Comm_dup(MPI_Comm_f2c(communicator), &communicator_);
  MPI_Comm_rank(communicator_, &rank_);
  MPI_Comm_size(communicator_, &size_);
  MPI_Comm_split_type(communicator_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine_);
}

Ranks::~Ranks() {
  if (communicator_ == MPI_COMM_NULL) return;
  MPI_Comm_free(&machine_);
  MPI_Comm_free(&communicator_);
}

std::string Ranks::broadcast(std::string text, int source, MPI_Comm communicator) const {
  if (communicator == MPI_COMM_NULL) return text;
  auto length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, source, communicator);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, source, communicator);
  return text;
}

std::string Ranks::agree(const std::string& error) const {
  if (size_ == 1) return error;
  const int mine = error.empty() ? size_ : rank_;
  int lowest = size_;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, communicator_, &request);
  wait(request, error);
  return lowest == size_ ? std::string() : broadcast(error, lowest, communicator_);
}

void Ranks::wait(MPI_Request& request, const std::string& error) const {
  using Clock = std::chrono::steady_clock;
  constexpr double kLongestGap = 1;  // s between two polls; a longer one is of a process that was stopped, not waiting
  double waited = 0;
  Clock::time_point before = Clock::now();
  int done = 0;
  for (MPI_Test(&request, &done, MPI_STATUS_IGNORE); done == 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE)) {
    sched_yield();
    const Clock::time_point now = Clock::now();
    waited += std::min(std::chrono::duration<double>(now - before).count(), kLongestGap);
    before = now;
    if (patience_ <= 0 || waited < patience_) continue;
    const std::string what = "rank " + std::to_string(rank_) + " has waited " + std::to_string(std::lround(waited)) +
                             " s for others that are still in it";
    throw Abandoned(error.empty() ? what : what + "; here it failed: " + error);
  }
}

void Ranks::throw_agreed(const std::string& error) const {
  if (const std::string text = agree(error); !text.empty()) throw PipelineError(text);
}

std::int64_t Ranks::from_root(std::int64_t value) const {
  if (size_ > 1) MPI_Bcast(&value, 1, MPI_INT64_T, 0, communicator_);
  return value;
}

std::vector<std::int64_t> Ranks::gathered(std::int64_t value) const {
  std::vector<std::int64_t> values(static_cast<std::size_t>(size_), value);
  if (size_ > 1) MPI_Allgather(&value, 1, MPI_INT64_T, values.data(), 1, MPI_INT64_T, communicator_);
  return values;
}

void Ranks::least(std::vector<std::int64_t>& values) const {
  if (size_ == 1) return;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_INT64_T, MPI_MIN, communicator_,
                 &request);
  wait(request, {});
}

void Ranks::sum_on_root(std::vector<double>& values) const {
  if (size_ == 1) return;
  const std::vector<double> mine = values;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ireduce(mine.data(), values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, 0, communicator_,
              &request);
  wait(request, {});
}

std::string Ranks::from_first_of_machine(const std::string& text) const { return broadcast(text, 0, machine_); }

bool Ranks::is_first_of_machine() const {
  if (machine_ == MPI_COMM_NULL) return true;
  int rank = 0;
  MPI_Comm_rank(machine_, &rank);
  return rank == 0;
}

}  // namespace breccia::insitu
