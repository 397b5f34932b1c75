#include "case/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <functional>

namespace breccia::case_ {
namespace {

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// @param same  whether two letters are equal
template <class Same>
std::size_t alignment_distance(std::string_view a, std::string_view b, Same same) {
  // Three rows of the table are enough: a swap of neighbours uses the row before the last.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) { return alignment_distance(a, b, same_letter); }

std::vector<std::string> nearest_first(std::string_view word, std::span<const std::string> candidates) {
  std::vector<std::pair<std::pair<std::size_t, std::size_t>, std::string>> ranked;
  ranked.reserve(candidates.size());
  for (const std::string& c : candidates) {
    // Of two that are as near, the one whose letters are of the same size: GPpa is GPa, not pPa.
    const std::size_t exact = alignment_distance(word, c, std::equal_to<char>());
    ranked.push_back({{edit_distance(word, c), exact}, c});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> out;
  out.reserve(ranked.size());
  for (auto& [distance, text] : ranked) out.push_back(std::move(text));
  return out;
}

std::string nearest_words(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t kMany = 20, kNamed = 12;  // a few more are named rather than counted
  const std::vector<std::string> ranked = nearest_first(word, candidates);
  if (ranked.size() <= kMany) return joined(ranked);
  return joined(std::span(ranked).first(kNamed)) + " and " + std::to_string(ranked.size() - kNamed) + " more";
}

std::string likely_meant(std::string_view word, std::span<const std::string> candidates) {
  const std::vector<std::string> ranked = nearest_first(word, candidates);
  if (ranked.empty()) return {};
  const std::size_t allowed = std::max<std::size_t>(1, word.size() / 3);
  return edit_distance(word, ranked.front()) <= allowed ? ranked.front() : std::string{};
}

std::string joined(std::span<const std::string> words, std::string_view separator) {
  std::string out;
  for (const std::string& w : words) {
    if (!out.empty()) out += separator;
    out += w;
  }
  return out;
}

}  // namespace breccia::case_
