#pragma once

#include <string>
#include <vector>

#include "commands/terminal.hpp"

namespace breccia {

/// Sentences with their remedy, each ending with a full stop.
using Advice = std::vector<std::string>;

/// Adds a sentence unless it is empty.
inline void advise(Advice& advice, std::string sentence) {
  if (!sentence.empty()) advice.push_back(std::move(sentence));
}

inline void append(Advice& advice, const Advice& more) { advice.insert(advice.end(), more.begin(), more.end()); }

/// A line each, beginning with "- ".
inline std::string as_list(const Advice& advice) {
  std::string text;
  for (const std::string& sentence : advice) text += "- " + sentence + "\n";
  return text;
}

/// A warning each, on stderr.
inline void warn_of(const Advice& advice) {
  for (const std::string& sentence : advice) print_warning(sentence);
}

}  // namespace breccia
