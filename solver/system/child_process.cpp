#include "system/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <span>
#include <string_view>

#include "base/error.hpp"
#include "system/confinement.hpp"
#include "system/control_group.hpp"
#include "system/file_access.hpp"
#include "system/interruption.hpp"
#include "system/write_all.hpp"

namespace breccia {
namespace {

// First byte of what a child reports; kForbiddenMark is one of them too.
constexpr char kResult = 'R', kNoMemory = 'M', kNotConfined = 'N';
constexpr int kPollInterval = 50;  // ms between two checks of clock, memory and signals

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kAddressSpaceCanBeLimited = false;  // the sanitizer reserves terabytes of addresses
#else
constexpr bool kAddressSpaceCanBeLimited = true;
#endif

std::uint64_t page() { return static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)); }

/// Column 0: address space, column 1: resident memory; bytes. 0 if unknown.
std::uint64_t memory_of(pid_t process, int column) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  std::uint64_t pages = 0;
  for (int c = 0; c <= column; ++c) {
    if (!(file >> pages)) return 0;
  }
  return pages * page();
}

[[noreturn]] void refuse(const std::string& what) {
  throw OutputError(Problem{"", 0, "", what + ": " + std::strerror(errno), "a system that lets one be started", ""});
}

struct Pipe {
  int reading = -1, writing = -1;
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse("a pipe to a child process cannot be opened");
    reading = ends[0];
    writing = ends[1];
  }
  ~Pipe() {
    close_writing();
    ::close(reading);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_writing() {
    if (writing >= 0) ::close(writing);
    writing = -1;
  }
};

/// In the child, whose end reports the failure to the parent.
void write_or_end(int descriptor, std::span<const std::byte> bytes) {
  if (write_all(descriptor, bytes) != 0) ::_exit(1);
}

void write_mark(int descriptor, char mark) { write_or_end(descriptor, std::as_bytes(std::span(&mark, 1))); }

template <class Resource>
void limit(Resource what, std::uint64_t value) {
  const rlimit limits{static_cast<rlim_t>(value), static_cast<rlim_t>(value)};
  ::setrlimit(what, &limits);
}

/// Moves the descriptors the child keeps to 1, 2, 3 and kKeptDescriptor and closes all others.
/// @param kept  -1: none
void keep_descriptors(int report, int words, int kept) {
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  const int high_report = ::fcntl(report, F_DUPFD, 10), high_words = ::fcntl(words, F_DUPFD, 10);
  const int high_kept = kept < 0 ? -1 : ::fcntl(kept, F_DUPFD, 10);
  ::dup2(nothing, 0);
  ::dup2(high_words, 1);
  ::dup2(high_words, 2);
  ::dup3(high_report, 3, O_CLOEXEC);  // a program that a trusted script leaves running must not keep it open
  int first_closed = kKeptDescriptor;
  if (high_kept >= 0) ::dup3(high_kept, first_closed++, O_CLOEXEC);
  if (::syscall(SYS_close_range, static_cast<unsigned>(first_closed), ~0U, 0U) != 0) {
    for (int d = first_closed; d < 65536; ++d) ::close(d);  // an older kernel
  }
}

[[noreturn]] void child(const ChildLimits& limits, pid_t parent, int report, int words,
                        const std::function<void()>& prepare, const std::function<std::vector<std::byte>()>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  for (const int s : kEndingSignals) ::signal(s, SIG_DFL);
  for (const int s : {SIGPIPE, SIGXFSZ, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) ::signal(s, SIG_DFL);
  keep_descriptors(report, words, limits.kept);
  constexpr int kReport = 3;
  limit(RLIMIT_CORE, 0);
  if (limits.bytes > 0 && kAddressSpaceCanBeLimited) limit(RLIMIT_AS, memory_of(::getpid(), 0) + limits.bytes);
  const auto confine = [&](Refusal refusal) {
    if (!limits.confined || confine_this_process(kReport, refusal)) return;
    write_mark(kReport, kNotConfined);
    ::_exit(0);
  };
  try {
    if (limits.confined && !limits.readable.empty()) (void)limit_file_access(limits.readable);
    confine(Refusal::error);
    prepare();
    confine(Refusal::ends_process);
    const std::vector<std::byte> result = work();
    write_mark(kReport, kResult);
    write_or_end(kReport, result);
  } catch (const std::bad_alloc&) {
    write_mark(kReport, kNoMemory);
  } catch (...) {  // must not reach the code of the parent
    std::terminate();
  }
  ::_exit(0);
}

/// Takes what can be read now. False at the end.
bool take(int descriptor, std::vector<std::byte>& into) {
  static thread_local std::array<std::byte, 1 << 16> buffer;
  const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
  if (got < 0) return errno == EINTR || errno == EAGAIN;
  into.insert(into.end(), buffer.begin(), buffer.begin() + got);
  return got > 0;
}

/// Growth of the address space beyond which a crash is attributed to memory: libraries do not check allocations.
constexpr std::uint64_t kCrashShare = 4;  // a quarter of the limit

/// Reads the report to its end, or gives up: Kind::finished, out_of_time, out_of_memory or interrupted.
ChildEnd::Kind listen(pid_t process, const ChildLimits& limits, int report, std::vector<std::byte>& bytes, bool& grew) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(std::min(limits.seconds, 1e9));
  const std::uint64_t before = memory_of(process, 0);
  const std::uint64_t most = limits.bytes > 0 ? memory_of(process, 1) + limits.bytes : 0;
  for (;;) {
    pollfd look{report, POLLIN, 0};
    const int ready = ::poll(&look, 1, kPollInterval);
    if (ready > 0 && !take(report, bytes)) return ChildEnd::Kind::finished;
    if (limits.bytes > 0 && memory_of(process, 0) > before + limits.bytes / kCrashShare) grew = true;
    if (interruption != 0) return ChildEnd::Kind::interrupted;
    if (Clock::now() > end) return ChildEnd::Kind::out_of_time;
    if (most > 0 && (bytes.size() > limits.bytes || memory_of(process, 1) > most)) return ChildEnd::Kind::out_of_memory;
  }
}

