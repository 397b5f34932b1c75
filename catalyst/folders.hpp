#pragma once

#include <cstdint>
#include <filesystem>

namespace breccia::insitu {

/// The folder with pipelines/ and python/: ../../share/breccia/catalyst beside an installed plug-in, else catalyst/ of
/// the source tree.
[[nodiscard]] std::filesystem::path data_folder();

/// Bytes of all files in a folder and below; 0 when it is not there.
[[nodiscard]] std::int64_t bytes_in_folder(const std::filesystem::path& folder);

}  // namespace breccia::insitu
