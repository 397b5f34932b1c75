#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace breccia {

/// SHA-256 of the bytes (FIPS 180-4), as 64 hexadecimal digits. O(bytes).
[[nodiscard]] std::string sha256(std::span<const std::byte> bytes);

}  // namespace breccia
