#include "catalyst/fatal_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace breccia::insitu {
namespace {

// What a handler may use: memory that is there, and write.
std::array<char, 1024> line{};

const char* name_of(int signal) {
  switch (signal) {
    case SIGABRT:
      return "an abort (SIGABRT)\n";
    case SIGSEGV:
      return "a read or write of memory that it does not have (SIGSEGV)\n";
    case SIGBUS:
      return "memory that cannot be reached (SIGBUS)\n";
    case SIGFPE:
      return "an arithmetic fault (SIGFPE)\n";
    default:
      return "an illegal instruction (SIGILL)\n";
  }
}

void tell_and_end(int signal) {
  // As the default: traces of stacks by other libraries would bury the line.
  ::signal(signal, SIG_DFL);
  const char* name = name_of(signal);
  static_cast<void>(!::write(STDERR_FILENO, line.data(), std::strlen(line.data())));
  static_cast<void>(!::write(STDERR_FILENO, name, std::strlen(name)));
  ::raise(signal);
}

}  // namespace

FatalLine::FatalLine(const std::string& what, const std::string& who) {
  std::snprintf(line.data(), line.size(), "breccia: error: %s: %s has ended the run by ", what.c_str(), who.c_str());
  struct sigaction action {};
  action.sa_handler = &tell_and_end;
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &action, &old_[i]);
}

FatalLine::~FatalLine() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &old_[i], nullptr);
}

}  // namespace breccia::insitu
