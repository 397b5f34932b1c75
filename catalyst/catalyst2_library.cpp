#include "catalyst/catalyst2_library.hpp"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <vector>

#include "catalyst/pipeline_error.hpp"

namespace breccia::insitu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "libcatalyst.so.3";
constexpr const char* kPaths = "CATALYST_IMPLEMENTATION_PATHS";
constexpr const char* kRemedy =
    "install a ParaView from 5.12 on that is built with Catalyst, and name its libcatalyst by "
    "BRECCIA_LIBCATALYST or LD_LIBRARY_PATH";

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::vector<fs::path> implementation_paths() {
  std::vector<fs::path> folders;
  std::istringstream list(variable(kPaths));
  for (std::string folder; std::getline(list, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

/// What to try, in this order; a single one where the user names it.
std::vector<fs::path> candidates() {
  if (const char* const named = std::getenv("BRECCIA_LIBCATALYST"); named != nullptr && *named != '\0') return {named};
  std::vector<fs::path> files{kName};
  for (const fs::path& folder : implementation_paths()) {
    files.push_back(folder / kName);
    files.push_back((folder / ".." / kName).lexically_normal());  // beside lib/catalyst in a ParaView
  }
  return files;
}

fs::path file_of(const void* symbol, const fs::path& asked) {
  Dl_info info{};
  return ::dladdr(symbol, &info) != 0 && info.dli_fname != nullptr ? fs::path(info.dli_fname) : asked;
}

}  // namespace

Catalyst2Library::Catalyst2Library() {
  void* library = nullptr;
  std::string reasons;
  for (const fs::path& file : candidates()) {
    // Global: libcatalyst searches its own functions there to find the implementations beside itself.
    library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
    file_ = file;
    if (library != nullptr) break;
    const char* const why = ::dlerror();
    reasons += (reasons.empty() ? "" : "; ") + std::string(why == nullptr ? file.string() + ": unknown reason" : why);
  }
  if (library == nullptr)
    throw PipelineError("libcatalyst, the library of Catalyst 2, cannot be opened (" + reasons + "): " + kRemedy);
  if (const std::vector<std::string> lacking = functions_.take_from(library); !lacking.empty()) {
    std::string names;
    for (const std::string& name : lacking) names += (names.empty() ? "" : ", ") + name;
    throw PipelineError(file_.string() + " is no libcatalyst of version 2, it lacks " + names + ": " + kRemedy);
  }
  file_ = file_of(reinterpret_cast<const void*>(functions_.initialize), file_);
  const std::string named = variable("CATALYST_IMPLEMENTATION_NAME");
  implementation_ = named.empty() ? kParaView : named;
}

fs::path Catalyst2Library::implementation_file() const {
  std::vector<fs::path> folders = implementation_paths();
  folders.push_back(file_.parent_path() / "catalyst");
  std::string tried;
  for (const fs::path& folder : folders) {
    const fs::path file = folder / ("libcatalyst-" + implementation_ + ".so");
    std::error_code error;
    if (fs::exists(file, error)) return file;
    tried += (tried.empty() ? "" : ", ") + file.string();
  }
  throw PipelineError("libcatalyst (" + file_.string() + ") has no implementation '" + implementation_ + "'; tried " +
                      tried +
                      ": CATALYST_IMPLEMENTATION_NAME "
                      "names one, CATALYST_IMPLEMENTATION_PATHS the folder of its file");
}

std::string words_of_status(int status) {
  static constexpr std::array kMeaning{"",
                                       "no implementation is loaded",
                                       "an implementation is loaded already",
                                       "the implementation is not found",
                                       "the file is no implementation of Catalyst",
                                       "the implementation lacks functions",
                                       "the implementation is of another version"};
  const auto i = static_cast<std::size_t>(status);
  const bool known = status > 0 && i < kMeaning.size();
  return std::to_string(status) + (known ? std::string(" (") + kMeaning.at(i) + ")" : "");
}

}  // namespace breccia::insitu
