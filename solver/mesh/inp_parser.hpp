#pragma once

#include <filesystem>

#include "mesh/inp_model.hpp"

namespace breccia::inp {

/// Reads the words and numbers of an input file. Throws InputError as read_inp() does for them.
[[nodiscard]] Model parse(const std::filesystem::path& file);

}  // namespace breccia::inp
