#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "catalyst/insitu_abi.h"

namespace breccia::test {

/// Memory that can be taken away: what reads it between guard and release dies.
class GuardedMemory {
 public:
  explicit GuardedMemory(std::size_t bytes);
  GuardedMemory(const GuardedMemory&) = delete;
  GuardedMemory& operator=(const GuardedMemory&) = delete;
  ~GuardedMemory();
  /// Bytes aligned to 64; nullptr when none are asked for. Throws when there is no room left.
  void* take(std::size_t bytes);
  void take_away() const;
  void give_back() const;

 private:
  char* begin_;
  std::size_t size_;
  std::size_t used_ = 0;
};

/// A block of side^3 cubes of six tetrahedra each, dealt out to ranks in contiguous shares, with all channels of a run.
/// Every value is a function of array, component, cell and step (expected_*), so that a reader can tell what it must
/// find.
class SyntheticRun {
 public:
  /// @param without_cells this rank owns nothing (-1: none such)
  SyntheticRun(int side, int rank, int size, int without_cells = -1);

  /// The state at a step: joints, fractures and contacts are empty at step 0 and change; elements keep their topology.
  /// @param channels mask of those in the instant
  const BrecciaInstant& at(std::int64_t step, std::uint32_t channels);

  [[nodiscard]] static double time_of(std::int64_t step) { return 1e-6 * static_cast<double>(step) / 3.0; }
  [[nodiscard]] static double expected_f64(const std::string& array, int component, std::int64_t cell,
                                           std::int64_t step);
  [[nodiscard]] static std::int64_t expected_integer(const std::string& array, std::int64_t cell, std::int64_t step);

  /// Cells of a channel on all ranks at a step; their "id" (row number of history) counts from 0.
  [[nodiscard]] std::int64_t total(int channel, std::int64_t step) const;

  /// Cells of this rank: [first, end) of those of all ranks.
  struct Share {
    std::int64_t first, end;
  };
  [[nodiscard]] Share share(int channel, std::int64_t step) const;

  void take_away() const { memory_.take_away(); }
  void give_back() const { memory_.give_back(); }

 private:
  struct Channel {
    BrecciaGrid grid{};
    std::int64_t capacity = 0;
    std::vector<BrecciaArray> arrays;
    std::vector<double*> reals;  ///< by array; nullptr where it is of integers
    std::vector<std::int32_t*> shorts;
    std::vector<std::int64_t*> longs;
    double* points = nullptr;
  };

  void prepare(int channel, std::int64_t capacity, std::int32_t cell,
               const std::vector<std::pair<const char*, int>>& arrays);
  void fill(int channel, std::int64_t step);
  void put_point(int channel, std::int64_t cell, int corner, std::int64_t step, double* point) const;

  int side_;
  std::int64_t elements_;  ///< of all ranks
  int rank_;
  int size_;
  int without_cells_;
  GuardedMemory memory_;
  std::deque<Channel> channels_;
  BrecciaInstant instant_{};
};

}  // namespace breccia::test
