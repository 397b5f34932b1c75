#pragma once

#include "parallel/communicator.hpp"

namespace breccia {

/// MPI from its beginning to its end; one in main. A process that no launcher has started does not begin it at all: it
/// is alone, and saves the start of a daemon.
class MpiSession {
 public:
  MpiSession(int& argc, char**& argv);
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  ~MpiSession();

  /// All ranks that the launcher has started.
  [[nodiscard]] const Communicator& world() const { return world_; }
  /// Ends all ranks at once with an exit code: for errors that only this rank knows of.
  void abort(int code);

 private:
  bool active_ = false;
  Communicator world_;
};

}  // namespace breccia
