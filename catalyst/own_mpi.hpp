#pragma once

#include <mpi.h>

#include <cstdlib>

namespace breccia::insitu {

/// MPI for one rank, if the solver runs without and ParaView needs it. Open MPI starts no daemon for it and listens to
/// no network, unless the environment requires it.
class OwnMpi {
 public:
  OwnMpi() {
    ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    ::setenv("OMPI_MCA_pml", "ob1", 0);
    ::setenv("OMPI_MCA_mtl", "^ofi", 0);
    ::setenv("OMPI_MCA_btl", "self", 0);
    for (const char* name : {"OMPI_MCA_oob_tcp_if_include", "PMIX_MCA_ptl_tcp_if_include"}) ::setenv(name, "lo", 0);
    ::setenv("HWLOC_COMPONENTS", "-gl", 0);  // as in solver/parallel/mpi_session.cpp
    MPI_Init(nullptr, nullptr);
  }
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
