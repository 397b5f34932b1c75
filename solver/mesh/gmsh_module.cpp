#include <dlfcn.h>

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/version.hpp"
#include "mesh/gmsh/module.hpp"

namespace breccia {
namespace {

constexpr const char* kLibrary = "libbreccia_gmsh.so";

const GmshModule& load_module() {
  const auto refuse = [](const std::string& what, const std::string& allowed) {
    throw OutputError(Problem{kLibrary, 0, "mesh.file", what, allowed, ""});
  };
  // Found by the RUNPATH of the program. Lazy, as gmsh's libraries name many functions that no mesh calls.
  void* const library = ::dlopen(kLibrary, RTLD_LAZY | RTLD_LOCAL);
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
