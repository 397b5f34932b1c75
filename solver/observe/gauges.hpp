#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "domains/domain.hpp"
#include "output/frames/frame.hpp"

namespace breccia {

/// A group, an element set or a body whose forces and motion are recorded.
struct Gauge {
  std::string name;
  Index volume_group = -1, body = -1;    ///< one of them, or none: an element set or a surface
  std::vector<Index> nodes;              ///< that this rank counts, ascending
  std::vector<Index> slots;              ///< elements of a group or body, this rank's originals
  std::vector<std::uint8_t> members;     ///< (slots) 1: of the element set; empty: it is none
  std::vector<std::size_t> constraints;  ///< of a surface: entries of the present stage that name it

  [[nodiscard]] bool is_surface() const { return volume_group < 0 && body < 0 && members.empty(); }
};

/// The gauges of a case on a rank's model as it is now. @param names  groups, or "body N"
[[nodiscard]] std::vector<Gauge> make_gauges(const Model& model, const std::vector<std::string>& names,
                                             const case_::Stage& stage);

/// What they read in the last step, which was sampled: with f_n = m (v_(n+1/2) - v_(n-1/2)) / dt on every node of mass
/// m
///   velocity = sum m v / M, momentum P = sum m v, centre c = sum m x_n / M,
///   spin = I^-1 sum (x_n - c) x m v, I the tensor of inertia about c (no spin about axes without inertia),
///   force = sum f_n, torque = sum (x_n - c) x f_n.
/// An element of a group or body counts a quarter of its mass at each corner; a surface the whole mass of its nodes.
/// Reactions: on a surface of the constraints that name it, else of all on its nodes.
/// All sums are exact. Collective. O(nodes of the gauges) and three reductions.
[[nodiscard]] std::vector<GaugeReading> read_gauges(const Domain& domain, const std::vector<Gauge>& gauges);

}  // namespace breccia
