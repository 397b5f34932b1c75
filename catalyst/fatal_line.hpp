#pragma once

#include <array>
#include <csignal>
#include <string>

namespace breccia::insitu {

/// While it lives, a fatal signal (an abort in VTK, memory that is not ours) leaves one line that names the pipeline,
/// before it ends the process as it would have. One at a time.
class FatalLine {
 public:
  explicit FatalLine(const std::string& pipeline);
  FatalLine(const FatalLine&) = delete;
  FatalLine& operator=(const FatalLine&) = delete;
  ~FatalLine();

 private:
  static constexpr std::array<int, 5> kSignals{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
  std::array<struct sigaction, kSignals.size()> old_{};
};

}  // namespace breccia::insitu
