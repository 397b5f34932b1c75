#include "mesh/gmsh_source_check.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "mesh/geo_scan.hpp"

namespace breccia {
namespace {

/// gmsh does not complain about a missing file, so files are looked at first.
void demand_readable(const GmshSource& source) {
  const std::string file = source.file.string();
  const auto refuse = [&](const std::string& what, const std::string& allowed, const std::string& given) {
    throw InputError(Problem{file, 0, "mesh.file", what, allowed, given});
  };
  std::error_code ignored;
  const auto extension = source.file.extension();
  if (extension != ".geo" && extension != ".msh") {
    refuse("is no kind of mesh file that can be read", ".geo, or .msh of format 2.2 to 4.1", extension.string());
  }
  if (!std::filesystem::exists(source.file, ignored)) refuse("the file does not exist", "", "");
  if (std::filesystem::is_directory(source.file, ignored)) refuse("is a folder", "a .geo or .msh file", "");
  if (!std::filesystem::is_regular_file(source.file, ignored)) refuse("is not a file", "a .geo or .msh file", "");
  std::ifstream in(source.file, std::ios::binary);
  if (!in) refuse("the file cannot be read", "a file with read permission", "");
  if (in.peek() == std::ifstream::traits_type::eof()) refuse("the file is empty", "", "");
  const std::string options = file + ".opt";
  if (!source.trust && std::filesystem::exists(options, ignored))
    refuse("gmsh takes commands from a file beside it, unseen by the case: " + options,
           "no such file; or --trust-geometry, if you know what is in it", "");
  if (extension == ".geo") return;

  std::string heading;
  double version = 0;
  in >> heading >> version;
  if (heading != "$MeshFormat" || !in) refuse("is not a gmsh mesh: it does not begin with $MeshFormat", "", "");
  if (!(version >= 2.2 && version <= 4.1)) {
    refuse("the mesh format is not supported", "2.2 to 4.1", std::to_string(version).substr(0, 3));
  }
}

void demand_parameters(const GmshSource& source) {
  std::vector<Problem> problems;
  const std::string file = source.file.string();
  if (!(std::isfinite(source.scale) && source.scale > 0)) {
    problems.push_back({file, 0, "mesh.scale", "is no length unit", "finite, > 0", std::to_string(source.scale)});
  }
  if (!is_script(source) && !source.parameters.empty()) {
    problems.push_back({file, 0, "mesh.parameters", "a mesh file takes no parameters", "parameters with a .geo only",
                        source.parameters.begin()->first});
  }
  if (is_script(source)) {
    GeoScan scan = scan_geo(source.file);
    std::string known;
    for (const auto& name : scan.constants) known += (known.empty() ? "" : ", ") + name;
    for (const auto& name : scan.onelab_names) known += (known.empty() ? "" : ", ") + name;
    for (const auto& [name, value] : source.parameters) {
      const bool constant = is_identifier(name) && scan.constants.count(name) != 0;
      if (!constant && scan.onelab_names.count(name) == 0) {
        problems.push_back({file, 0, "mesh.parameters." + name, "the script defines no such parameter",
                            known.empty() ? "none: it has no DefineConstant" : known, ""});
      } else if (!std::isfinite(value)) {
        problems.push_back({file, 0, "mesh.parameters." + name, "is not finite", "a finite number", ""});
      }
    }
    for (Problem& p : scan.problems) {
      if (source.trust && p.key != "Exit" && p.key != "Abort") continue;
      p.allowed = kTrustAdvice;
      problems.push_back(std::move(p));
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

bool is_script(const GmshSource& source) { return source.file.extension() == ".geo"; }

bool is_identifier(const std::string& name) {
  const auto in_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::all_of(name.begin(), name.end(), in_word);
}

void check_source(const GmshSource& source) {
  demand_readable(source);
  demand_parameters(source);
}

}  // namespace breccia
