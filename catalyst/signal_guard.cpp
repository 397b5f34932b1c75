#include "catalyst/signal_guard.hpp"

namespace breccia::insitu {

SignalGuard::SignalGuard() {
  for (std::size_t number = 1; number <= kSignals; ++number)
    sigaction(static_cast<int>(number), nullptr, &actions_[number]);
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, nullptr);
}

SignalGuard::~SignalGuard() {
  for (std::size_t number = 1; number <= kSignals; ++number) {
    if (number != SIGKILL && number != SIGSTOP) sigaction(static_cast<int>(number), &actions_[number], nullptr);
  }
}

}  // namespace breccia::insitu
