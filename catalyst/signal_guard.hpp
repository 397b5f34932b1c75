#pragma once

#include <array>
#include <csignal>
#include <cstddef>

namespace breccia::insitu {

/// While it lives, libraries may install handlers of signals; its end puts back those that its beginning found. SIGPIPE
/// is ignored meanwhile: a ParaView that dies must not take the run along.
class SignalGuard {
 public:
  SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;
  ~SignalGuard();

 private:
  static constexpr std::size_t kSignals = 31;  ///< 1 to 31, the classical ones
  std::array<struct sigaction, kSignals + 1> actions_{};
};

}  // namespace breccia::insitu
