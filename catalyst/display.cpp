#include "catalyst/display.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "catalyst/child_process.hpp"
#include "catalyst/pipeline_error.hpp"

namespace breccia::insitu {
namespace {

constexpr int kStartMs = 15000;  // a busy machine may take seconds to start a server

/// What runs in the child: becomes Xvfb or ends. Only functions that are safe after fork.
[[noreturn]] void become_xvfb(int number_end, pid_t parent, const char* number) {
  // With the run whatever happens to it, but not by the Ctrl-C of its terminal: the last pictures still need it.
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);
  ::setpgid(0, 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGPIPE}) ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = ::open("/dev/null", O_RDWR);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(nothing, STDERR_FILENO);
  ::fcntl(number_end, F_SETFD, 0);
  // -noreset: it must outlive its first client.
  ::execlp("Xvfb", "Xvfb", "-displayfd", number, "-noreset", "-nolisten", "tcp", "-screen", "0", "1600x1000x24",
           nullptr);
  ::_exit(127);
}

/// The line that Xvfb writes when it is ready: the number of its display. Empty when none came in time.
std::string read_number(int end) {
  std::string line;
  char c = 0;
  for (int waited = 0; waited < kStartMs;) {
    pollfd ready{end, POLLIN, 0};
    const int count = ::poll(&ready, 1, 100);
    if (count <= 0) {
      waited += 100;
      continue;
    }
    if (::read(end, &c, 1) != 1) return {};
    if (c == '\n') return line;
    line += c;
  }
  return {};
}

void stop(pid_t child) {
  ::kill(child, SIGTERM);
  for (int tenths = 0; tenths < 30; ++tenths) {
    const pid_t ended = ::waitpid(child, nullptr, WNOHANG);
    if (ended == child || (ended < 0 && errno == ECHILD)) return;
    ::usleep(100000);
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

/// Starts it and returns ":number". Throws PipelineError.
std::string start_xvfb(pid_t& child) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw PipelineError(std::string("Xvfb cannot be started: ") + std::strerror(errno));
  const std::string number = std::to_string(ends[1]);
  const pid_t parent = ::getpid();
  child = ::fork();
  if (child == 0) become_xvfb(ends[1], parent, number.c_str());
  ::close(ends[1]);
  const std::string display = child < 0 ? std::string() : read_number(ends[0]);
  ::close(ends[0]);
  if (!display.empty()) return ":" + display;
  if (child > 0) stop(child);
  child = 0;
  throw PipelineError("Xvfb did not start");
}

}  // namespace

bool display_opens() {
  const char* name = std::getenv("DISPLAY");
  if (name == nullptr || *name == '\0') return false;
  // Opened here instead of linked: an adaptor that draws nothing itself needs no X.
  void* const xlib = ::dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);
  if (xlib == nullptr) return false;
  using Open = void* (*)(const char*);
  using Close = int (*)(void*);
  const auto open = reinterpret_cast<Open>(::dlsym(xlib, "XOpenDisplay"));
  const auto close = reinterpret_cast<Close>(::dlsym(xlib, "XCloseDisplay"));
  void* const display = open == nullptr || close == nullptr ? nullptr : open(nullptr);
  if (display != nullptr) close(display);
  return display != nullptr;  // the library stays: it does not survive being unloaded
}

std::string display_problem() {
  if (is_on_path("Xvfb") || display_opens()) return {};
  return "pictures need an X display: none opens and Xvfb is not installed (Debian: apt-get install xvfb)";
}

Display::Display(const Ranks& ranks) : ranks_(ranks) {
  // A display on every rank of all machines, or our own on all of them: mixtures draw differently.
  if (ranks.agree(display_opens() ? "" : "none").empty()) return;
  std::string error;
  std::string name;
  if (ranks.is_first_of_machine()) {
    try {
      if (const std::string problem = display_problem(); !problem.empty()) throw PipelineError(problem);
      name = start_xvfb(xvfb_);
    } catch (const PipelineError& failure) {
      error = failure.what();
    }
  }
  name = ranks.from_first_of_machine(name);
  error = ranks.agree(error);
  if (!error.empty()) {
    if (xvfb_ > 0) stop(xvfb_);
    throw PipelineError(error);
  }
  const char* old = std::getenv("DISPLAY");
  was_set_ = old != nullptr;
  old_ = was_set_ ? old : "";
  replaced_ = true;
  ::setenv("DISPLAY", name.c_str(), 1);
}

Display::~Display() {
  if (replaced_ && was_set_) ::setenv("DISPLAY", old_.c_str(), 1);
  if (replaced_ && !was_set_) ::unsetenv("DISPLAY");
  if (!replaced_) return;
  static_cast<void>(
      ranks_.agree(""));  // others may still be taking leave of it, and Xlib ends a process whose server has gone
  if (xvfb_ > 0) stop(xvfb_);
}

}  // namespace breccia::insitu
