#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace breccia::case_ {

/// A word of the field that is no key, and what it is called in a case.
struct Topic {
  std::string_view words;   ///< "a|b|c", lower case, one of each
  std::string_view answer;  ///< one or two sentences
  std::string_view keys;    ///< "a|b|c", plain paths of the relevant sections and keys
};

[[nodiscard]] const std::vector<Topic>& topics();

/// Parts of that table: words of mechanics, materials, loads and results; of computers, files and other programs. If
/// Breccia has no such feature the text states it, with an alternative.
[[nodiscard]] std::span<const Topic> physics_topics();
[[nodiscard]] std::span<const Topic> program_topics();

/// The topic of a word, however it is written ("Process_Zones"), or nullptr. O(topics), throws nothing but bad_alloc.
[[nodiscard]] const Topic* topic_of(std::string_view word);

}  // namespace breccia::case_
