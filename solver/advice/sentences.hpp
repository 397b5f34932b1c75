#pragma once

#include <string>
#include <utility>
#include <vector>

namespace breccia {

/// Each with its remedy and a full stop at its end.
using Sentences = std::vector<std::string>;

/// Adds a sentence unless it is empty.
inline void add_to(Sentences& sentences, std::string sentence) {
  if (!sentence.empty()) sentences.push_back(std::move(sentence));
}

inline void append(Sentences& sentences, const Sentences& more) {
  sentences.insert(sentences.end(), more.begin(), more.end());
}

}  // namespace breccia
