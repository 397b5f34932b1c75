#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalyst/insitu_abi.h"
#include "output/frames/frame.hpp"

namespace breccia {

inline constexpr std::array<std::string_view, BRECCIA_NUM_CHANNELS> kChannelNames BRECCIA_CHANNEL_NAMES;

/// Mask of the named channels. @pre all are known
[[nodiscard]] std::uint32_t channel_mask(const std::vector<std::string>& names);

/// The parts of a frame that a set of channels is made of; values at points with BRECCIA_POINT_VALUES.
[[nodiscard]] FrameParts parts_of(std::uint32_t channels);

/// A frame as the channels of the in-situ interface: pointers into it, nothing copied but the broken joints, which are
/// some of the frame's joints, and the row of the history.
class Channels {
 public:
  /// @param columns  of the history, as history_columns gives them; @param row  nothing: there is none on this rank
  /// @pre frame and columns outlive this object
  Channels(const Frame& frame, std::uint32_t mask, const std::vector<std::string>& columns,
           const std::optional<std::vector<double>>& row);
  Channels(const Channels&) = delete;
  Channels& operator=(const Channels&) = delete;

  [[nodiscard]] const BrecciaInstant& instant() const { return instant_; }

 private:
  struct Channel {
    std::vector<BrecciaArray> arrays, point_arrays;
    BrecciaGrid grid{};
  };
  void add(int channel, int32_t cell, const std::vector<double>& points, std::size_t cells,
           std::vector<BrecciaArray> arrays);
  void add_at_points(int channel, const Frame::AtPoints& values);
  void add_joints(int channel, const Frame::Joints& joints);
  void add_history(const std::vector<std::string>& columns, const std::optional<std::vector<double>>& row);

  std::array<Channel, BRECCIA_NUM_CHANNELS> channels_;
  Frame::Joints fractures_;
  std::vector<double> row_;
  BrecciaInstant instant_{};
};

}  // namespace breccia
