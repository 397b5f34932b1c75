#pragma once

#include <algorithm>
#include <array>
#include <string>

namespace breccia {

/// True for words of gmsh's that are meant for its users; false for those of its source, of the C++ library or of a
/// memory allocator, and for none.
inline bool is_plain(const std::string& message) {
  constexpr std::array kInternal{"::",     "what():", "terminate called", "_M_",         "ssert",       "malloc",
                                 "free()", "corrupt", "bad_alloc",        "core dumped", "Segmentation"};
  return !message.empty() && std::none_of(kInternal.begin(), kInternal.end(),
                                          [&](const char* words) { return message.find(words) != std::string::npos; });
}

}  // namespace breccia
