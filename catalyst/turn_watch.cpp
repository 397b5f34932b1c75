#include "catalyst/turn_watch.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace breccia::insitu {
namespace {

constexpr auto kBetweenLooks = std::chrono::seconds(1);
constexpr double kEnd = 3.0;     ///< times the limit: the program ends
constexpr int kFaultOfOurs = 4;  ///< exit code

}  // namespace

TurnWatch::TurnWatch(double limit, const Interruption& interruption) : limit_(limit), interruption_(interruption) {
  if (limit <= 0.0) return;
  // Signals are for the run's own thread.
  sigset_t all, old;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &old);
  thread_ = std::thread([this] { watch(); });
  ::pthread_sigmask(SIG_SETMASK, &old, nullptr);
}

TurnWatch::~TurnWatch() {
  {
    const std::lock_guard lock(mutex_);
    leave_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void TurnWatch::withdraw() const {
  if (interruption_.withdraw != nullptr) interruption_.withdraw();
}

void TurnWatch::begin(const std::string& who) {
  const std::lock_guard lock(mutex_);
  if (interruption_.begin != nullptr) interruption_.begin();
  who_ = who;
  began_ = std::chrono::steady_clock::now();
  active_ = true;
  changed_.notify_one();
}

void TurnWatch::restart() {
  const std::lock_guard lock(mutex_);
  began_ = std::chrono::steady_clock::now();
  withdraw();
}

void TurnWatch::end() {
  const std::lock_guard lock(mutex_);
  active_ = false;
  withdraw();
}

void TurnWatch::watch() {
  std::unique_lock lock(mutex_);
  while (!leave_) {
    if (!active_) {
      changed_.wait(lock);
      continue;
    }
    changed_.wait_for(lock, kBetweenLooks);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - began_;
    if (!active_ || leave_ || taken < limit_) continue;
    if (taken > kEnd * limit_) {
      std::fprintf(stderr,
                   "breccia: error: %s: has not come back for %.0f s and cannot be interrupted; the run ends here\n",
                   who_.c_str(), taken.count());
      ::_exit(kFaultOfOurs);
    }
    if (interruption_.ask != nullptr) interruption_.ask(limit_.count());
  }
}

}  // namespace breccia::insitu
