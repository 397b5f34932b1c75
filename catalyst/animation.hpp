#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breccia::insitu {

/// Makes NAME.mp4 of the pictures NAME_000000120.png, two at least, in each folder, by ffmpeg; a file is there whole or
/// not at all. Each takes two minutes at most, then it is aborted. Throws nothing.
/// @return  a line for each animation that was made or failed, or one line with instructions if ffmpeg is not
///          installed; separated by newlines
[[nodiscard]] std::string make_animations(const std::vector<std::filesystem::path>& folders);

}  // namespace breccia::insitu
