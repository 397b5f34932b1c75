#pragma once

#include <cstdint>
#include <filesystem>

namespace breccia {

/// Memory that the control groups of this process leave it, bytes: the least limit of its group and of those above it,
/// in the unified hierarchy as in that of the first version. 0: there is none, or it cannot be read.
/// @param root  where proc and sys are
[[nodiscard]] std::uint64_t memory_of_control_group(const std::filesystem::path& root = "/");

}  // namespace breccia
