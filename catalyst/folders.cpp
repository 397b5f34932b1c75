#include "catalyst/folders.hpp"

#include <dlfcn.h>

namespace breccia::insitu {

std::filesystem::path data_folder() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&data_folder), &library) != 0 && library.dli_fname != nullptr) {
    std::error_code error;
    const auto beside = std::filesystem::absolute(library.dli_fname, error).parent_path();
    const auto installed = (beside / "../../share/breccia/catalyst").lexically_normal();
    if (!error && std::filesystem::is_directory(installed / "pipelines", error)) return installed;
  }
  return BRECCIA_CATALYST_SOURCE;
}

std::int64_t bytes_in_folder(const std::filesystem::path& folder) {
  std::int64_t bytes = 0;
  std::error_code error;
  for (auto entry = std::filesystem::recursive_directory_iterator(folder, error); !error && entry != decltype(entry){};
       entry.increment(error)) {
    std::error_code vanished;
    const auto size = entry->is_regular_file(vanished) ? entry->file_size(vanished) : 0;
    if (!vanished) bytes += static_cast<std::int64_t>(size);
  }
  return bytes;
}

}  // namespace breccia::insitu
