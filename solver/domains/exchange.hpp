#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contact/contact_search.hpp"
#include "discretisation/nodal_state.hpp"
#include "domains/decomposition.hpp"
#include "model/model.hpp"
#include "parallel/communicator.hpp"
#include "parallel/halo.hpp"
#include "state/state.hpp"

namespace breccia {

/// Another rank that has originals of this one as proxies or the other way round, by slots of this rank; both sides
/// list the same elements in the same order.
struct SharedSlots {
  int rank = 0;
  std::vector<Index> send;                                 ///< originals that are proxies there
  std::vector<Index> receive;                              ///< proxies whose originals are there
  std::vector<Index> send_position{}, receive_position{};  ///< without their velocities
};

/// @param mesh, local  the rank's piece
[[nodiscard]] std::vector<SharedSlots> shared_slots(const std::vector<SharedElements>& shared, const Mesh& mesh,
                                                    const LocalMesh& local);

/// All that a step exchanges with other ranks: one reduction, finished a step later, and one message to each neighbour
/// with the proxies that its forces depend on. On one rank there is nothing to exchange: `alone()`.
///
/// Of its proxies only the near ones are gathered in every step: those that share a joint or a couple with an original,
/// the former without velocities. Before a search the proxies near to the originals of the rank are added; after it,
/// and when broken joints bring elements of two ranks into couples, ranks exchange what the points of their elements
/// touch. All functions are collective unless stated otherwise.
class Exchange {
 public:
  Exchange() = default;  ///< alone
  /// @param shared  with every neighbour, ascending ranks;  @param verify  every step brings all proxies up to date
  void connect(const Communicator& communicator, const Model& model, std::vector<SharedSlots> shared, ExchangeKind kind,
               bool verify);

  [[nodiscard]] bool alone() const { return !reduction_; }
  [[nodiscard]] const Communicator& communicator() const { return communicator_; }
  [[nodiscard]] const std::vector<SharedSlots>& shared() const { return shared_; }

  /// Sends what is in `signals` of this rank. Alone: nothing.
  void begin_reduction(const Clock& clock, const Signals& signals);
  /// Receives what all ranks sent: sets `received`, `released`, `motion`, `fastest` and, if a rank has failed, throws
  /// its error on all of them.
  void finish_reduction(const Clock& clock, Signals& signals);
  /// The last one: after it this rank is alone.
  void conclude(const Clock& clock, Signals& signals);

  /// This rank has failed: alone it throws SimulationError at once, else all ranks throw it in the step after the next
  /// or in agree_on_failure(), whichever is first. Not collective.
  void fail(const std::string& message);
  [[nodiscard]] bool failed() const { return failure_.has_value(); }  ///< this rank, and others do not know yet
  void agree_on_failure() const;

  /// From now on these proxies are gathered. @param near  (slots) 1: wanted;  @param moving  (slots) 1: with velocities
  void plan_near(const LocalMesh& local, std::span<const std::uint8_t> near, std::span<const std::uint8_t> moving);
  /// (own-node blocks) 1: with an element that another rank waits for.
  [[nodiscard]] const std::vector<std::uint8_t>& sent_blocks() const { return sent_; }
  /// Sends near proxies' originals: `position` and velocity as they are now. Nothing alone.
  void begin_gather(Field<double>& position, Field<double>& velocity) const;
  void finish_gather() const;
  /// Largest speed of the proxies that are gathered with their velocities, m/s. Not collective.
  [[nodiscard]] double fastest_received(const Field<double>& velocity) const;
  /// All proxies, where couples are to be verified; else nothing.
  void gather_all(Field<double>& position, Field<double>& velocity) const;
  [[nodiscard]] bool gathers_all() const { return all_ != nullptr; }

  /// Positions of all elements of others that have come within `distance`, m, of `mine`.
  /// @return  (slots) 1: relevant, or received
  [[nodiscard]] std::vector<std::uint8_t> receive_positions(const LocalMesh& local,
                                                            const std::vector<std::uint8_t>& relevant,
                                                            const Extent& mine, double distance,
                                                            Field<double>& position);
  /// What the points of shared elements touch, from the ranks that own them.
  [[nodiscard]] std::vector<CoupleRecord> receive_touching(const ContactSearch& contact) const;

  [[nodiscard]] std::int64_t messages() const;  ///< that gathered this rank's originals so far
  [[nodiscard]] std::int64_t bytes() const;     ///< in them

 private:
  [[nodiscard]] const SharedSlots& neighbour(int rank) const;

  Communicator communicator_;
  std::vector<SharedSlots> shared_;
  ExchangeKind kind_ = ExchangeKind::non_blocking;
  std::unique_ptr<Halo> near_;             ///< proxies that forces here depend on
  std::unique_ptr<Halo> all_;              ///< all of them, to verify couples
  std::vector<std::size_t> moving_;        ///< places of the nodes that near_ gathers with their velocities
  std::vector<std::uint8_t> sent_;         ///< sent_blocks()
  std::int64_t messages_ = 0, bytes_ = 0;  ///< beside those of the present halos
  std::optional<PendingReduction> reduction_;
  std::int64_t begun_after_ = -1;       ///< step whose motion it reduces
  std::optional<std::string> failure_;  ///< of this rank, not received by others yet
};

}  // namespace breccia
