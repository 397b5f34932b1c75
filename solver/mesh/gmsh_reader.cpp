#include "mesh/gmsh_reader.hpp"

#include <gmsh.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
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
#include "base/number_text.hpp"
#include "mesh/bdf_scan.hpp"
#include "mesh/geo_scan.hpp"
#include "mesh/gmsh_model.hpp"
#include "mesh/gmsh_solids.hpp"
#include "mesh/gmsh_source_check.hpp"
#include "mesh/inp_reader.hpp"
#include "mesh/mesh_bytes.hpp"
#include "mesh/set_readers.hpp"
#include "mesh/solid_groups.hpp"
#include "system/bounded_file.hpp"
#include "system/child_process.hpp"
#include "system/write_all.hpp"

namespace breccia {
namespace {

constexpr int kDelaunay = 1, kHxt = 10;  // gmsh's numbers of algorithms in three dimensions

// --- Running gmsh
// -----------------------------------------------------------------------------------------------------

/// gmsh open, in a child process that ends with the reading.
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

/// A script in memory: nothing is left behind however a program ends. The child writes it, and gmsh reads it as path().
class ScriptInMemory {
 public:
  ScriptInMemory() : descriptor_(::memfd_create("script", MFD_CLOEXEC)) {
    if (descriptor_ < 0)
      throw OutputError(Problem{"", 0, "mesh.parameters",
                                std::string("cannot be handed to gmsh: ") + std::strerror(errno),
                                "a system with files in memory (memfd_create)", ""});
  }
  ~ScriptInMemory() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  ScriptInMemory(const ScriptInMemory&) = delete;
  ScriptInMemory& operator=(const ScriptInMemory&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// In the child.
  static void write(std::string_view text) {
    if (write_all(kKeptDescriptor, text) != 0) throw std::bad_alloc();  // it is a file in memory
  }
  [[nodiscard]] static std::string path() { return "/proc/self/fd/" + std::to_string(kKeptDescriptor); }

 private:
  int descriptor_;
};

/// Words of gmsh's for a person; not those of its source, of the C++ library or of a memory allocator.
bool is_plain(const std::string& message) {
  constexpr std::array kInternal{"::",     "what():", "terminate called", "_M_",         "ssert",       "malloc",
                                 "free()", "corrupt", "bad_alloc",        "core dumped", "Segmentation"};
  return !message.empty() && std::none_of(kInternal.begin(), kInternal.end(),
                                          [&](const char* words) { return message.find(words) != std::string::npos; });
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

/// What gmsh says, in its form "'file', line 12: what" with the place taken out where it stands there.
Problem problem_of(const GmshSource& source, const std::string& message) {
  const std::string mark = "', line ";
  const std::size_t mark_at = message.find(mark), digits = mark_at + mark.size();
  if (message.starts_with('\'') && mark_at != std::string::npos) {
    const std::size_t digits_end = message.find_first_not_of("0123456789", digits);
    int line = 0;
    std::from_chars(message.data() + digits, message.data() + std::min(digits_end, message.size()), line);
    if (digits_end != std::string::npos && message.compare(digits_end, 2, ": ") == 0) {
      const std::string file = message.substr(1, mark_at - 1);
      const bool in_memory = file == ScriptInMemory::path();
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
                           "asks for HXT, which makes another mesh each time",
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
  ScriptInMemory::write(assignments(source) + (rest.empty() ? "\n" : rest));  // without it the last one is lost
  const auto set_labels = [&] {
    for (const auto& [key, value] : source.parameters)
      if (!is_identifier(key)) gmsh::onelab::setNumber(key, {value});
  };
  if (rest.empty()) {
    gmsh::open(ScriptInMemory::path());
    set_labels();
    gmsh::merge(source.file.string());
  } else {
    gmsh::model::add("script");
    set_labels();
    gmsh::merge(ScriptInMemory::path());
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

/// A mesh that needs nothing of gmsh.
RawMesh read_sets(const GmshSource& source, GeometryFile kind) {
  if (kind == GeometryFile::abaqus) return read_inp(source.file, source.scale);
  return kind == GeometryFile::unv ? read_unv(source.file, source.scale) : read_medit(source.file, source.scale);
}

/// What the child does: everything that depends on the content of the file.
MeshOrProblems read_here(const GmshSource& source) {
  try {
    check_source(source);
    const GeometryFile kind = geometry_file(source.file);
    if (kind == GeometryFile::abaqus || kind == GeometryFile::unv || kind == GeometryFile::medit)
      return read_sets(source, kind);
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

/// What the child may read: the mesh, what lies beside it, and what lies in the folder of the case.
std::vector<std::filesystem::path> readable_for(const GmshSource& source) {
  const std::filesystem::path folder = source.file.parent_path();
  std::vector<std::filesystem::path> readable{source.file, folder.empty() ? "." : folder};
  if (!source.case_folder.empty()) readable.push_back(source.case_folder);
  return readable;
}

/// Why a child brought no mesh.
/// @param memory  that it was allowed, bytes
Problem failure_of(const GmshSource& source, const ChildEnd& end, std::uint64_t memory) {
  const std::string file = source.file.string();
  const std::string said =
      is_plain(end.text) || end.kind == ChildEnd::Kind::forbidden ? ": " + end.text : std::string();
  switch (end.kind) {
    case ChildEnd::Kind::forbidden:
      return {file, 0, "mesh.file", "tries to do what a mesh may not" + said, kTrustAdvice, ""};
    case ChildEnd::Kind::out_of_time:
      return {file,
              0,
              "mesh.time_limit",
              "the mesh was not read in time",
              "a coarser mesh, or a larger mesh.time_limit in a case (by default a minute for check and mesh)",
              number_text(source.time_limit, 6) + " s"};
    case ChildEnd::Kind::out_of_memory:
      return {file,
              0,
              "mesh.memory_limit",
              "reading the mesh takes more memory than it may, " + bytes_text(memory) + said,
              "a coarser mesh, or a larger mesh.memory_limit (share of the machine's memory), within what is available",
              number_text(source.memory_limit, 3)};
    case ChildEnd::Kind::interrupted:
      return {"", 0, "", "interrupted while the mesh was read; nothing has been written", "", ""};
    case ChildEnd::Kind::not_confined:
      return {file,
              0,
              "mesh.file",
              "this system cannot confine the process that reads the mesh (seccomp is missing)",
              "--trust-geometry, if you know who made the mesh",
              ""};
    case ChildEnd::Kind::crashed:
    case ChildEnd::Kind::finished:
      break;
  }
  if (end.signal == 0) return {file, 0, "mesh.file", "gmsh ended before the mesh was read" + said, "", ""};
  return {file,
          0,
          "mesh.file",
          std::string("gmsh crashed while it read this file (") + ::strsignal(end.signal) + ")" + said,
          "a mesh file that is whole, a script that gmsh itself can mesh",
          ""};
}

}  // namespace

FinishedMesh read_gmsh(const GmshSource& source) {
  const double share = source.memory_limit * static_cast<double>(memory_of_machine());
  ChildLimits limits;
  limits.bytes = std::min(static_cast<std::uint64_t>(share), available_memory());
  check_file(source, limits.bytes);
  std::optional<ScriptInMemory> script;
  if (is_script(source)) script.emplace();
  limits.seconds = source.time_limit;
  limits.confined = !source.trust;
  limits.readable = readable_for(source);
  if (script) limits.kept = script->descriptor();
  const ChildEnd end = run_in_child(limits, open_gmsh, [&] { return bytes_of(read_here(source)); });
  if (end.kind != ChildEnd::Kind::finished) throw InputError(failure_of(source, end, limits.bytes));
  MeshOrProblems read = mesh_of(end.result);
  if (auto* problems = std::get_if<std::vector<Problem>>(&read)) throw InputError(std::move(*problems));
  auto& raw = std::get<RawMesh>(read);
  FinishedMesh result = finish_mesh(std::move(raw.mesh), {source.glue, source.repair_inverted, source.merge_nodes});
  result.report.ungrouped_elements = raw.ungrouped_elements;
  result.report.notes = std::move(raw.notes);
  return result;
}

}  // namespace breccia
