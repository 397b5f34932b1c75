// Loaded before the program (LD_PRELOAD): a file system without locks, such as NFS without its lock daemon, where flock
// and the locks of fcntl end with ENOLCK.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstdarg>
#include <initializer_list>

namespace {

bool is_lock(int command) {
  for (const int lock : {F_SETLK, F_SETLKW, F_GETLK, F_OFD_SETLK, F_OFD_SETLKW, F_OFD_GETLK}) {
    if (command == lock) return true;
  }
  return false;
}

int refused() {
  errno = ENOLCK;
  return -1;
}

using Fcntl = int (*)(int, int, ...);

}  // namespace

extern "C" int flock(int, int) { return refused(); }

extern "C" int fcntl(int descriptor, int command, ...) {
  std::va_list arguments;
  va_start(arguments, command);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  static const auto next = reinterpret_cast<Fcntl>(::dlsym(RTLD_NEXT, "fcntl"));
  return is_lock(command) ? refused() : next(descriptor, command, argument);
}

extern "C" int fcntl64(int descriptor, int command, ...) {
  std::va_list arguments;
  va_start(arguments, command);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  static const auto next = reinterpret_cast<Fcntl>(::dlsym(RTLD_NEXT, "fcntl64"));
  return is_lock(command) ? refused() : next(descriptor, command, argument);
}
