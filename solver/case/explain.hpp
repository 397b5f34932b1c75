#pragma once

#include <string>
#include <string_view>

namespace breccia::case_ {

/// Text of `breccia explain`: every section with one line a key (type or unit, default).
/// @param experts  keys of every level in full; else those above the basic level by name only, one line a section
[[nodiscard]] std::string explain_all(bool experts);

/// Text of `breccia explain KEY`: meaning, type, unit, default, range, choices and an example of a key, or a section
/// with its keys.
/// @param key  a path with or without indices ("material[].young", "material.young", "material[0].young"), the last
///             part of one or several paths ("young"), or a term of the field (topics.hpp), whose keys are listed
/// @param experts  as above, for a section. Throws InputError with the nearest keys if there is no such key.
[[nodiscard]] std::string explain(std::string_view key, bool experts = false);

}  // namespace breccia::case_
