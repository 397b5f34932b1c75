#pragma once

#include <span>
#include <string_view>

namespace breccia::case_ {

/// A word of the field that is no key, and what it is called in a case.
struct Topic {
  std::string_view words;   ///< "a|b|c", lower case, one of each
  std::string_view answer;  ///< one or two sentences
  std::string_view keys;    ///< "a|b|c", plain paths of sections and keys that tell more
};

[[nodiscard]] std::span<const Topic> topics();

/// The topic of a word, however it is written ("Process_Zones"), or nullptr. O(topics), throws nothing but bad_alloc.
[[nodiscard]] const Topic* topic_of(std::string_view word);

}  // namespace breccia::case_
