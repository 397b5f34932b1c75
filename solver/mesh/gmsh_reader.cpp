#include "mesh/gmsh_reader.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/geometry_file.hpp"
#include "base/number_text.hpp"
#include "mesh/gmsh/module.hpp"
#include "mesh/gmsh/plain_words.hpp"
#include "mesh/gmsh_source_check.hpp"
#include "mesh/inp_reader.hpp"
#include "mesh/mesh_bytes.hpp"
#include "mesh/set_readers.hpp"
#include "system/bounded_file.hpp"
#include "system/child_process.hpp"

namespace breccia {
namespace {

/// A file in memory for a script, which the child writes and gmsh reads: nothing is left behind however a program ends.
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

 private:
  int descriptor_;
};

/// A mesh that needs nothing of gmsh.
bool is_text_of_sets(GeometryFile kind) {
  return kind == GeometryFile::abaqus || kind == GeometryFile::unv || kind == GeometryFile::medit;
}

RawMesh read_sets(const GmshSource& source, GeometryFile kind) {
  if (kind == GeometryFile::abaqus) return read_inp(source.file, source.scale);
  return kind == GeometryFile::unv ? read_unv(source.file, source.scale) : read_medit(source.file, source.scale);
}

/// What the child does: everything that depends on the content of the file.
/// @param gmsh  nullptr for a mesh that needs nothing of it
MeshOrProblems read_here(const GmshSource& source, const GmshModule* gmsh) {
  try {
    check_source(source);
    if (gmsh == nullptr) return read_sets(source, geometry_file(source.file));
  } catch (const InputError& error) {
    return error.problems();
  }
  return gmsh->read(source);
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
      return {file, 0, "mesh.file", "attempts an operation that is not permitted to a mesh" + said, kTrustAdvice, ""};
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
  const GmshModule* const gmsh = is_text_of_sets(geometry_file(source.file)) ? nullptr : &gmsh_module();
  const ChildEnd end = run_in_child(
      limits, gmsh != nullptr ? gmsh->open : +[] {}, [&] { return bytes_of(read_here(source, gmsh)); });
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
