#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "catalyst/insitu_abi.h"
#include "catalyst/ranks.hpp"

namespace breccia::insitu {

/// Instants with the cells of all ranks, on the first one; the others' have none. Cells come in the order of the ranks.
/// The first rank needs memory for all of them: meant for surfaces, joints and contacts.
class GatheredInstant {
 public:
  explicit GatheredInstant(const Ranks& ranks) : ranks_(ranks) {}
  GatheredInstant(const GatheredInstant&) = delete;
  GatheredInstant& operator=(const GatheredInstant&) = delete;

  /// Valid until the next call, and as long as what it is given. Channels must have the same arrays on all ranks.
  /// Collective. Throws PipelineError, on all ranks.
  [[nodiscard]] const BrecciaInstant& of(const BrecciaInstant& mine);

 private:
  struct Channel {
    BrecciaGrid grid{};
    std::vector<BrecciaArray> arrays, point_arrays;
    std::vector<std::vector<std::byte>> values;  ///< of the arrays, then of those at points
    std::vector<double> points;
    std::vector<std::int32_t> corners;
  };
  void gather(const BrecciaGrid& mine, Channel& out) const;
  void gather_arrays(const BrecciaArray* arrays, std::int32_t count, const std::vector<std::int64_t>& entries,
                     std::vector<BrecciaArray>& out, std::vector<std::vector<std::byte>>& values) const;
  /// Appends what the ranks bring, on the first rank. @param counts  by rank, of entries of `size` bytes
  void gather_bytes(const void* mine, std::size_t size, const std::vector<std::int64_t>& counts,
                    std::vector<std::byte>& all) const;

  const Ranks& ranks_;
  std::array<Channel, BRECCIA_NUM_CHANNELS> channels_;
  BrecciaInstant instant_{};
};

}  // namespace breccia::insitu
