#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace breccia::insitu {

/// The ranks of a run: a duplicate of the solver's communicator, or one rank without MPI. Members are collective unless
/// stated otherwise.
class Ranks {
 public:
  /// @param communicator of Fortran (MPI_Comm_c2f), -1: one rank, MPI is not used
  /// @param patience  s; 0: without end
  Ranks(std::int32_t communicator, double patience);
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  ~Ranks();

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] double patience() const { return patience_; }
  [[nodiscard]] bool is_root() const { return rank_ == 0; }
  /// MPI_COMM_NULL: without MPI.
  [[nodiscard]] MPI_Comm communicator() const { return communicator_; }

  /// The text of the lowest rank that brings one, on all ranks; empty: none did. Throws Abandoned with this rank's text
  /// when patience is at an end before all ranks are here.
  [[nodiscard]] std::string agree(const std::string& error) const;
  /// Throws PipelineError(agree(error)) on all ranks when any brings a text.
  void throw_agreed(const std::string& error) const;
  /// The first rank's values on all ranks.
  [[nodiscard]] std::int64_t from_root(std::int64_t value) const;
  /// The values of all ranks, by rank.
  [[nodiscard]] std::vector<std::int64_t> gathered(std::int64_t value) const;
  /// Each value is the least one of all ranks' at its place. Throws Abandoned, as agree does.
  void least(std::vector<std::int64_t>& values) const;
  /// On the first rank each value is the sum of all ranks' at its place. Throws Abandoned, as agree does.
  void sum_on_root(std::vector<double>& values) const;
  /// Text of the lowest rank on the same machine as this one; `text` matters on that rank alone. See
  /// is_first_of_machine.
  [[nodiscard]] std::string from_first_of_machine(const std::string& text) const;
  /// True on the lowest rank of each machine.
  [[nodiscard]] bool is_first_of_machine() const;

 private:
  [[nodiscard]] std::string broadcast(std::string text, int source, MPI_Comm communicator) const;

  void wait(MPI_Request& request, const std::string& error) const;

  double patience_;
  MPI_Comm communicator_ = MPI_COMM_NULL;
  MPI_Comm machine_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace breccia::insitu
