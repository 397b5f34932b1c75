#pragma once

#include <cstdint>
#include <vector>

#include "domains/domain.hpp"

namespace breccia {

/// Which faces of a rank's originals are free: those of the bodies' surfaces, and those that a failed joint has laid
/// bare. As the domain stands when this is made.
class FreeFaces {
 public:
  explicit FreeFaces(const Domain& domain);
  /// @pre slot is an original
  [[nodiscard]] bool operator()(Index slot, int face) const;

 private:
  const Domain& domain_;
  std::vector<std::uint8_t> held_;  ///< (slots, 4) 1: by an active joint
};

/// A free face of an original.
struct SurfaceFace {
  Index slot;
  Index original;  ///< place of its element among the originals, ascending by id
  std::int32_t face;
  bool crack;  ///< laid bare by a joint that failed, not of the body's surface
};

/// All free faces of a rank's originals, ascending by element and face. O(elements + active joints)
[[nodiscard]] std::vector<SurfaceFace> surface_faces(const Domain& domain);

}  // namespace breccia
