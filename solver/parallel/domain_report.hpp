#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace breccia {

/// What a step costs, for predictions. With its joints, on a core of an AMD EPYC; the slit plate of 442,368 elements
/// (tests/benchmark/README.md).
inline constexpr double kSecondsAnElement = 70e-9;
/// On a cloud machine, two cores of an AVX-512 Xeon: a message both ways at once took 0.3 us with 8 bytes, 12 us with 8
/// kB, 49 us with 80 kB, 184 us with 800 kB: at most this and its bytes at this speed.
inline constexpr double kSecondsAMessage = 10e-6;
inline constexpr double kBytesASecond = 2.0e9;
inline constexpr std::int64_t kBytesAProxy = std::int64_t{24} * 8;  ///< position and velocity of four nodes

/// What a domain holds, computes and exchanges.
struct DomainLoad {
  std::int64_t elements = 0;   ///< originals
  std::int64_t joints = 0;     ///< whose element of lower index is an original
  std::int64_t shared = 0;     ///< joints with one side here and one elsewhere
  std::int64_t cut_faces = 0;  ///< inner faces with one side here and one elsewhere
  std::int64_t held = 0;       ///< proxies: elements of other domains within the reach
  std::int64_t gathered = 0;   ///< of these, those that its forces depend on in every step while nothing touches
  int neighbours = 0;          ///< domains it gathers from: messages a step
  double step = 0;             ///< s, predicted

  [[nodiscard]] std::int64_t bytes() const { return kBytesAProxy * gathered; }  ///< received a step
};

struct DomainReport {
  std::vector<DomainLoad> domains;
  double imbalance = 1;    ///< most elements of a domain / mean
  int exchange_steps = 0;  ///< of the schedule of pairwise exchanges (exchange_schedule.hpp)
  double efficiency = 1;   ///< predicted time of one rank / (ranks x time of the slowest)
};

/// Loads of the domains at rest.
///
/// A proxy is gathered in every step if a joint connects it to an original or if it shares a node with one, in a body
/// without joints (kBytesAProxy is then an upper bound: a shared node is sent once). It is stored if its box is within
/// its reach of the box around the originals. step = kSecondsAnElement elements + kSecondsAMessage
/// neighbours + bytes / kBytesASecond: joints on a cut are computed on both sides, but so they are in the sweep of one
/// rank.
/// @param node_sets  (volume groups) -1: every element has its own nodes and joints to its neighbours; else elements
/// share nodes, with those of other groups of the same number, and have joints to the others
/// @param owner      (elements) 0..parts-1;  @param reach  (elements) m
/// @pre mesh and topology are the whole model's. O(elements), 40 bytes a node and 60 a cut face; throws nothing.
[[nodiscard]] DomainReport report_domains(const Mesh& mesh, const Topology& topology, std::span<const Index> node_sets,
                                          std::span<const int> owner, int parts, std::span<const double> reach);

}  // namespace breccia
