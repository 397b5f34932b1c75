#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <fmt/format.h>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "base/error.hpp"
#include "case/live_address.hpp"
#include "case/reader.hpp"
#include "commands/commands.hpp"
#include "commands/terminal.hpp"
#include "output/insitu/insitu_config.hpp"
#include "output/insitu/insitu_plugin.hpp"
#include "system/atomic_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// What our ParaView begins with, each where its word does not occur in the settings yet.
struct Setting {
  const char *word, *lines;
};
constexpr std::array kSettings{
    Setting{"ShowWelcomeDialog", "[General]\nGeneralSettings.ShowWelcomeDialog=false\n"},
    Setting{"[MainWindow]", "[MainWindow]\nSize=@Size(1600 1000)\n"},
};

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

void set(const char* name, const std::string& value) { ::setenv(name, value.c_str(), 1); }

void prepend(const char* name, const std::string& value) {
  const std::string old = variable(name);
  set(name, old.empty() ? value : value + ":" + old);
}

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A folder of settings that starts as a copy of the user's, shows no welcome, and has the buttons of the view; the
/// user's own stay as they are. What cannot be written is left out: ParaView opens all the same.
fs::path settings_folder(const std::string& paraview_version, const fs::path& macros) {
  const std::string given = variable("XDG_CONFIG_HOME");
  const fs::path users = given.empty() ? fs::path(variable("HOME")) / ".config" : fs::path(given);
  fs::path ours = users / "breccia";
  const fs::path folder = ours / "ParaView";
  std::error_code error;
  if (!fs::exists(folder, error)) {
    fs::create_directories(folder, error);
    fs::copy(users / "ParaView", folder, fs::copy_options::recursive, error);  // there may be none
  }
  fs::create_directories(folder / "Macros", error);
  fs::copy(macros, folder / "Macros", fs::copy_options::recursive | fs::copy_options::overwrite_existing, error);
  const fs::path file = folder / ("ParaView" + paraview_version + ".ini");
  const std::string old = content(file);
  for (const Setting& setting : kSettings) {
    if (old.find(setting.word) == std::string::npos) std::ofstream(file, std::ios::app) << setting.lines;
  }
  return ours;
}

/// ParaView's ports, and those of the MPI that it starts, are reached from this machine only. Throws OutputError when
/// the library that does it is not there.
void keep_on_this_machine() {
  const fs::path library = InSituPlugin::place(case_::InSituBackend::paraview).parent_path() / "libbreccia_loopback.so";
  if (!fs::exists(library)) throw output_error(library, "cannot be loaded into ParaView", ENOENT);
  prepend("LD_PRELOAD", library.string());
  for (const char* name : {"OMPI_MCA_oob_tcp_if_include", "PMIX_MCA_ptl_tcp_if_include"}) set(name, "lo");
  set("OMPI_MCA_pml", "ob1");  // it is one process and sends itself nothing over a network
  set("OMPI_MCA_btl", "self,vader");
}

/// Throws OutputError when another program listens at the port already, which ParaView would not report.
void demand_free(int port) {
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  ::setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(port));
  const bool is_free = ::bind(listener, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0;
  const int why = errno;
  ::close(listener);
  if (!is_free)
    throw output_error("port " + std::to_string(port), "ParaView cannot listen there; set insitu.live.address", why);
}

/// Whether an X server listens at a socket of this machine. @param abstract  a name without a file
bool listens_at(const std::string& path, bool abstract) {
  sockaddr_un place{};
  place.sun_family = AF_UNIX;
  const std::size_t begin = abstract ? 1 : 0;
  if (begin + path.size() >= sizeof place.sun_path) return false;
  path.copy(place.sun_path + begin, path.size());
  const int client = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + begin + path.size());
  const bool listens = ::connect(client, reinterpret_cast<const sockaddr*>(&place), length) == 0;
  ::close(client);
  return listens;
}

/// Throws OutputError where ParaView's window would have no display, on which Qt aborts. Displays of other machines
/// (ssh -X among them) are not tried.
void demand_display() {
  if (!variable("WAYLAND_DISPLAY").empty() || !variable("QT_QPA_PLATFORM").empty()) return;
  const std::string display = variable("DISPLAY");
  const bool is_local = display.starts_with(':');
  const std::string path =
      "/tmp/.X11-unix/X" + display.substr(is_local ? 1 : 0, display.find('.') - (is_local ? 1 : 0));
  if (!display.empty() && (!is_local || listens_at(path, false) || listens_at(path, true))) return;
  throw OutputError(Problem{"paraview", 0, "DISPLAY", "there is no display for its window",
                            "one of a desktop or of ssh -X; or xvfb-run before the command", display});
}

/// Data of the run for the view.
void describe(const case_::Case& input, int port) {
  const InSituConfig config(input, ".", {});
  set("BRECCIA_LIVE_PORT", std::to_string(port));
  set("BRECCIA_LIVE_TITLE", input.title);
  set("BRECCIA_LIVE_END", fmt::format("{:.17g}", config.get().end));
  std::error_code error;
  set("BRECCIA_LIVE_PROGRAM", fs::read_symlink("/proc/self/exe", error).string());
  set("BRECCIA_LIVE_STRENGTH", fmt::format("{:.17g}", config.get().strength));
}

}  // namespace

int live_command(const LiveCommand& asked) {
  const case_::Case input = case_::read_case(asked.case_file, asked.overrides);
  const std::string address = input.insitu.live ? input.insitu.live->address : case_::live_address;
  const int port = case_::host_and_port(address)->second;
  demand_free(port);
  demand_display();
  const InSituPlugin plugin(case_::InSituBackend::paraview);
  const fs::path data = plugin.api().data_folder;
  const std::string description = plugin.api().description;
  describe(input, port);
  prepend("PYTHONPATH", (data / "pipelines").string());
  prepend("PYTHONPATH", (data / "python").string());
  const std::string version = description.substr(description.rfind(' ') + 1);
  set("XDG_CONFIG_HOME", settings_folder(version, data / "python" / "macros").string());
  if (!input.insitu.live || !input.insitu.live->remote) keep_on_this_machine();
  print_lines(fmt::format("ParaView listens at port {}; start the run, before or afterwards: breccia run {} --live{}\n",
                          port, asked.case_file.string(), address == case_::live_address ? "" : "=" + address));
  std::fflush(stdout);
  const std::string script = "--script=" + (data / "python" / "open_live_view.py").string();
  ::execlp("paraview", "paraview", script.c_str(), static_cast<char*>(nullptr));
  throw output_error("paraview", "cannot be started; apt-get install paraview brings it", errno);
}

}  // namespace breccia
