#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "catalyst/insitu_abi.h"

namespace breccia::insitu {

/// The cells and arrays that a pipeline gets of each channel.
struct Selection {
  std::optional<std::array<double, 6>> region;  ///< lower and upper corner, m: centres of cells lie within
  std::vector<std::string> fields;              ///< empty: all
  std::vector<std::string> point_fields;        ///< values at points, of elements and surface; empty: none

  /// Of the cells and their arrays all, and nothing at points.
  [[nodiscard]] bool is_all() const { return !region && fields.empty() && point_fields.empty(); }
};

/// Instants as a pipeline with a selection gets them. Arrays are left out without copying; the cells of a region are
/// copied, with points of their own. Tables stay as they are.
class SelectedInstant {
 public:
  explicit SelectedInstant(Selection selection) : selection_(std::move(selection)) {}
  SelectedInstant(const SelectedInstant&) = delete;
  SelectedInstant& operator=(const SelectedInstant&) = delete;

  /// Valid until the next call, and as long as what it is given. O(cells). Throws PipelineError on cells of no known
  /// kind, and where elements or surface lack a value at points.
  [[nodiscard]] const BrecciaInstant& of(const BrecciaInstant& whole);
  /// Whether values at points are requested.
  [[nodiscard]] bool has_points() const { return !selection_.point_fields.empty(); }

 private:
  struct Channel {
    BrecciaGrid grid{};
    std::vector<BrecciaArray> arrays, point_arrays;
    std::vector<double> points;
    std::vector<std::vector<std::byte>> values, point_values;  ///< by array
  };
  void select_fields(Channel& channel) const;
  void select_point_fields(Channel& channel, int index) const;
  void select_cells(Channel& channel) const;

  Selection selection_;
  std::array<Channel, BRECCIA_NUM_CHANNELS> channels_;
  BrecciaInstant instant_{};
};

}  // namespace breccia::insitu
