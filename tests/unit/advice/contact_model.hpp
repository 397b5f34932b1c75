#pragma once

#include <string>

#include "unit/case/case_files.hpp"

namespace breccia::test {

inline constexpr const char* kRest = R"(
[[contact]]
between = ["*", "*"]
penalty = "40 GPa"
[[stage]]
end = "1 ms"
)";

inline std::string material(const std::string& group, const std::string& young) {
  return "[[material]]\ngroup = \"" + group + "\"\nyoung = \"" + young +
         "\"\npoisson = 0.2\ndensity = 2000\njoints = \"none\"\n";
}

/// Model of a geometry. @param more  lines of the case before the materials
inline Model model_of(const std::string& geometry, const std::string& groups, const std::string& more = "") {
  const case_::CaseFolder folder;
  folder.write("geometry.geo", "SetFactory(\"OpenCASCADE\");\n" + geometry);
  return build_model(
      case_::read_case(folder.write("case.toml", "[mesh]\nfile = \"geometry.geo\"\n" + more + groups + kRest)));
}

}  // namespace breccia::test
