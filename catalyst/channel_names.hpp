#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "catalyst/insitu_abi.h"
#include "catalyst/pipeline_error.hpp"

namespace breccia::insitu {

constexpr std::array<const char*, BRECCIA_NUM_CHANNELS> kChannelNames = BRECCIA_CHANNEL_NAMES;

constexpr std::uint32_t bit(int channel) { return std::uint32_t{1} << channel; }
constexpr std::uint32_t kAllChannels = bit(BRECCIA_NUM_CHANNELS) - 1;

/// Index of a channel's name, or -1.
inline int channel_of(const std::string& name) {
  const auto found = std::find(kChannelNames.begin(), kChannelNames.end(), name);
  return found == kChannelNames.end() ? -1 : static_cast<int>(found - kChannelNames.begin());
}

/// Corners of a cell by BrecciaGrid::cell. Throws PipelineError where there is no such cell.
inline int corners_of(std::int32_t cell) {
  switch (cell) {
    case BRECCIA_VERTEX:
      return 1;
    case BRECCIA_TRIANGLE:
      return 3;
    case BRECCIA_TETRAHEDRON:
      return 4;
    case BRECCIA_HEXAHEDRON:
      return 8;
    default:
      throw PipelineError("unknown kind of cell " + std::to_string(cell));
  }
}

/// Of all components of an array at one of its places.
inline std::size_t bytes_of(const BrecciaArray& array) {
  const std::size_t one = array.type == BRECCIA_I32 ? sizeof(std::int32_t) : sizeof(std::int64_t);
  return one * static_cast<std::size_t>(array.components);
}

}  // namespace breccia::insitu
