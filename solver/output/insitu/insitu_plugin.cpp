#include "output/insitu/insitu_plugin.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <system_error>

#include "base/error.hpp"
#include "output/insitu/insitu_config.hpp"

namespace breccia {
namespace {

using case_::InSituBackend;

/// What differs between the adaptors.
struct Adaptor {
  const char *library, *missing, *unloadable;
  int flags;
};

// The first one is global, so that ParaView's library finds the symbols of Python, which it uses but does not name.
// Lazy, as looking up at once what hundreds of libraries might call takes a second; the adaptor's own symbols are
// (catalyst/CMakeLists.txt).
constexpr Adaptor kParaView{
    "libbreccia_catalyst.so",
    "`./run build` in Breccia's source folder installs ParaView and builds it; among Debian packages it is "
    "breccia-insitu; the environment variable BRECCIA_CATALYST may name another place; with a ParaView that "
    "has Catalyst 2: insitu.backend = \"catalyst2\"",
    "the ParaView it was built with: apt-get install paraview python3-paraview", RTLD_LAZY | RTLD_GLOBAL};
constexpr Adaptor kCatalyst2{
    "libbreccia_catalyst2.so",
    "the build makes it beside the program, and the Debian package breccia brings it; the environment variable "
    "BRECCIA_CATALYST2 may name another place",
    "the MPI that the program was built with", RTLD_LAZY | RTLD_LOCAL};

const Adaptor& adaptor_of(InSituBackend backend) {
  return backend == InSituBackend::catalyst2 ? kCatalyst2 : kParaView;
}

OutputError cannot_open(const std::filesystem::path& file, const std::string& what, const std::string& remedy) {
  Problem problem;
  problem.file = file.string();
  problem.key = "insitu";
  problem.what = what;
  problem.allowed = remedy;
  return OutputError(problem);
}

}  // namespace

std::filesystem::path InSituPlugin::place(InSituBackend backend) {
  const Adaptor& adaptor = adaptor_of(backend);
  const char* const named =
      backend == InSituBackend::catalyst2 ? std::getenv("BRECCIA_CATALYST2") : std::getenv("BRECCIA_CATALYST");
  if (named != nullptr && *named != '\0') return named;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path above = program.parent_path().parent_path();
  const std::filesystem::path installed = above / "lib" / "breccia" / adaptor.library;
  const std::filesystem::path built = above / "catalyst" / adaptor.library;
  return std::filesystem::exists(built, error) ? built : installed;
}

InSituPlugin::InSituPlugin(InSituBackend backend) {
  if (backend != InSituBackend::automatic) {
    open(backend);
    return;
  }
  try {
    open(InSituBackend::paraview);
  } catch (const OutputError&) {
    // Missing parts of Catalyst 2 are reported only if a case selects it; usually ParaView's adaptor is meant.
    try {
      open(InSituBackend::catalyst2);
      static_cast<void>(found());
      return;
    } catch (const OutputError&) {
      api_ = nullptr;
    }
    throw;
  }
}

void InSituPlugin::open(InSituBackend backend) {
  const Adaptor& adaptor = adaptor_of(backend);
  const std::filesystem::path file = place(backend);
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw cannot_open(file, "the in-situ adaptor is not installed", adaptor.missing);
  void* library = ::dlopen(file.c_str(), adaptor.flags);
  if (library == nullptr) {
    const char* why = ::dlerror();
    throw cannot_open(file,
                      "the in-situ adaptor cannot be loaded: " + std::string(why != nullptr ? why : "unknown reason"),
                      adaptor.unloadable);
  }
  using Entry = const BrecciaInsituApi* (*)();
  const auto entry = reinterpret_cast<Entry>(::dlsym(library, "breccia_insitu_api"));
  if (entry != nullptr) api_ = entry();
  if (api_ == nullptr || api_->abi_version != BRECCIA_INSITU_ABI_VERSION) {
    throw cannot_open(file, "the in-situ adaptor is of another version than the solver",
                      "version " + std::to_string(BRECCIA_INSITU_ABI_VERSION) + ": build both together");
  }
}

std::string InSituPlugin::found() const {
  std::int32_t result = 0;
  std::string text = answer_of([&](char* words, std::size_t size) { result = api_->find(words, size); });
  if (result != 0) throw cannot_open({}, text, "");
  return text;
}

}  // namespace breccia
