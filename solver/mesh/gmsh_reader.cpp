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

#include "base/child_process.hpp"
#include "base/error.hpp"
#include "base/geometry_file.hpp"
#include "mesh/gmsh_model.hpp"
#include "mesh/gmsh_solids.hpp"
#include "mesh/gmsh_source_check.hpp"
#include "mesh/mesh_bytes.hpp"

namespace breccia {
namespace {

constexpr std::size_t kProblemsNamed = 10;
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

/// A script that assigns the parameters, in memory: nothing is left behind however a program ends. Reading it first is
/// the way to give gmsh's script language a constant. The child reads it as path().
class ParameterScript {
 public:
  explicit ParameterScript(const GmshSource& source) : descriptor_(::memfd_create("parameters", MFD_CLOEXEC)) {
    std::ostringstream script;
    script << std::setprecision(std::numeric_limits<double>::max_digits10);
    for (const auto& [key, value] : source.parameters) {
      if (is_identifier(key)) script << key << " = " << value << ";\n";
    }
    const std::string text = script.str();
    if (descriptor_ < 0 || ::write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      throw OutputError(Problem{"", 0, "mesh.parameters",
                                std::string("cannot be handed to gmsh: ") + std::strerror(errno),
                                "a system with files in memory (memfd_create)", ""});
  }
  ~ParameterScript() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  ParameterScript(const ParameterScript&) = delete;
  ParameterScript& operator=(const ParameterScript&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }
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
      return {message.substr(1, mark_at - 1), line, "", "gmsh: " + message.substr(digits_end + 2), "", ""};
    }
  }
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

/// @param notes  out: of MeshReport
void load(const GmshSource& source, std::vector<std::string>& notes) {
  if (is_solid(geometry_file(source.file))) {
    run_gmsh(source, [&] { notes = mesh_solids(source); });
    return;
  }
  if (!is_script(source)) {
    run_gmsh(source, [&] { gmsh::open(source.file.string()); });
    return;
  }
  run_gmsh(source, [&] {
    gmsh::open(ParameterScript::path());
    for (const auto& [key, value] : source.parameters) {
      if (!is_identifier(key)) gmsh::onelab::setNumber(key, {value});
    }
    gmsh::merge(source.file.string());
  });
  run_gmsh(source, [&] {
    refuse_hxt(source);
    gmsh::model::mesh::generate(3);
  });
}

/// What the child does: everything that gmsh has a hand in.
MeshOrProblems read_here(const GmshSource& source) {
  try {
    std::vector<std::string> notes;
    load(source, notes);
    RawMesh raw;
    run_gmsh(source, [&] { raw = read_gmsh_model(source.file, source.scale); });
    raw.notes.insert(raw.notes.begin(), notes.begin(), notes.end());
    return raw;
  } catch (const InputError& error) {
    return error.problems();
  }
}

std::string seconds_text(double seconds) {
  std::ostringstream text;
  text << seconds << " s";
  return text.str();
}

/// Why a child brought no mesh.
Problem failure_of(const GmshSource& source, const ChildEnd& end) {
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
              "a coarser mesh, or a larger mesh.time_limit",
              seconds_text(source.time_limit)};
    case ChildEnd::Kind::out_of_memory:
      return {file,
              0,
              "mesh.memory_limit",
              "reading the mesh takes more memory than it may" + said,
              "a coarser mesh, or a larger mesh.memory_limit (share of the machine's memory)",
              std::to_string(source.memory_limit)};
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
  check_source(source);
  std::optional<ParameterScript> script;
  if (is_script(source)) script.emplace(source);
  ChildLimits limits;
  limits.seconds = source.time_limit;
  limits.bytes = static_cast<std::uint64_t>(source.memory_limit * static_cast<double>(memory_of_machine()));
  limits.confined = !source.trust;
  if (script) limits.kept = script->descriptor();
  const ChildEnd end = run_in_child(limits, open_gmsh, [&] { return bytes_of(read_here(source)); });
  if (end.kind != ChildEnd::Kind::finished) throw InputError(failure_of(source, end));
  MeshOrProblems read = mesh_of(end.result);
  if (auto* problems = std::get_if<std::vector<Problem>>(&read)) throw InputError(std::move(*problems));
  auto& raw = std::get<RawMesh>(read);
  FinishedMesh result = finish_mesh(std::move(raw.mesh), {source.glue, source.repair_inverted});
  result.report.ungrouped_elements = raw.ungrouped_elements;
  result.report.notes = std::move(raw.notes);
  return result;
}

}  // namespace breccia
