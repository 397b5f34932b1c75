#include <dlfcn.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "base/version.hpp"
#include "mesh/gmsh/module.hpp"

namespace breccia {
namespace {

constexpr const char* kLibrary = "libbreccia_gmsh.so";

/// The module in the folders where the system searches for libraries of the program, its RUNPATH among them; without a
/// folder where it is in none. They are searched here, as a sanitizer calls dlopen in place of the program.
std::filesystem::path library_file() {
  void* const program = ::dlopen(nullptr, RTLD_LAZY);
  Dl_serinfo size{};
  if (program == nullptr || ::dlinfo(program, RTLD_DI_SERINFOSIZE, &size) != 0) return kLibrary;
  std::vector<std::max_align_t> memory(size.dls_size / sizeof(std::max_align_t) + 1);
  auto* const folders = reinterpret_cast<Dl_serinfo*>(memory.data());
  if (::dlinfo(program, RTLD_DI_SERINFOSIZE, folders) != 0 || ::dlinfo(program, RTLD_DI_SERINFO, folders) != 0)
    return kLibrary;
  std::error_code error;
  for (unsigned f = 0; f < folders->dls_cnt; ++f) {
    const std::filesystem::path file = std::filesystem::path(folders->dls_serpath[f].dls_name) / kLibrary;
    if (std::filesystem::exists(file, error)) return file;
  }
  return kLibrary;
}

const GmshModule& load_module() {
  const auto refuse = [](const std::string& what, const std::string& allowed) {
    throw OutputError(Problem{kLibrary, 0, "mesh.file", what, allowed, ""});
  };
  // Lazy, as gmsh's libraries name many functions that no mesh calls.
  void* const library = ::dlopen(library_file().c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) {
    const char* const why = ::dlerror();
    refuse(std::string("the library that reads meshes with gmsh cannot be loaded: ") + (why != nullptr ? why : ""),
           "the file that is built and installed with the program, in lib/breccia, and gmsh's own library");
  }
  const auto entry = reinterpret_cast<decltype(&breccia_gmsh_module)>(::dlsym(library, "breccia_gmsh_module"));
  const GmshModule* const module = entry != nullptr ? entry() : nullptr;
  if (module == nullptr || module->version != std::string_view(program_version()))
    refuse("the library that reads meshes with gmsh is of another version than the program", program_version());
  return *module;
}

}  // namespace

const GmshModule& gmsh_module() {
  static const GmshModule& module = load_module();
  return module;
}

}  // namespace breccia
