#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "parallel/communicator.hpp"

namespace breccia {

/// What goes to a neighbour and comes from it: places of the first of the three components of a node's vector in a
/// nodal field; the components lie kHaloStride apart (discretisation/blocks.hpp). Both sides list nodes in the same
/// order.
struct HaloNeighbour {
  int rank = 0;
  std::vector<std::size_t> send, receive;
  std::vector<std::size_t> send_first{}, receive_first{};  ///< nodes of which only the first of the fields goes
};

inline constexpr std::size_t kHaloStride = 8;

/// How the messages of a gather go; the values are the same.
enum class ExchangeKind {
  non_blocking,  ///< all at once, underway between begin and end
  pairwise,  ///< couple after couple (parallel/exchange_schedule.hpp): the first between begin and end, the rest in end
};

/// Brings the proxies of a rank up to date: gathers nodal values from their originals on other ranks, one message a
/// neighbour for all fields together. Plan and buffers are made once; a gather allocates nothing.
class Halo {
 public:
  /// Collective. @param neighbours  in any order, each rank at most once
  /// @param fields  number of nodal fields that one gather takes
  Halo(const Communicator& communicator, std::vector<HaloNeighbour> neighbours, std::size_t fields,
       ExchangeKind kind = ExchangeKind::non_blocking);
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;
  ~Halo();

  /// Packs; posts receives before sends. Waits until the neighbours have what was sent last time, which they have
  /// unless they are a whole gather behind. @param fields  (fields of the constructor); a node's values as they are now
  /// are sent
  void gather_begin(std::span<double* const> fields);
  /// Waits for the values and puts them into the fields of gather_begin. Throws NoResponse past the communicator's
  /// patience; may be called again then. What this rank has sent may still be on its way.
  void gather_end();

  [[nodiscard]] std::int64_t messages() const { return sent_; }      ///< sent so far
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }        ///< sent so far
  [[nodiscard]] double seconds_waiting() const { return waiting_; }  ///< for messages so far

 private:
  class Messages;
  void order_by_couples();
  enum class Way { in, out };
  void wait(Way way);
  void pack(std::size_t neighbour);
  void receive(std::size_t neighbour);
  void send(std::size_t neighbour);

  Communicator communicator_;
  ExchangeKind kind_;
  std::vector<HaloNeighbour> neighbours_;  ///< if pairwise, in the order of the couples
  std::vector<double*> fields_;
  std::unique_ptr<Messages> messages_;
  std::size_t underway_ = 0;  ///< pairwise: the first of the neighbours, with whom messages are on their way or here
  std::int64_t sent_ = 0, bytes_ = 0;
  double waiting_ = 0;  ///< s, for values of others and for others to take theirs
};

}  // namespace breccia
