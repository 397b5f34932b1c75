#pragma once

#include "discretisation/fragments.hpp"
#include "domains/domain.hpp"

namespace breccia {

/// Fragments of the whole model as of now: joints that have failed no longer hold, opened or not. Labels of this rank's
/// originals and proxies; the count is that of the model. Collective. O(elements + joints) and O(pairs of labels that
/// meet at borders of domains, on all ranks).
[[nodiscard]] Fragments find_fragments(const Domain& domain);

/// Fragments that are looked for again only when joints have failed meanwhile, or elements have moved between ranks.
class FragmentWatch {
 public:
  /// As of now, good until the next look. Collective. @param decompositions  so far
  const Fragments& look(const Domain& domain, std::int64_t decompositions);

 private:
  Fragments fragments_;
  std::int64_t broken_ = -1, decompositions_ = -1;  ///< for which fragments_ were found; joints of the whole model
};

}  // namespace breccia
