#include "report/drawing.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "system/interruption.hpp"

namespace breccia::report {
namespace {

namespace fs = std::filesystem;

/// A folder that goes when this does.
class Scratch {
 public:
  Scratch() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "breccia-report-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code error;
    if (!path_.empty()) fs::remove_all(path_, error);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// As a shell would find it; empty: it does not.
fs::path program_named(const std::string& name) {
  const char* folders = std::getenv("PATH");
  std::string rest = folders != nullptr ? folders : "/usr/bin:/bin";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    fs::path file = fs::path(rest.substr(0, end)) / name;
    std::error_code error;
    if (fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0) return file;
    rest.erase(0, end + 1);
  }
  return {};
}

fs::path plugin_place() {
  if (const char* named = std::getenv("BRECCIA_PARAVIEW_PLUGIN"); named != nullptr && *named != '\0') return named;
  std::error_code error;
  const fs::path above = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  const fs::path inside = fs::path("lib") / "breccia" / "paraview" / "Breccia" / "Breccia.so";
  return fs::exists(above / "plugins" / inside, error) ? above / "plugins" / inside : above / inside;
}

bool has_display() {
  const char* display = std::getenv("DISPLAY");
  return display != nullptr && *display != '\0';
}

volatile std::sig_atomic_t drawing_group = 0;  // process group of the child; 0: none

void end_with_child(int signal) {
  if (drawing_group > 0) ::kill(-static_cast<pid_t>(drawing_group), SIGKILL);
  std::signal(signal, SIG_DFL);
  ::raise(signal);
}

void end_group(int) { ::kill(0, SIGKILL); }

/// Forks: the child continues; the caller waits for it and ends the whole process group when `parent` ends in any way,
/// so that no screen and no ParaView outlives it.
void guard_against_end_of(pid_t parent) {
  std::signal(SIGTERM, end_group);
  if (::prctl(PR_SET_PDEATHSIG, SIGTERM) != 0 || ::getppid() != parent) end_group(0);
  const pid_t guarded = ::fork();
  if (guarded < 0) ::_exit(127);
  if (guarded == 0) return;
  int status = 0;
  while (::waitpid(guarded, &status, 0) < 0 && errno == EINTR) {
  }
  ::_exit(WIFEXITED(status) ? WEXITSTATUS(status) : 126);
}

[[noreturn]] void become(const std::vector<std::string>& words, const fs::path& log, pid_t parent) {
  ::setpgid(0, 0);
  guard_against_end_of(parent);
  for (const int s : {SIGINT, SIGTERM, SIGHUP}) handle_unless_ignored(s, SIG_DFL);
  for (const int s : {SIGPIPE, SIGXFSZ}) ::signal(s, SIG_DFL);
  ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 0);  // frames are written once; a file system may have no locks
  const int nothing = ::open("/dev/null", O_RDONLY);
  const int said = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  ::dup2(nothing, 0);
  if (said >= 0) {
    ::dup2(said, 1);
    ::dup2(said, 2);
  }
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execv(argv.front(), argv.data());
  ::_exit(127);
}

enum class End { done, failed, out_of_time };

/// Runs a program with its words into `log`.
End run_program(const std::vector<std::string>& words, const fs::path& log, std::chrono::seconds limit) {
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) return End::failed;
  if (child == 0) become(words, log, parent);
  ::setpgid(child, child);
  drawing_group = child;
  for (const int s : {SIGINT, SIGTERM, SIGHUP}) handle_unless_ignored(s, end_with_child);
  const auto last = std::chrono::steady_clock::now() + limit;
  int status = 0;
  End end = End::done;
  for (;;) {
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) return End::failed;
    if (std::chrono::steady_clock::now() > last) {
      ::kill(-child, SIGKILL);
      end = End::out_of_time;
      while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ::kill(-child, SIGKILL);  // what it may have left behind
  drawing_group = 0;
  for (const int s : {SIGINT, SIGTERM, SIGHUP}) handle_unless_ignored(s, SIG_DFL);
  if (end == End::done && (!WIFEXITED(status) || WEXITSTATUS(status) != 0)) end = End::failed;
  return end;
}

/// The last non-empty line of the program, or else of ParaView's messages, which include errors of the script.
std::string last_words(const fs::path& log, const fs::path& messages) {
  std::string last;
  for (const fs::path& file : {messages, log}) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
      if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    }
  }
  return last.substr(0, 300);
}

Figures none(const std::string& why) {
  Figures figures;
  figures.missing = why;
  return figures;
}

}  // namespace

Figures draw_run(const fs::path& run, char up, std::chrono::seconds limit) {
  const fs::path python = program_named("pvpython"), screen = program_named("xvfb-run"), plugin = plugin_place();
  if (python.empty())
    return none("ParaView is not installed (no pvpython): apt-get install paraview python3-paraview xvfb xauth");
  const fs::path script = plugin.parent_path() / "draw_report.py";
  std::error_code error;
  for (const fs::path& file : {plugin, script}) {
    if (!fs::exists(file, error))
      return none(file.string() +
                  " is missing: `./run build` in Breccia's source folder makes it; among Debian "
                  "packages it is in breccia-insitu");
  }
  const Scratch scratch;
  if (scratch.path().empty()) return none("no temporary folder can be made; the environment's TMPDIR names its place");
  std::vector<std::string> words;
  if (!screen.empty()) words = {screen.string(), "-a", "-s", "-screen 0 1600x1000x24 -noreset"};
  const bool draws = !screen.empty() || has_display();
  words.insert(words.end(), {python.string(), script.string(), fs::absolute(run).string(), scratch.path().string(),
                             "--plugin", fs::absolute(plugin).string(), "--up", std::string(1, up)});
  if (!draws) words.emplace_back("--no-pictures");
  const fs::path log = scratch.path() / "said.log";
  const End end = run_program(words, log, limit);
  Figures figures = read_figures(scratch.path());
  if (end == End::out_of_time)
    figures.missing =
        fmt::format("ParaView took more than {} s and was ended; parts finished by then are shown", limit.count());
  else if (end == End::failed || figures.paraview.empty())
    figures.missing = "ParaView could not read or draw the run: " + last_words(log, scratch.path() / "messages.log");
  else if (!draws)
    figures.missing = "pictures need a screen: apt-get install xvfb xauth brings a virtual one";
  return figures;
}

}  // namespace breccia::report
