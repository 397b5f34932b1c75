#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "detection/point_body/search.hpp"
#include "placements.hpp"

namespace breccia::lab {

/// Pairs seen: how many, and a sum that does not depend on their order nor on the order within a pair.
struct Tally {
  std::uint64_t count = 0;
  std::uint64_t checksum = 0;

  void add(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15;
    ++count;
    checksum += (a + odd) * (b + odd);
  }
  bool operator==(const Tally&) const = default;
};

/// A search of bodies of equal size that takes part in experiments I to VI.
class Contender {
 public:
  virtual ~Contender() = default;
  Contender() = default;
  Contender(const Contender&) = delete;
  Contender& operator=(const Contender&) = delete;

  virtual std::string name() const = 0;
  /// Everything that must be done again when bodies have moved: building and searching.
  virtual Tally detect(const Cells& cells) = 0;
  /// Memory of its own, where it tells; 0 where it does not.
  virtual std::size_t bytes() const { return 0; }
};

/// The same for points against tetrahedra: the couples of detection::PointBodySearch.
class PointContender {
 public:
  virtual ~PointContender() = default;
  PointContender() = default;
  PointContender(const PointContender&) = delete;
  PointContender& operator=(const PointContender&) = delete;

  virtual std::string name() const = 0;
  virtual Tally detect(const std::vector<Vec3>& points, const std::vector<detection::Corners>& contactors,
                       double buffer) = 0;
};

using Contenders = std::vector<std::unique_ptr<Contender>>;
using PointContenders = std::vector<std::unique_ptr<PointContender>>;

/// Breccia's searches, in the order of the chapter.
Contenders own_searches();
PointContenders own_point_searches();

/// Bytes a body of each search at experiment III with n bodies, for 16-bit and 32-bit coordinates: a line a search.
void write_bytes(std::size_t n, std::ostream& table);

}  // namespace breccia::lab