std::string last_line_of(int words) {
  std::vector<std::byte> bytes;
  while (take(words, bytes) && bytes.size() < (1 << 16)) {
  }
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  while (text.ends_with('\n')) text.remove_suffix(1);
  return std::string(text.substr(text.rfind('\n') + 1)).substr(0, 300);
}

void read_report(ChildEnd& end, std::vector<std::byte> bytes) {
  const char mark = bytes.empty() ? '\0' : static_cast<char>(bytes.front());
  if (mark == kForbiddenMark) {
    end.kind = ChildEnd::Kind::forbidden;
    end.text.assign(reinterpret_cast<const char*>(bytes.data()) + 1, bytes.size() - 1);
  } else if (mark == kNoMemory) {
    end.kind = ChildEnd::Kind::out_of_memory;
  } else if (mark == kNotConfined) {
    end.kind = ChildEnd::Kind::not_confined;
  } else if (mark == kResult) {
    bytes.erase(bytes.begin());
    end.kind = ChildEnd::Kind::finished;
    end.result = std::move(bytes);
  }
}

}  // namespace

ChildEnd run_in_child(const ChildLimits& limits, const std::function<void()>& prepare,
                      const std::function<std::vector<std::byte>()>& work) {
  Pipe report, words;
  // Output of the child beyond a pipe's size is dropped, so that the child never waits for a reader.
  ::fcntl(words.writing, F_SETFL, O_NONBLOCK);
  ::fcntl(words.reading, F_SETFL, O_NONBLOCK);
  ::fcntl(report.writing, F_SETPIPE_SZ, 1 << 20);
  const pid_t parent = ::getpid(), process = ::fork();
  if (process < 0) refuse("a child process cannot be started");
  if (process == 0) child(limits, parent, report.writing, words.writing, prepare, work);
  report.close_writing();
  words.close_writing();

  std::vector<std::byte> bytes;
  ChildEnd end;
  bool grew = false;
  end.kind = listen(process, limits, report.reading, bytes, grew);
  if (end.kind != ChildEnd::Kind::finished) ::kill(process, SIGKILL);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (end.kind != ChildEnd::Kind::finished) return end;
  end.kind = ChildEnd::Kind::crashed;
  if (WIFSIGNALED(status)) {
    end.signal = WTERMSIG(status);
    end.text = last_line_of(words.reading);
    if (end.signal == SIGSYS) {
      end.kind = ChildEnd::Kind::forbidden;
      end.text = "run a program";
    } else if (interruption != 0) {  // the terminal's signal reaches the child as well
      end.kind = ChildEnd::Kind::interrupted;
    } else if (end.signal == SIGKILL || grew || end.text.find("bad_alloc") != std::string::npos) {
      end.kind = ChildEnd::Kind::out_of_memory;
    }
    return end;
  }
  read_report(end, std::move(bytes));
  if (end.kind == ChildEnd::Kind::crashed) end.text = last_line_of(words.reading);
  return end;
}

std::uint64_t memory_of_machine() {
  const std::uint64_t bytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * page();
  const std::uint64_t allowed = memory_of_control_group();
  return allowed > 0 ? std::min(bytes, allowed) : bytes;
}

std::uint64_t available_memory() {
  std::ifstream file("/proc/meminfo");
  std::string name, unit;
  for (std::uint64_t kilobytes = 0; file >> name >> kilobytes && std::getline(file, unit);) {
    if (name == "MemAvailable:") return std::min(kilobytes * 1024, memory_of_machine());
  }
  return memory_of_machine();
}

}  // namespace breccia
