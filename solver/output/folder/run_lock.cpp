#include "output/folder/run_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <sstream>
#include <string_view>

#include "output/folder/run_folder.hpp"
#include "system/atomic_file.hpp"
#include "system/interruption.hpp"
#include "system/regular_file.hpp"

namespace breccia {
namespace {

constexpr char kErrorReported = '\1';   // from the run to its watch: an error has been reported
constexpr std::size_t kTail = 1 << 14;  // bytes at the end of status.jsonl that hold its last line

/// Owner of the lock file: "process 17 on host, since TIME".
std::string owner_in(const Descriptor& file) {
  std::array<char, 300> text{};
  const ssize_t got = ::pread(file.get(), text.data(), text.size(), 0);
  const std::string_view line(text.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  return line.empty() ? "another process" : std::string(line.substr(0, line.find('\n')));
}

/// Where the file system knows no locks: a process of this machine that is still there.
bool owner_lives(const std::string& owner) {
  std::istringstream words(owner);
  std::string process, on, host;
  pid_t id = 0;
  words >> process >> id >> on >> host;
  if (process != "process" || id <= 0 || host != collect_provenance("", {}).host + ",") return false;
  return id != ::getpid() && (::kill(id, 0) == 0 || errno == EPERM);
}

bool no_locks_here(int error) { return error == ENOLCK || error == EOPNOTSUPP || error == ENOSYS || error == EINVAL; }

// --- In the watch: nothing but system calls, for it is a copy of a process with threads

bool says(std::string_view line, std::string_view what) { return line.find(what) != std::string_view::npos; }

/// Appends the final status of a run that has ended. The caller has the lock.
void conclude(const char* status, bool failed) {
  const int file = ::open(status, O_RDWR | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) return;
  struct stat about {};
  if (::fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) {
    ::close(file);
    return;
  }
  static std::array<char, kTail> tail;
  const off_t size = ::lseek(file, 0, SEEK_END);
  const off_t from = size > static_cast<off_t>(kTail) ? size - static_cast<off_t>(kTail) : 0;
  const ssize_t got = ::pread(file, tail.data(), tail.size(), from);
  if (got >= 0) {
    std::string_view text(tail.data(), static_cast<std::size_t>(got));
    const bool whole = text.empty() || text.back() == '\n';
    if (!whole) text = text.substr(0, text.rfind('\n') + 1);  // a truncated line is ignored
    const std::size_t last = text.rfind("{\"state\":");
    const std::string_view state = last == std::string_view::npos ? "" : text.substr(last, 24);
    // Without a line: it has not come to its first step.
    if (state.empty() || says(state, "\"running\"") || says(state, "\"paused\"")) {
      const char* line = failed ? "{\"state\":\"failed\",\"message\":\"ended by an error, which is on stderr\"}\n"
                                : "{\"state\":\"interrupted\",\"message\":\"the process ended without a word: killed, "
                                  "or the machine stopped it\"}\n";
      if (!whole) (void)!::write(file, "\n", 1);
      (void)!::write(file, line, std::strlen(line));
    }
  }
  ::close(file);
}

[[noreturn]] void watch(int pipe) {
  ::setsid();
  for (const int s : kEndingSignals) ::signal(s, SIG_IGN);
  for (const int s : {SIGPIPE, SIGUSR1}) ::signal(s, SIG_IGN);
  ::dup2(pipe, 3);
  if (::syscall(SYS_close_range, 4U, ~0U, 0U) != 0) {
    for (int d = 4; d < 65536; ++d) ::close(d);
  }
  for (const int d : {0, 1, 2}) ::close(d);
  static std::array<char, 1 << 13> received;  // two paths, each ended by a zero, then perhaps kErrorReported
  std::size_t size = 0;
  for (;;) {
    const ssize_t got = ::read(3, received.data() + size, received.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    size += static_cast<std::size_t>(got);
  }
  const auto* first_end = static_cast<const char*>(std::memchr(received.data(), 0, size));
  if (first_end == nullptr) ::_exit(0);
  const char* status = first_end + 1;
  const auto* second_end =
      static_cast<const char*>(std::memchr(status, 0, size - static_cast<std::size_t>(status - received.data())));
  if (second_end == nullptr) ::_exit(0);
  const bool failed = second_end + 1 < received.data() + size && second_end[1] == kErrorReported;
  const int lock = ::open(received.data(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  // A process that ends closes the pipe and releases the lock one after the other. If the lock stays taken, another run
  // has begun in this folder, and the file is that run's.
  bool ours = false;
  for (int look = 0; lock >= 0 && !ours && look < 200; ++look) {
    ours = ::flock(lock, LOCK_EX | LOCK_NB) == 0 || no_locks_here(errno);
    if (!ours) ::usleep(10000);
  }
  if (ours) conclude(status, failed);
  ::_exit(0);
}

void send(int pipe, std::string_view bytes) { (void)!::write(pipe, bytes.data(), bytes.size()); }

}  // namespace

std::filesystem::path lock_file(const std::filesystem::path& folder) { return folder / "run.lock"; }

std::string owner_words(const std::string& process) {
  const Provenance now = collect_provenance("", {});
  return "process " + process + " on " + now.host + ", since " + now.started;
}

RunLock::RunLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = lock_file(folder);
  Opened opened = open_regular(file, O_RDWR | O_CREAT, Depth::file, 0644);
  if (!opened) throw output_error(file, "cannot write this file: " + opened.reason);
  const bool locked = ::flock(opened.descriptor.get(), LOCK_EX | LOCK_NB) == 0;
  const bool taken = !locked && (!no_locks_here(errno) || owner_lives(owner_in(opened.descriptor)));
  if (taken) {
    throw OutputError(Problem{folder.string(), 0, "", "another run writes here: " + owner_in(opened.descriptor),
                              "another folder, or this one when that run has ended", ""});
  }
  descriptor_ = opened.descriptor.release();
  const std::string words = owner_words(std::to_string(::getpid())) + "\n";
  (void)!::ftruncate(descriptor_, 0);
  (void)!::pwrite(descriptor_, words.data(), words.size(), 0);
}

RunLock::~RunLock() { ::close(descriptor_); }

std::string holder_of(const std::filesystem::path& folder) {
  const std::filesystem::path file = lock_file(folder);
  const Opened opened = open_regular(file, O_RDONLY, Depth::file);
  if (!opened) return {};
  const bool free = ::flock(opened.descriptor.get(), LOCK_SH | LOCK_NB) == 0;
  const int error = errno;
  if (free) return {};
  const std::string owner = owner_in(opened.descriptor);
  return no_locks_here(error) && !owner_lives(owner) ? std::string() : owner;
}

RunWatch::RunWatch() : exceptions_(std::uncaught_exceptions()) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
  const pid_t middle = ::fork();
  if (middle == 0) {
    ::close(ends[1]);
    if (::fork() == 0) watch(ends[0]);  // a grandchild: no process has to wait for it
    ::_exit(0);
  }
  ::close(ends[0]);
  pipe_ = ends[1];
  if (middle > 0) {
    while (::waitpid(middle, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
}

RunWatch::~RunWatch() {
  if (pipe_ < 0) return;
  if (std::uncaught_exceptions() > exceptions_) send(pipe_, std::string_view(&kErrorReported, 1));
  ::close(pipe_);
}

void RunWatch::guard(const std::filesystem::path& folder) const {
  const std::filesystem::path whole = std::filesystem::absolute(folder);
  const std::string lock = lock_file(whole).string(), status = RunFolder{whole}.status().string();
  if (pipe_ < 0 || lock.size() + status.size() > 8000) return;
  send(pipe_, std::string_view(lock.c_str(), lock.size() + 1));
  send(pipe_, std::string_view(status.c_str(), status.size() + 1));
}

}  // namespace breccia
