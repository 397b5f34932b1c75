#include "system/surviving_process.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>

#include "system/interruption.hpp"
#include "system/write_all.hpp"

namespace breccia {
namespace {

constexpr std::string_view kNumber = "%PID%";

std::vector<OrphanNote> orphan_notes;  // of the copy: set before the signal can come, then only read
volatile std::sig_atomic_t notes_written = 0;

/// Nothing but system calls: the signal may come within malloc.
void write_orphan_notes(int) {
  if (notes_written != 0) return;
  notes_written = 1;
  const int error = errno;
  for (const OrphanNote& note : orphan_notes) {
    if (note.replaces && ::ftruncate(note.descriptor, 0) == 0) {
      (void)!::pwrite(note.descriptor, note.text.data(), note.text.size(), 0);
    } else if (!note.replaces) {
      (void)write_all(note.descriptor, note.text);
    }
  }
  errno = error;
}

/// Sockets and pipes of MPI and of the launcher would keep those at their other ends waiting.
void close_all_but_files(int pipe) {
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (int d = 0; d <= 2; ++d) ::dup2(nothing, d);
  std::vector<int> closed;
  if (DIR* list = ::opendir("/proc/self/fd"); list != nullptr) {
    while (const dirent* entry = ::readdir(list)) {
      const int d = std::atoi(entry->d_name);
      struct stat about {};
      if (d > 2 && d != pipe && d != ::dirfd(list) && ::fstat(d, &about) == 0 && !S_ISREG(about.st_mode))
        closed.push_back(d);
    }
    ::closedir(list);
  }
  for (const int d : closed) ::close(d);
}

void prepare_to_survive(int pipe, pid_t parent, std::vector<OrphanNote> notes) {
  ::setsid();
  for (const int s : kEndingSignals) ::signal(s, SIG_IGN);
  ::signal(SIGPIPE, SIG_IGN);
  for (const int s : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) ::signal(s, SIG_DFL);
  close_all_but_files(pipe);
  const std::string number = std::to_string(::getpid());
  for (OrphanNote& note : notes) {
    if (const std::size_t at = note.text.find(kNumber); at != std::string::npos)
      note.text.replace(at, kNumber.size(), number);
  }
  orphan_notes = std::move(notes);
  ::signal(SIGUSR1, write_orphan_notes);
  ::prctl(PR_SET_PDEATHSIG, SIGUSR1);
  if (::getppid() != parent) ::raise(SIGUSR1);
}

bool read_all(int pipe, void* into, std::size_t size) {
  auto* next = static_cast<char*>(into);
  while (size > 0) {
    const ssize_t got = ::read(pipe, next, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    next += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

bool SurvivingProcess::Parent::has_ended() const { return ::getppid() != number_; }

void SurvivingProcess::Parent::report(std::string_view text) const {
  const std::uint64_t size = text.size();
  (void)(write_all(pipe_, std::as_bytes(std::span(&size, 1))) == 0 && write_all(pipe_, text) == 0);
}

SurvivingProcess::SurvivingProcess(const std::function<void(const Parent&)>& work, std::vector<OrphanNote> notes) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) {
    try {
      prepare_to_survive(ends[1], parent, std::move(notes));
      work(Parent(ends[1], parent));
    } catch (...) {  // must not reach the code of the parent
      ::_exit(1);
    }
    ::_exit(0);
  }
  ::close(ends[1]);
  pipe_ = ends[0];
}

SurvivingProcess::~SurvivingProcess() {
  if (pipe_ >= 0) ::close(pipe_);
}

std::optional<std::string> SurvivingProcess::receive() {
  std::uint64_t size = 0;
  if (process_ <= 0 || !read_all(pipe_, &size, sizeof size)) return std::nullopt;
  std::string text(size, '\0');
  if (!read_all(pipe_, text.data(), size)) return std::nullopt;
  return text;
}

void SurvivingProcess::wait() {
  while (process_ > 0 && ::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

void SurvivingProcess::kill() {
  if (process_ > 0) ::kill(process_, SIGKILL);
  wait();
}

}  // namespace breccia
