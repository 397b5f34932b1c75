#include "mesh/gmsh_source_check.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/geometry_file.hpp"
#include "mesh/geo_scan.hpp"
#include "mesh/msh_scan.hpp"
#include "system/bounded_file.hpp"

namespace breccia {
namespace {

/// Whether the list of shapes of a BREP file is whole: OpenCASCADE never returns from a truncated one.
bool has_all_shapes(std::ifstream& in) {
  std::string word;
  long wanted = -1, ended = 0;
  while (in >> word) {
    if (word == "TShapes") {
      if (!(in >> wanted)) return false;
      ended = 0;
    } else if (word == "*" && ++ended == wanted) {
      return true;
    }
  }
  return wanted == 0;
}

/// A STEP file has an end mark.
bool has_step_end(std::ifstream& in) {
  constexpr std::streamoff kTail = 4096;  // blanks and a signature may follow the last word
  in.clear();
  in.seekg(0, std::ios::end);
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - kTail));
  const std::string tail{std::istreambuf_iterator<char>(in), {}};
  return tail.find("END-ISO-10303-21") != std::string::npos;
}

/// A solid has the first line of its kind: unknown files gmsh ignores silently, or reads as a script. An STL is read by
/// mesh/stl_file.hpp, which demands the same.
void demand_solid(const GmshSource& source, GeometryFile kind, std::ifstream& in) {
  constexpr std::size_t kHead = 512;  // comments and blanks before the first word of a STEP or BREP file included
  std::string head(kHead, '\0');
  in.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(in.gcount()));
  const auto refuse = [&](const std::string& what, const std::string& allowed) {
    throw InputError(Problem{source.file.string(), 0, "mesh.file", what, allowed, ""});
  };
  const auto holds = [&](const char* word) { return head.find(word) != std::string::npos; };
  if (kind == GeometryFile::step && !holds("ISO-10303-21"))
    refuse("is no STEP file: it does not begin with ISO-10303-21", "");
  if (kind == GeometryFile::step && !has_step_end(in))
    refuse("is cut off: it does not end with END-ISO-10303-21", "a whole STEP file");
  if (kind == GeometryFile::brep && !holds("DBRep_DrawableShape") && !holds("CASCADE Topology"))
    refuse("is no BREP file: it does not begin with DBRep_DrawableShape or CASCADE Topology", "");
  if (kind == GeometryFile::brep) {
    in.clear();
    in.seekg(0);
    if (!has_all_shapes(in)) refuse("is cut off: shapes are missing at its end", "a whole BREP file");
  }
}

/// gmsh does not complain about a missing file, so files are checked first.
void demand_readable(const GmshSource& source) {
  const std::string file = source.file.string();
  const auto refuse = [&](const std::string& what, const std::string& allowed, const std::string& given) {
    throw InputError(Problem{file, 0, "mesh.file", what, allowed, given});
  };
  std::error_code ignored;
  const GeometryFile kind = geometry_file(source.file);
  std::ifstream in(source.file, std::ios::binary);
  if (!in) refuse("the file cannot be read", "a file with read permission", "");
  if (in.peek() == std::ifstream::traits_type::eof()) refuse("the file is empty", "", "");
  const std::string options = file + ".opt";
  if (!source.trust && std::filesystem::exists(options, ignored))
    refuse("gmsh takes commands from a file beside it, unseen by the case: " + options,
           "no such file; or --trust-geometry, if you know what is in it", "");
  if (kind == GeometryFile::script) return;
  if (is_solid(kind)) return demand_solid(source, kind, in);
  if (kind != GeometryFile::mesh) return;  // their readers demand what is needed

  constexpr std::size_t kHead = 512;  // more than comes before the version
  std::string head(kHead, '\0');
  in.read(head.data(), kHead);
  std::istringstream words(head.substr(0, static_cast<std::size_t>(in.gcount())));
  std::string heading;
  double version = 0;
  words >> heading >> version;
  if (heading != "$MeshFormat" || !words) refuse("is not a gmsh mesh: it does not begin with $MeshFormat", "", "");
  if (!(version >= 2.2 && version <= 4.1)) {
    refuse("the mesh format is not supported", "2.2 to 4.1", std::to_string(version).substr(0, 3));
  }
  if (std::vector<Problem> faults = msh_faults(source.file); !faults.empty()) throw InputError(std::move(faults));
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
  if (source.size != 0 && !is_solid(geometry_file(source.file))) {
    problems.push_back({file, 0, "mesh.size", "only a solid is meshed with elements of a chosen size",
                        "mesh.size with STEP, BREP and STL; a .geo sets its own", std::to_string(source.size)});
  } else if (!(std::isfinite(source.size) && source.size >= 0)) {
    problems.push_back({file, 0, "mesh.size", "is no length", "finite, > 0", std::to_string(source.size)});
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
      p.allowed = p.key == "Include" || p.key == "Merge" ? kReadAdvice : kTrustAdvice;
      problems.push_back(std::move(p));
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

bool is_script(const GmshSource& source) { return geometry_file(source.file) == GeometryFile::script; }

bool is_identifier(const std::string& name) {
  const auto in_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::all_of(name.begin(), name.end(), in_word);
}

void check_file(const GmshSource& source, std::uint64_t memory) {
  const std::string file = source.file.string();
  const auto refuse = [&](const std::string& what, const std::string& allowed, const std::string& given) {
    throw InputError(Problem{file, 0, "mesh.file", what, allowed, given});
  };
  std::error_code error;
  if (geometry_file(source.file) == GeometryFile::unknown) {
    const std::string remedy = remedy_for(source.file);
    refuse("is no kind of mesh file that can be read" + (remedy.empty() ? remedy : ": " + remedy), kGeometryFiles,
           source.file.extension().string());
  }
  const std::filesystem::file_status status = std::filesystem::status(source.file, error);
  if (!std::filesystem::exists(status)) refuse("the file does not exist", "", "");
  if (std::filesystem::is_directory(status)) refuse("is a folder", kGeometryFiles, "");
  if (!std::filesystem::is_regular_file(status)) refuse("is not a file", kGeometryFiles, "");
  const std::uintmax_t size = std::filesystem::file_size(source.file, error);
  if (!error && size > memory)  // a mesh takes more memory than its file takes bytes
    refuse("is too large to be read", "up to the memory that reading may take, " + bytes_text(memory),
           bytes_text(size));
}

void check_source(const GmshSource& source) {
  demand_readable(source);
  demand_parameters(source);
}

}  // namespace breccia
