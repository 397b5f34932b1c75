#pragma once

#include <cstddef>
#include <string_view>

namespace breccia {

/// Lists and objects within each other that a JSON text of ours has at most, many times over.
inline constexpr int kDeepestJson = 64;

/// True if brackets outside texts are open more than `most` deep anywhere. The text need not be JSON. O(size), throws
/// nothing.
[[nodiscard]] inline bool is_nested_deeper(std::string_view json, int most) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c == '"') in_text = false;
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      if (++depth > most) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

}  // namespace breccia
