#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "discretisation/fragments.hpp"
#include "domains/domain.hpp"
#include "observe/free_faces.hpp"

namespace breccia {

/// Fragments of the whole model as of now: joints that have failed no longer hold, opened or not. Labels of this rank's
/// originals and proxies; the count is that of the model. Collective. O(elements + joints) and O(pairs of labels that
/// meet at borders of domains, on all ranks).
[[nodiscard]] Fragments find_fragments(const Domain& domain);

/// Fragments and free faces, which are computed again only after joints have failed or elements have moved between
/// ranks.
class FragmentWatch {
 public:
  /// At present, valid until the next call. Collective. @param decompositions  so far
  const Fragments& look(const Domain& domain, std::int64_t decompositions);
  /// Free faces of this rank's originals, as of the last look() and valid as long. @pre domain is that of the last
  /// look()
  const std::vector<SurfaceFace>& free_faces(const Domain& domain);

 private:
  Fragments fragments_;
  std::optional<std::vector<SurfaceFace>> faces_;   ///< nothing: not requested since the last change
  std::int64_t broken_ = -1, decompositions_ = -1;  ///< for which fragments_ were found; joints of the whole model
};

}  // namespace breccia
