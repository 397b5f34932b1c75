#pragma once

#include <span>
#include <vector>

#include "base/exact_sum.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Values of sums over all ranks, in one reduction; the same bits for any number of ranks. Collective.
/// @param parts  this rank's; as many on every rank
[[nodiscard]] inline std::vector<double> totals(const Communicator& communicator, std::span<const ExactSum> parts) {
  std::vector<double> values;
  if (communicator.size() == 1) {
    for (const ExactSum& part : parts) values.push_back(part.value());
    return values;
  }
  std::vector<std::int64_t> words;
  for (const ExactSum& part : parts) {
    const auto of_part = part.words();
    words.insert(words.end(), of_part.begin(), of_part.end());
  }
  communicator.sum(words);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    values.push_back(ExactSum::from_words(std::span<const std::int64_t, ExactSum::kWords>(
                                              words.data() + i * ExactSum::kWords, ExactSum::kWords))
                         .value());
  }
  return values;
}

}  // namespace breccia
