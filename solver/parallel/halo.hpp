#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "parallel/communicator.hpp"

namespace breccia {

/// What goes to a neighbour and comes from it: places of the first of the three components of a node's vector in a nodal
/// field; the components lie kHaloStride apart (state/blocks.hpp). Both sides list nodes in the same order.
struct HaloNeighbour {
  int rank = 0;
  std::vector<std::size_t> send, receive;
};

inline constexpr std::size_t kHaloStride = 8;

/// Brings the proxies of a rank up to date: gathers nodal values from their originals on other ranks, one message a neighbour
/// for all fields together. Plan and buffers are made once; a gather allocates nothing.
class Halo {
 public:
  /// Collective. @param neighbours  in any order, each rank at most once
  /// @param fields  number of nodal fields that one gather takes
  Halo(const Communicator& communicator, std::vector<HaloNeighbour> neighbours, std::size_t fields);
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;
  ~Halo();

  /// Posts the receives, then packs and sends. @param fields  the same number as ever
  void gather_begin(std::span<double* const> fields);
  /// Waits for the values and puts them into the fields of gather_begin.
  void gather_end();

  [[nodiscard]] std::int64_t messages() const { return messages_; }   ///< sent so far
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }         ///< sent so far

 private:
  class Requests;
  Communicator communicator_;
  std::vector<HaloNeighbour> neighbours_;
  std::vector<std::vector<double>> outgoing_, incoming_;  ///< by neighbour
  std::vector<double*> fields_;
  std::unique_ptr<Requests> requests_;
  std::int64_t messages_ = 0, bytes_ = 0;
};

}  // namespace breccia
