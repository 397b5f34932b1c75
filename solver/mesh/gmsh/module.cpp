#include "mesh/gmsh/module.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <new>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/geometry_file.hpp"
#include "base/version.hpp"
#include "mesh/bdf_scan.hpp"
#include "mesh/geo_scan.hpp"
#include "mesh/gmsh/model.hpp"
#include "mesh/gmsh/plain_words.hpp"
#include "mesh/gmsh/solid_groups.hpp"
#include "mesh/gmsh/solids.hpp"
#include "mesh/gmsh_source_check.hpp"
#include "system/child_process.hpp"
#include "system/write_all.hpp"

namespace breccia {
namespace {

constexpr int kDelaunay = 1, kHxt = 10;  // gmsh's numbers of algorithms in three dimensions

void open_gmsh() {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::option::setNumber("Mesh.MaxNumThreads1D", 1);
  gmsh::option::setNumber("Mesh.MaxNumThreads2D", 1);
  gmsh::option::setNumber("Mesh.MaxNumThreads3D", 1);
  gmsh::option::setNumber("Mesh.Algorithm3D", kDelaunay);
  // Errors are logged, not thrown: a throw out of gmsh's parser leaves it unable to read any file after.
  gmsh::option::setNumber("General.AbortOnError", 0);
  gmsh::logger::start();
}

/// The script as gmsh reads it: a file in memory, so that nothing is left behind however the process ends.
std::string script_path() { return "/proc/self/fd/" + std::to_string(kKeptDescriptor); }

void write_script(std::string_view text) {
  if (write_all(kKeptDescriptor, text) != 0) throw std::bad_alloc();
}

/// gmsh gave up for a reason that only its developers understand.
Problem unexplained(const GmshSource& source) {
  return {
      source.file.string(),
      0,
      "mesh.file",
      "gmsh cannot read or mesh this file, and gives no reason",
      "geometry that `gmsh -3 FILE` meshes; mended or saved anew in the program that it comes from, as STEP or .msh",
      ""};
}

/// A message of gmsh; the place is extracted from its form "'file', line 12: what".
Problem problem_of(const GmshSource& source, const std::string& message) {
  const std::string mark = "', line ";
  const std::size_t mark_at = message.find(mark), digits = mark_at + mark.size();
  if (message.starts_with('\'') && mark_at != std::string::npos) {
    const std::size_t digits_end = message.find_first_not_of("0123456789", digits);
    int line = 0;
    std::from_chars(message.data() + digits, message.data() + std::min(digits_end, message.size()), line);
    if (digits_end != std::string::npos && message.compare(digits_end, 2, ": ") == 0) {
      const std::string file = message.substr(1, mark_at - 1);
      const bool in_memory = file == script_path();
      return {in_memory ? source.file.string() : file, line, "", "gmsh: " + message.substr(digits_end + 2), "", ""};
    }
  }
  if (message.starts_with("Unable to open file"))
    return {source.file.string(), 0, "", "gmsh: " + message, kReadAdvice, ""};
  if (message.starts_with("Error loading"))
    return {source.file.string(),
            0,
            "mesh.file",
            "is damaged or cut off: gmsh cannot read it to its end",
            "a whole mesh file of format 2.2 to 4.1",
            ""};
  return {source.file.string(), 0, "", "gmsh: " + message, "", ""};
}

/// Problems of all errors gmsh has logged, each once.
std::vector<Problem> logged_problems(const GmshSource& source) {
  constexpr std::string_view kError = "Error: ";
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::vector<Problem> problems;
  std::set<std::string> seen;
  bool internal = false;
  for (const std::string& entry : log) {
    if (problems.size() == kProblemsNamed) break;
    if (!entry.starts_with(kError) || !seen.insert(entry).second) continue;
    const std::string words = entry.substr(kError.size());
    internal = internal || !is_plain(words);
    if (is_plain(words)) problems.push_back(problem_of(source, words));
  }
  if (problems.empty() && internal) problems.push_back(unexplained(source));
  return problems;
}

/// Runs one step of gmsh; any error it throws or logs becomes an InputError.
template <class Step>
void run_gmsh(const GmshSource& source, Step step) {
  std::optional<Problem> thrown;
  try {
    step();
  } catch (const std::string& text) {
    thrown = is_plain(text) ? problem_of(source, text) : unexplained(source);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {  // of the C++ library, of OpenCASCADE, or a number
    thrown = unexplained(source);
  }
  std::vector<Problem> problems = logged_problems(source);
  if (problems.empty() && thrown) problems.push_back(*thrown);
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// The same case is to give the same mesh.
void refuse_hxt(const GmshSource& source) {
  double algorithm = kDelaunay;
  gmsh::option::getNumber("Mesh.Algorithm3D", algorithm);
  if (algorithm != kHxt) return;
  throw InputError(Problem{source.file.string(), 0, "Mesh.Algorithm3D",
                           "selects HXT, which makes another mesh each time",
                           "1 (Delaunay) or 4 (Frontal), or a mesh file that gmsh has written", std::to_string(kHxt)});
}

/// Statements that assign the parameters, on one line: the way to give gmsh's script language a constant.
std::string assignments(const GmshSource& source) {
  std::ostringstream script;
  script << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const auto& [key, value] : source.parameters)
    if (is_identifier(key)) script << key << " = " << value << "; ";
  return script.str();
}

/// Reads the script with its parameters; where it has statements that are left out, as it is without them.
void run_script(const GmshSource& source) {
  const std::string rest = scan_geo(source.file, source.trust).without_output;
  write_script(assignments(source) + (rest.empty() ? "\n" : rest));  // without it the last one is lost
  const auto set_labels = [&] {
    for (const auto& [key, value] : source.parameters)
      if (!is_identifier(key)) gmsh::onelab::setNumber(key, {value});
  };
  if (rest.empty()) {
    gmsh::open(script_path());
    set_labels();
    gmsh::merge(source.file.string());
  } else {
    gmsh::model::add("script");
    set_labels();
    gmsh::merge(script_path());
  }
}

/// Every volume has its elements: the script has meshed them itself, and perhaps refined them since.
bool is_meshed() {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  return !volumes.empty() && std::all_of(volumes.begin(), volumes.end(), [](const auto& volume) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, 3, volume.second);
    return !types.empty();
  });
}

/// Nastran's elements are of the volumes and surfaces of their properties.
void load_bdf(const GmshSource& source) {
  BdfScan scan = scan_bdf(source.file);
  if (!scan.problems.empty()) throw InputError(std::move(scan.problems));
  gmsh::open(source.file.string());
  std::int64_t read = 0;
  for (const int dimension : {3, 2, 1})
    for (const int tag : solids::tags_of(dimension)) {
      solids::add_group(
          dimension, {tag},
          std::array{"", "curve_", "surface_", "volume_"}[static_cast<std::size_t>(dimension)] + std::to_string(tag));
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, dimension, tag);
      for (const auto& of_type : tags) read += dimension == 3 ? static_cast<std::int64_t>(of_type.size()) : 0;
    }
  if (read != scan.tetrahedra)
    solids::refuse(
        source,
        "has " + std::to_string(scan.tetrahedra) + " CTETRA cards, of which " + std::to_string(read) + " can be read",
        "cards of fixed or free format whose grid points the file has");
}

