#pragma once

#include <mpi.h>

#include <span>

#include "parallel/communicator.hpp"

namespace breccia {

/// A duplicate of the communicator it was made of, freed at the end. For parallel/*.cpp.
class Communicator::Handle {
 public:
  explicit Handle(MPI_Comm of);
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle();

  MPI_Comm comm = MPI_COMM_NULL;
  int rank = 0, size = 1;
  const char* phase = "";
  double patience = 300;                               ///< s
  std::size_t largest_message = std::size_t{1} << 30;  ///< bytes; longer ones go in pieces. MPI counts by int
};

/// All messages between ranks, so that no two kinds are mistaken for each other.
enum class Tag : int { parcel = 1, halo = 2 };

/// Throws InternalError with MPI's own text unless the call succeeded.
void check_mpi(int result, const char* call);

/// Waits for all requests by polling, so that more ranks than cores share them; past the patience reports on stderr the
/// rank it waits for and the phase, past twice the patience throws NoResponse. Requests are then still pending: their
/// buffers must outlive them or the process must end.
/// @param ranks  rank that each request waits for, -1: all
void wait_for(const Communicator::Handle& handle, std::span<MPI_Request> requests, std::span<const int> ranks);

/// Waits half a second at most, for the end of what may have failed elsewhere. Whether nothing is on its way any more.
[[nodiscard]] bool settled(std::span<MPI_Request> requests);

}  // namespace breccia
