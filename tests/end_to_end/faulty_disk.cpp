// Loaded before the program (LD_PRELOAD): a disk that is full, read-only, broken or slow for some files. The
// environment says which: FAULTY_DISK="name bytes errno delay_us". After so many bytes written by this process to files
// whose paths hold the name, every further write fails with errno (0: none does); each takes so long, and so does each
// fsync.
#include <dlfcn.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Fault {
  std::array<char, 256> name{};
  long bytes = 0;
  int error = 0;
  unsigned delay = 0;
};

const Fault& fault() {
  static const Fault asked = [] {
    Fault read;
    const char* text = std::getenv("FAULTY_DISK");
    if (text == nullptr ||
        std::sscanf(text, "%255s %ld %d %u", read.name.data(), &read.bytes, &read.error, &read.delay) != 4)
      read.name[0] = '\0';
    return read;
  }();
  return asked;
}

std::atomic<long> written{0};

bool concerns(int descriptor) {
  if (fault().name[0] == '\0') return false;
  std::array<char, 64> link{};
  std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", descriptor);
  std::array<char, 4096> path{};
  return ::readlink(link.data(), path.data(), path.size() - 1) > 0 &&
         std::strstr(path.data(), fault().name.data()) != nullptr;
}

/// Whether the write is refused; errno says why.
bool refuses(int descriptor, size_t size) {
  if (!concerns(descriptor)) return false;
  if (fault().delay > 0) ::usleep(fault().delay);
  if (fault().error == 0 || written.fetch_add(static_cast<long>(size)) + static_cast<long>(size) <= fault().bytes)
    return false;
  errno = fault().error;
  return true;
}

template <class Function>
Function* original(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t size) {
  static auto* const real = original<ssize_t(int, const void*, size_t)>("write");
  return refuses(descriptor, size) ? -1 : real(descriptor, bytes, size);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  static auto* const real = original<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  return refuses(descriptor, size) ? -1 : real(descriptor, bytes, size, offset);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t offset) {
  static auto* const real = original<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  return refuses(descriptor, size) ? -1 : real(descriptor, bytes, size, offset);
}

int fsync(int descriptor) {
  static auto* const real = original<int(int)>("fsync");
  return refuses(descriptor, 0) ? -1 : real(descriptor);
}
}
