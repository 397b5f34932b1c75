#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace breccia::case_ {

/// Smallest number of insertions, deletions, substitutions and swaps of neighbours that turn a into b (optimal string
/// alignment distance). Letters that differ in case only count as equal. O(|a| |b|).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidates in order of increasing distance to the word; of equal
/// distances the one that is nearer when the case of letters counts; then the order of the candidates.
[[nodiscard]] std::vector<std::string> nearest_first(std::string_view word, std::span<const std::string> candidates);

/// The nearest candidates, "a, b, c"; of many a dozen and how many more there are.
[[nodiscard]] std::string nearest_words(std::string_view word, std::span<const std::string> candidates);

/// The nearest candidate if it is near enough to be what was meant (at most a third of the word's letters differ, and
/// one always may), else empty.
[[nodiscard]] std::string likely_meant(std::string_view word, std::span<const std::string> candidates);

/// "a, b, c"
[[nodiscard]] std::string joined(std::span<const std::string> words, std::string_view separator = ", ");

}  // namespace breccia::case_
