#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <string>

#include "base/error.hpp"

namespace breccia {

/// That end a run after the present step, with everything written: Ctrl-C, a polite kill, a closed terminal, and what
/// queues send before they kill.
inline constexpr std::array kEndingSignals{SIGINT, SIGTERM, SIGHUP, SIGUSR2, SIGXCPU};

/// An ignored signal stays ignored, as `nohup` and shells that start a job in the background require.
inline void handle_unless_ignored(int signal, void (*handler)(int)) {
  struct sigaction now {};
  if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN) return;
  std::signal(signal, handler);
}

/// Number of the signal that requested the end of this process; 0: none. Set by a handler in main; long work that can
/// be aborted polls it.
inline std::atomic<int> interruption{0};

/// Thrown where work that has written nothing is given up because of it; main turns it into 128 + the signal. For work
/// of one rank, or in Communicator::agree: at the ends of all parts that may take a second.
inline void give_up_if_interrupted(const char* words = "interrupted; nothing has been written") {
  if (interruption != 0) throw InputError(Problem{"", 0, "", words, "", ""});
}

/// What a program that ends by such a request returns, as shells do: 130 for Ctrl-C, 143 for SIGTERM.
[[nodiscard]] inline int exit_code_of(int signal) { return 128 + signal; }

}  // namespace breccia
