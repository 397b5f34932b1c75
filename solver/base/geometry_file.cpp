#include "base/geometry_file.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace breccia {

GeometryFile geometry_file(const std::filesystem::path& file) {
  constexpr std::array<std::pair<const char*, GeometryFile>, 10> kNames{{{".geo", GeometryFile::script},
                                                                         {".msh", GeometryFile::mesh},
                                                                         {".step", GeometryFile::step},
                                                                         {".stp", GeometryFile::step},
                                                                         {".STEP", GeometryFile::step},
                                                                         {".STP", GeometryFile::step},
                                                                         {".brep", GeometryFile::brep},
                                                                         {".BREP", GeometryFile::brep},
                                                                         {".stl", GeometryFile::stl},
                                                                         {".STL", GeometryFile::stl}}};
  const auto extension = file.extension();
  const auto* found =
      std::find_if(kNames.begin(), kNames.end(), [&](const auto& name) { return extension == name.first; });
  return found == kNames.end() ? GeometryFile::unknown : found->second;
}

}  // namespace breccia
