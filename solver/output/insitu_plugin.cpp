#include "output/insitu_plugin.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <string>
#include <system_error>

#include "base/error.hpp"

namespace breccia {
namespace {

constexpr const char* kLibrary = "libbreccia_catalyst.so";

OutputError cannot_open(const std::filesystem::path& file, const std::string& what, const std::string& remedy) {
  Problem problem;
  problem.file = file.string();
  problem.key = "insitu";
  problem.what = what;
  problem.allowed = remedy;
  return OutputError(problem);
}

}  // namespace

std::filesystem::path InSituPlugin::place() {
  if (const char* named = std::getenv("BRECCIA_CATALYST"); named != nullptr && *named != '\0') return named;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path above = program.parent_path().parent_path();
  const std::filesystem::path installed = above / "lib" / "breccia" / kLibrary, built = above / "catalyst" / kLibrary;
  return std::filesystem::exists(built, error) ? built : installed;
}

InSituPlugin::InSituPlugin() {
  const std::filesystem::path file = place();
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw cannot_open(file, "the in-situ adaptor is not installed",
                      "`./run build` in Breccia's source folder installs ParaView and builds it; among Debian packages "
                      "it is breccia-insitu; "
                      "the environment variable BRECCIA_CATALYST may name another place");
  }
  // Global, so that ParaView's library finds the symbols of Python, which it uses but does not name. Lazy, as looking
  // up at once what hundreds of libraries might call takes a second; the adaptor's own symbols are
  // (catalyst/CMakeLists.txt).
  void* library = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_GLOBAL);
  if (library == nullptr) {
    const char* why = ::dlerror();
    throw cannot_open(file,
                      "the in-situ adaptor cannot be loaded: " + std::string(why != nullptr ? why : "unknown reason"),
                      "the ParaView it was built with: apt-get install paraview python3-paraview");
  }
  using Entry = const BrecciaInsituApi* (*)();
  const auto entry = reinterpret_cast<Entry>(::dlsym(library, "breccia_insitu_api"));
  if (entry != nullptr) api_ = entry();
  if (api_ == nullptr || api_->abi_version != BRECCIA_INSITU_ABI_VERSION) {
    throw cannot_open(file, "the in-situ adaptor is of another version than the solver",
                      "version " + std::to_string(BRECCIA_INSITU_ABI_VERSION) + ": build both together");
  }
}

}  // namespace breccia
