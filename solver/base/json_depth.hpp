#pragma once

#include <string_view>

namespace breccia {

/// Lists and objects within each other that a JSON text of ours has at most, many times over.
inline constexpr int kDeepestJson = 64;

/// True if brackets outside texts are open more than `most` deep anywhere. The text need not be JSON. O(size), throws
/// nothing.
[[nodiscard]] bool is_nested_deeper(std::string_view json, int most);

}  // namespace breccia
