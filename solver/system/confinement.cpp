#include "system/confinement.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace breccia {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
constexpr std::uint32_t kFirstForeignCall = 0x40000000;  // calls of the x32 interface have numbers above this one
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
constexpr std::uint32_t kFirstForeignCall = 0xffffffff;
#else
constexpr std::uint32_t kArchitecture = 0;  // cannot be confined
constexpr std::uint32_t kFirstForeignCall = 0xffffffff;
#endif

constexpr std::uint32_t kOpensForWriting = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;

/// A system call and its description in messages; `path` is the argument that names a file, -1: none.
struct Forbidden {
  long number;
  const char* words;
  int path = -1;
};

constexpr Forbidden kForbidden[] = {
    {SYS_execve, "run a program", 0},
    {SYS_execveat, "run a program", 1},
    {SYS_clone, "start a process"},
    {SYS_openat, "open a file for writing", 1},
    {SYS_mkdirat, "make a folder", 1},
    {SYS_unlinkat, "remove a file", 1},
    {SYS_renameat2, "rename a file", 1},
    {SYS_linkat, "link a file", 1},
    {SYS_symlinkat, "link a file", 0},
    {SYS_mknodat, "make a file", 1},
    {SYS_fchmodat, "change a file's rights", 1},
    {SYS_fchownat, "change a file's owner", 1},
    {SYS_truncate, "cut a file", 0},
    {SYS_utimensat, "change a file's times", 1},
    {SYS_socket, "open a network connection"},
    {SYS_kill, "send a signal"},
    {SYS_ptrace, "read the memory of another process"},
    {SYS_process_vm_readv, "read the memory of another process"},
    {SYS_process_vm_writev, "write into another process"},
#ifdef SYS_fork  // calls that newer architectures do without
    {SYS_fork, "start a process"},
    {SYS_vfork, "start a process"},
    {SYS_open, "open a file for writing", 0},
    {SYS_creat, "open a file for writing", 0},
    {SYS_mkdir, "make a folder", 0},
    {SYS_rmdir, "remove a folder", 0},
    {SYS_unlink, "remove a file", 0},
    {SYS_rename, "rename a file", 0},
    {SYS_renameat, "rename a file", 1},
    {SYS_link, "link a file", 0},
    {SYS_symlink, "link a file", 0},
    {SYS_mknod, "make a file", 0},
    {SYS_chmod, "change a file's rights", 0},
    {SYS_chown, "change a file's owner", 0},
    {SYS_lchown, "change a file's owner", 0},
#endif
};

constexpr long kAllowed[] = {
    // Memory and threads.
    SYS_brk,
    SYS_mmap,
    SYS_munmap,
    SYS_mremap,
    SYS_mprotect,
    SYS_madvise,
    SYS_mincore,
    SYS_futex,
    SYS_set_robust_list,
    SYS_get_robust_list,
    SYS_rseq,
    SYS_membarrier,
    SYS_set_tid_address,
    SYS_sched_yield,
    SYS_sched_getaffinity,
    SYS_getcpu,
    // Reading, and writing to what is open.
    SYS_read,
    SYS_readv,
    SYS_pread64,
    SYS_preadv,
    SYS_write,
    SYS_writev,
    SYS_lseek,
    SYS_close,
    SYS_dup,
    SYS_dup3,
    SYS_fcntl,
    SYS_fstat,
    SYS_newfstatat,
    SYS_statx,
    SYS_faccessat,
    SYS_faccessat2,
    SYS_readlinkat,
    SYS_getdents64,
    SYS_getcwd,
    SYS_statfs,
    SYS_fstatfs,
    SYS_fadvise64,
    SYS_ppoll,
    SYS_pselect6,
    // Signals of its own, clocks, what it is.
    SYS_pipe2,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_sigaltstack,
    SYS_restart_syscall,
    SYS_exit,
    SYS_exit_group,
    SYS_clock_gettime,
    SYS_clock_getres,
    SYS_clock_nanosleep,
    SYS_nanosleep,
    SYS_gettimeofday,
    SYS_times,
    SYS_getrusage,
    SYS_getrandom,
    SYS_uname,
    SYS_sysinfo,
    SYS_getpid,
    SYS_gettid,
    SYS_getppid,
    SYS_getuid,
    SYS_geteuid,
    SYS_getgid,
    SYS_getegid,
    SYS_getpgid,
#ifdef SYS_fork
    SYS_access,
    SYS_stat,
    SYS_lstat,
    SYS_readlink,
    SYS_getdents,
    SYS_dup2,
    SYS_poll,
    SYS_select,
    SYS_arch_prctl,
    SYS_time,
    SYS_getrlimit,
    SYS_getpgrp,
    SYS_pipe,
#endif
};

