#include "catalyst/watch_thread.hpp"

#include <csignal>
#include <utility>

namespace breccia::insitu {

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
    changed_.wait_for(lock, interval_);
    if (active_ && !leave_) look_();
  }
}

}  // namespace breccia::insitu
