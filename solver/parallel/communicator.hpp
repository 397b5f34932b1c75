#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/error.hpp"

namespace breccia {

/// Another rank has not responded for twice the patience: it is stopped, or its machine is. Exit code 2: nothing is
/// wrong with the program.
class NoResponse : public InternalError {
  using InternalError::InternalError;
};

/// A group of ranks that work on one model. Every call is collective and in the same order on all ranks. Without MPI
/// (default constructed) a rank is alone: every call does what it does for one rank. Throws InternalError when MPI
/// reports an error.
class Communicator {
 public:
  Communicator() = default;  ///< alone

  [[nodiscard]] int rank() const;
  [[nodiscard]] int size() const;
  [[nodiscard]] bool is_root() const { return rank() == 0; }

  void barrier() const;
  [[nodiscard]] double min(double value) const;
  [[nodiscard]] double max(double value) const;
  [[nodiscard]] std::int64_t max(std::int64_t value) const;
  [[nodiscard]] std::int64_t sum(std::int64_t value) const;
  /// Element by element. There is no sum of doubles: it would depend on the number of ranks.
  void sum(std::span<std::int64_t> values) const;
  void max(std::span<double> values) const;

  void broadcast(std::vector<std::byte>& bytes) const;  ///< from the root

  /// What each rank gave, by rank, on all ranks. A collective of MPI's for the lengths and one for the lists: not a
  /// message a pair.
  template <class T>
  [[nodiscard]] std::vector<std::vector<T>> all_gather(std::span<const T> mine) const {
    return lists_of<T>(all_gather_bytes(std::as_bytes(mine)));
  }

  /// Bytes for a rank, or from one.
  struct Parcel {
    int rank = 0;
    std::vector<std::byte> bytes;
  };
  /// Anybody to anybody, at most one parcel a pair; who receives need not know who sends. A rank may send to itself.
  /// Returns what was sent here by ascending rank. One all-to-all of counts and a message a parcel.
  [[nodiscard]] std::vector<Parcel> exchange(std::vector<Parcel> parcels) const;

  /// A list for a rank, or from one; of plain numbers, Eigen's small vectors included.
  template <class T>
  struct ListOf {
    int rank = 0;
    std::vector<T> entries;
  };
  /// Likewise with lists; empty ones are not sent.
  template <class T>
  [[nodiscard]] std::vector<ListOf<T>> exchange(const std::vector<ListOf<T>>& lists) const {
    std::vector<Parcel> parcels;
    for (const ListOf<T>& list : lists) {
      const auto bytes = std::as_bytes(std::span(list.entries));
      if (!bytes.empty()) parcels.push_back({list.rank, {bytes.begin(), bytes.end()}});
    }
    std::vector<ListOf<T>> received;
    for (const Parcel& parcel : exchange(std::move(parcels)))
      received.push_back({parcel.rank, list_of<T>(parcel.bytes)});
    return received;
  }

  /// Runs `work` here and everywhere. If it throws on any rank, all ranks throw what the lowest of these threw:
  /// InputError, SimulationError, OutputError, or InternalError for everything else. One small reduction when no rank
  /// throws. A rank that is alone throws what `work` threw.
  void agree(const std::function<void()>& work) const;

  /// Names what the rank is about to do, for the message of a wait that lasts too long.
  void set_phase(const char* phase) const;
  /// Waits longer than this are reported on stderr, waits twice as long end with NoResponse; s. Default 300. After that
  /// error only a pending reduction and a halo may be waited for again; other operations have left MPI with freed
  /// memory: end the process.
  void set_patience(double seconds) const;
  [[nodiscard]] double patience() const;  ///< s; 0 alone

  /// Lets messages that are on their way move on: MPI does so only while it is called.
  void make_progress() const;

  /// For libraries that use MPI themselves: MPI_Comm_c2f; -1 alone.
  [[nodiscard]] int fortran_handle() const;

  class Handle;  ///< what MPI needs; parallel/mpi_handle.hpp
  explicit Communicator(std::shared_ptr<Handle> handle) : handle_(std::move(handle)) {}
  [[nodiscard]] const std::shared_ptr<Handle>& handle() const { return handle_; }

 private:
  [[nodiscard]] std::vector<std::vector<std::byte>> all_gather_bytes(std::span<const std::byte> mine) const;

  template <class T>
  static std::vector<T> list_of(std::span<const std::byte> bytes) {
    static_assert(std::is_standard_layout_v<T> && std::is_trivially_destructible_v<T>);
    std::vector<T> list(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(list.data()), bytes.data(), bytes.size());
    return list;
  }
  template <class T>
  static std::vector<std::vector<T>> lists_of(const std::vector<std::vector<std::byte>>& bytes) {
    std::vector<std::vector<T>> lists;
    lists.reserve(bytes.size());
    for (const std::vector<std::byte>& part : bytes) lists.push_back(list_of<T>(part));
    return lists;
  }

  std::shared_ptr<Handle> handle_;
};

/// A reduction to the largest that begins in one step and is finished in the next, so that no step waits for it.
class PendingReduction {
 public:
  PendingReduction(const Communicator& communicator, std::size_t count);
  PendingReduction(PendingReduction&&) noexcept;
  PendingReduction& operator=(PendingReduction&&) noexcept;
  ~PendingReduction();  ///< waits half a second for what is on its way, then leaves it behind

  /// @param values  (count)
  void begin(std::span<const double> values);
  /// The largest of what all ranks gave to the last begin(), value by value. @pre begun since the last finish
  [[nodiscard]] std::span<const double> finish();

 private:
  class Request;
  std::unique_ptr<Request> request_;
};

}  // namespace breccia
