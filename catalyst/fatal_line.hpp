#pragma once

#include <array>
#include <csignal>
#include <string>

namespace breccia::insitu {

/// While it lives, a fatal signal (an abort in VTK, memory that is not ours) leaves one line that names the pipeline
/// and who does its work, before it ends the process as it would have. One at a time.
class FatalLine {
 public:
  /// @param what  "pipeline stress"
  explicit FatalLine(const std::string& what, const std::string& who = "ParaView");
  FatalLine(const FatalLine&) = delete;
  FatalLine& operator=(const FatalLine&) = delete;
  ~FatalLine();

 private:
  static constexpr std::array<int, 5> kSignals{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
  std::array<struct sigaction, kSignals.size()> old_{};
};

}  // namespace breccia::insitu
