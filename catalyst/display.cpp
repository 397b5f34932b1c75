#include "catalyst/display.hpp"

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
#include "catalyst/xlib.hpp"

namespace breccia::insitu {
namespace {

constexpr int kStartMs = 15000;  // a busy machine may take seconds to start a server

/// What runs in the child: becomes Xvfb or ends. Only functions that are safe after fork.
[[noreturn]] void become_xvfb(int number_end, pid_t parent, const char* number) {
  // Ends with the run in any case, but not by the Ctrl-C of its terminal: the last pictures still need it.
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

/// "" when an X display can be drawn on; else what is wrong with it. ParaView ends the process where that is not so.
std::string fault_of(const Xlib& x, const char* name) {
  void* const display = x.open_display(name);
  if (display == nullptr) return "does not open";
  int opcode = 0, event = 0, error = 0;
  const bool has = x.query_extension(display, "GLX", &opcode, &event, &error) != 0;
  x.close_display(display);
  return has ? "" : "has no GLX, without which nothing can be drawn";
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

constexpr const char* kInstall = " and Xvfb is not installed (Debian: apt-get install xvfb)";

/// Xlib's own ends the process.
int take_error(void*, void*) { return 0; }
int take_loss(void*) { return 0; }
void go_on(void*, void*) {}

}  // namespace

// BRECCIA_DISPLAY: a display chosen for the pictures, where a graphics card is to draw.
std::string display_problem() {
  const Xlib* const x = xlib();
  if (x == nullptr) return "pictures need an X display: libX11.so.6 cannot be used (Debian: apt-get install libx11-6)";
  if (const std::string chosen = environment("BRECCIA_DISPLAY"); !chosen.empty()) {
    const std::string fault = fault_of(*x, chosen.c_str());
    return fault.empty() ? "" : "pictures need an X display: " + chosen + ", of BRECCIA_DISPLAY, " + fault;
  }
  if (is_on_path("Xvfb")) return {};
  const std::string given = environment("DISPLAY");
  if (given.empty()) return std::string("pictures need an X display: none opens") + kInstall;
  const std::string fault = fault_of(*x, given.c_str());
  return fault.empty() ? "" : "pictures need an X display: " + given + " " + fault + kInstall;
}

void spare_process(void* display) {
  if (display != nullptr && xlib() != nullptr) xlib()->set_io_error_exit_handler(display, &go_on, nullptr);
}

Display::Display(const Ranks& ranks) : ranks_(ranks) {
  ranks.throw_agreed(display_problem());
  const Xlib& x = *xlib();  // there is one, or there was a problem
  x.set_error_handler(&take_error);
  x.set_io_error_handler(&take_loss);
  // Our own on all ranks, or that of each: mixtures draw differently.
  const std::string chosen = environment("BRECCIA_DISPLAY");
  if (!chosen.empty()) {
    set(chosen);
  } else if (ranks.agree(is_on_path("Xvfb") ? "" : "none").empty()) {
    start_own();
  }
  link_ = x.open_display(nullptr);
  spare_process(link_);
}

void Display::set(const std::string& name) {
  const char* old = std::getenv("DISPLAY");
  was_set_ = old != nullptr;
  old_ = was_set_ ? old : "";
  replaced_ = true;
  ::setenv("DISPLAY", name.c_str(), 1);
}

void Display::start_own() {
  std::string error;
  std::string name;
  if (ranks_.is_first_of_machine()) {
    try {
      name = start_xvfb(xvfb_);
    } catch (const PipelineError& failure) {
      error = failure.what();
    }
  }
  name = ranks_.from_first_of_machine(name);
  error = ranks_.agree(error);
  if (!error.empty()) {
    if (xvfb_ > 0) stop(xvfb_);
    throw PipelineError(error);
  }
  set(name);
}

bool Display::lost() const {
  if (link_ == nullptr) return true;
  pollfd link{xlib()->connection_number(link_), POLLIN | POLLRDHUP, 0};
  if (::poll(&link, 1, 0) <= 0) return false;
  return (link.revents & (POLLHUP | POLLRDHUP | POLLERR | POLLNVAL)) != 0;
}

Display::~Display() {
  if (link_ != nullptr) xlib()->close_display(link_);
  if (replaced_ && was_set_) ::setenv("DISPLAY", old_.c_str(), 1);
  if (replaced_ && !was_set_) ::unsetenv("DISPLAY");
  if (!replaced_) return;
  static_cast<void>(ranks_.agree(
      ""));  // others may still be closing their connection, and Xlib ends a process whose server has closed
  if (xvfb_ > 0) stop(xvfb_);
}

}  // namespace breccia::insitu
