#include "catalyst/watch_thread.hpp"

#include <csignal>
#include <utility>

namespace breccia::insitu {
namespace {

/// A thread that wakes later than this was stopped with its process: a busy machine delays it by less.
constexpr auto kStopped = std::chrono::seconds(2);

}  // namespace

WatchThread::WatchThread(std::chrono::milliseconds interval, std::function<void()> look)
    : interval_(interval), look_(std::move(look)) {
  // Signals are for the run's own thread.
  sigset_t all, old;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &old);
  thread_ = std::thread([this] { watch(); });
  ::pthread_sigmask(SIG_SETMASK, &old, nullptr);
}

WatchThread::~WatchThread() {
  {
    const std::lock_guard lock(mutex_);
    leave_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void WatchThread::begin(const std::function<void()>& change) {
  const std::lock_guard lock(mutex_);
  change();
  active_ = true;
  changed_.notify_one();
}

void WatchThread::end(const std::function<void()>& change) {
  const std::lock_guard lock(mutex_);
  change();
  active_ = false;
}

void WatchThread::change(const std::function<void()>& change) {
  const std::lock_guard lock(mutex_);
  change();
}

void WatchThread::watch() {
  std::unique_lock lock(mutex_);
  while (!leave_) {
    if (!active_) {
      changed_.wait(lock);
      continue;
    }
    const auto before = std::chrono::steady_clock::now();
    changed_.wait_for(lock, interval_);
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - before;
    if (waited > interval_ + kStopped) stopped_ += waited - interval_;
    if (active_ && !leave_) look_();
  }
}

}  // namespace breccia::insitu
