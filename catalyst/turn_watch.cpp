#include "catalyst/turn_watch.hpp"

#include <unistd.h>

#include <cstdio>

namespace breccia::insitu {
namespace {

constexpr auto kPollInterval = std::chrono::seconds(1);
constexpr double kEnd = 3.0;     ///< times the limit: the program ends
constexpr int kFaultOfOurs = 4;  ///< exit code

}  // namespace

TurnWatch::TurnWatch(double limit, const Interruption& interruption) : limit_(limit), interruption_(interruption) {
  if (limit > 0.0) thread_.emplace(kPollInterval, [this] { look(); });
}

void TurnWatch::withdraw() const {
  if (interruption_.withdraw != nullptr) interruption_.withdraw();
}

void TurnWatch::begin(const std::string& who) {
  const auto begun = [&] {
    if (interruption_.begin != nullptr) interruption_.begin();
    who_ = who;
    restart_clock();
  };
  thread_ ? thread_->begin(begun) : begun();
}

void TurnWatch::restart_clock() {
  began_ = std::chrono::steady_clock::now();
  if (thread_) stopped_before_ = thread_->stopped();
}

void TurnWatch::restart() {
  if (!thread_) return;
  thread_->change([&] {
    restart_clock();
    withdraw();
  });
}

void TurnWatch::end() {
  if (thread_) thread_->end([&] { withdraw(); });
}

void TurnWatch::look() {
  const std::chrono::duration<double> taken =
      std::chrono::steady_clock::now() - began_ - (thread_->stopped() - stopped_before_);
  if (taken < limit_) return;
  if (taken > kEnd * limit_) {
    std::fprintf(stderr,
                 "breccia: error: %s: has not come back for %.0f s and cannot be interrupted; the run ends here\n",
                 who_.c_str(), taken.count());
    ::_exit(kFaultOfOurs);
  }
  if (interruption_.ask != nullptr) interruption_.ask(limit_.count());
}

}  // namespace breccia::insitu
