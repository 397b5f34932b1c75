#include "parallel/mpi_session.hpp"

#include <cstdlib>
#include <string_view>

#include "parallel/mpi_handle.hpp"

namespace breccia {
namespace {

bool launched() {
  for (const char* name :
       {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "MPI_LOCALRANKID", "SLURM_PROCID"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

}  // namespace

MpiSession::MpiSession(int& argc, char**& argv) {
  if (!launched()) return;
  // Ranks of one machine communicate by shared memory; Open MPI need not listen to networks then, with any system
  // settings. Its components ofi and uct serve one-sided messages, of which there are none; ofi would read memory that
  // any thread frees, without locks.
  const char *all = std::getenv("OMPI_COMM_WORLD_SIZE"), *here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  const bool one_machine = all != nullptr && here != nullptr && std::string_view(all) == here;
  ::setenv("OMPI_MCA_btl", one_machine ? "^tcp,ofi,uct" : "^ofi,uct", 0);
  if (one_machine) {
    ::setenv("OMPI_MCA_pml", "ob1", 0);
    ::setenv("OMPI_MCA_mtl", "^ofi", 0);
  }
  // Open MPI searches for graphics cards on every X display it can reach, and Xlib ends the process when one closes
  // then.
  ::setenv("HWLOC_COMPONENTS", "-gl", 0);
  int provided = 0;
  check_mpi(MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
  active_ = true;
  world_ = Communicator(std::make_shared<Communicator::Handle>(MPI_COMM_WORLD));
}

MpiSession::~MpiSession() {
  world_ = {};
  if (active_) MPI_Finalize();
}

void MpiSession::abort(int code) {
  if (active_ && world_.size() > 1) MPI_Abort(MPI_COMM_WORLD, code);
}

}  // namespace breccia
