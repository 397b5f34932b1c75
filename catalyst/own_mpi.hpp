#pragma once

#include <mpi.h>

namespace breccia::insitu {

/// MPI for one rank, where the solver runs without and ParaView needs it.
class OwnMpi {
 public:
  OwnMpi() { MPI_Init(nullptr, nullptr); }
  OwnMpi(const OwnMpi&) = delete;
  OwnMpi& operator=(const OwnMpi&) = delete;
  ~OwnMpi() { MPI_Finalize(); }

  [[nodiscard]] static bool is_started() {
    int started = 0;
    MPI_Initialized(&started);
    return started != 0;
  }
};

}  // namespace breccia::insitu