/// The filter as a program of the kernel's: for each call the verdict that follows its comparison.
class Program {
 public:
  Program() {
    load(offsetof(seccomp_data, arch));
    add(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0);
    verdict(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
    add(BPF_JMP | BPF_JGE | BPF_K, kFirstForeignCall, 0, 1);
    verdict(SECCOMP_RET_ERRNO | ENOSYS);
  }

  void when(long number, std::uint32_t what) {
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 1);
    verdict(what);
  }
  /// Verdicts for a call whose argument (its lower half) has one of the bits, or none of them.
  void when_bits(long number, int argument, std::uint32_t bits, std::uint32_t some, std::uint32_t none) {
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 4);
    load(lower_half(argument));
    add(BPF_JMP | BPF_JSET | BPF_K, bits, 0, 1);
    verdict(some);
    verdict(none);
  }
  /// Verdicts for a call whose argument (its lower half) is this value, or another.
  void when_equal(long number, int argument, std::uint32_t value, std::uint32_t equal, std::uint32_t other) {
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 4);
    load(lower_half(argument));
    add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1);
    verdict(equal);
    verdict(other);
  }
  void verdict(std::uint32_t what) { add(BPF_RET | BPF_K, what, 0, 0); }

  [[nodiscard]] bool install() {
    sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
    return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
  }

 private:
  static std::size_t lower_half(int argument) {  // both architectures are little-endian
    return offsetof(seccomp_data, args) + static_cast<std::size_t>(argument) * sizeof(std::uint64_t);
  }
  void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset), 0, 0); }
  void add(int code, std::uint32_t value, unsigned char yes, unsigned char no) {
    code_.push_back({static_cast<unsigned short>(code), yes, no, value});
  }

  std::vector<sock_filter> code_;
};

int report_descriptor = -1;

void say(const char* text) {
  for (std::size_t left = std::strlen(text); left > 0;) {
    const ssize_t written = ::write(report_descriptor, text, left);
    if (written <= 0) return;
    text += written;
    left -= static_cast<std::size_t>(written);
  }
}

/// Argument of the system call that was refused.
const char* argument_of(const void* context, int index) {
  const auto* machine = static_cast<const ucontext_t*>(context);
  // NOLINTBEGIN(performance-no-int-to-ptr): a register holds the address as a number
#if defined(__x86_64__)
  return reinterpret_cast<const char*>(machine->uc_mcontext.gregs[index == 0 ? REG_RDI : REG_RSI]);
#elif defined(__aarch64__)
  return reinterpret_cast<const char*>(machine->uc_mcontext.regs[index]);
#else
  (void)machine, (void)index;
  return nullptr;
#endif
  // NOLINTEND(performance-no-int-to-ptr)
}

/// Reports the attempt and ends the process; calls nothing that a signal handler may not.
void tell_and_end(int, siginfo_t* info, void* context) {
  const char mark[2] = {kForbiddenMark, '\0'};
  say(mark);
  for (const Forbidden& call : kForbidden) {
    if (call.number != info->si_syscall) continue;
    say(call.words);
    const char* path = call.path < 0 ? nullptr : argument_of(context, call.path);
    if (path != nullptr) {
      say(": ");
      say(path);
    }
    break;
  }
  ::_exit(1);
}

}  // namespace

bool confine_this_process(int report, Refusal refusal) {
  if (kArchitecture == 0 || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  report_descriptor = report;
  struct sigaction action {};
  action.sa_sigaction = tell_and_end;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  ::sigaction(SIGSYS, &action, nullptr);

  const std::uint32_t allow = SECCOMP_RET_ALLOW, deny = SECCOMP_RET_ERRNO | EPERM;
  const std::uint32_t trap = refusal == Refusal::ends_process ? SECCOMP_RET_TRAP : SECCOMP_RET_ERRNO | EACCES;
  Program program;
  for (const long number : kAllowed) program.when(number, allow);
  program.when_bits(SYS_openat, 2, kOpensForWriting, trap, allow);
#ifdef SYS_fork
  program.when_bits(SYS_open, 1, kOpensForWriting, trap, allow);
#endif
  program.when_bits(SYS_clone, 0, CLONE_THREAD, allow, trap);
  // The C library falls back to clone and openat, whose arguments can be checked.
  program.when(SYS_clone3, SECCOMP_RET_ERRNO | ENOSYS);
  program.when(SYS_openat2, SECCOMP_RET_ERRNO | ENOSYS);
  program.when(SYS_ioctl, SECCOMP_RET_ERRNO | ENOTTY);
  program.when_equal(SYS_tgkill, 0, static_cast<std::uint32_t>(::getpid()), allow, deny);
  const std::uint32_t further = refusal == Refusal::error ? allow : deny;  // a second, stricter filter may follow
  program.when_equal(SYS_prctl, 0, PR_SET_NAME, allow, further);
  program.when_equal(SYS_prlimit64, 2, 0, allow, deny);  // reads a limit; changing one needs an address
  for (const Forbidden& call : kForbidden) program.when(call.number, trap);
  program.verdict(deny);
  return program.install();
}

}  // namespace breccia