/// @param notes  out: of MeshReport
void load(const GmshSource& source, std::vector<std::string>& notes) {
  if (is_solid(geometry_file(source.file))) {
    run_gmsh(source, [&] { notes = mesh_solids(source); });
    return;
  }
  if (geometry_file(source.file) == GeometryFile::nastran) {
    run_gmsh(source, [&] { load_bdf(source); });
    return;
  }
  if (!is_script(source)) {
    run_gmsh(source, [&] { gmsh::open(source.file.string()); });
    return;
  }
  run_gmsh(source, [&] { run_script(source); });
  run_gmsh(source, [&] {
    refuse_hxt(source);
    if (!is_meshed()) gmsh::model::mesh::generate(3);
  });
}

MeshOrProblems read_model(const GmshSource& source) {
  try {
    std::vector<std::string> notes;
    load(source, notes);
    RawMesh raw;
    run_gmsh(source, [&] { raw = read_gmsh_model(source.file, source.scale, source.materials); });
    raw.notes.insert(raw.notes.begin(), notes.begin(), notes.end());
    return raw;
  } catch (const InputError& error) {
    return error.problems();
  }
}

}  // namespace
}  // namespace breccia

const breccia::GmshModule* breccia_gmsh_module() {
  static const breccia::GmshModule module{breccia::program_version(), breccia::open_gmsh, breccia::read_model};
  return &module;
}
