#pragma once

#include <QFutureWatcher>
#include <QtConcurrent>
#include <functional>
#include <optional>
#include <utility>

namespace breccia::gui {

/// Work on another thread whose result is told on this one. Of what is asked for while something is worked at, the last
/// is done next, and nothing is told of the others.
template <class Result>
class NewestTask {
 public:
  explicit NewestTask(std::function<void(const Result&)> told) : told_(std::move(told)) {
    QObject::connect(&watcher_, &QFutureWatcher<Result>::finished, [this] {
      if (next_) {
        watcher_.setFuture(QtConcurrent::run(*std::exchange(next_, {})));
      } else if (wanted_) {
        wanted_ = false;
        told_(watcher_.result());
      }
    });
  }
  ~NewestTask() {
    watcher_.disconnect();
    watcher_.waitForFinished();
  }
  NewestTask(const NewestTask&) = delete;
  NewestTask& operator=(const NewestTask&) = delete;

  void start(std::function<Result()> work) {
    wanted_ = true;
    if (watcher_.isRunning()) {
      next_ = std::move(work);
    } else {
      next_.reset();  // what was under way may have ended without having been told yet
      watcher_.setFuture(QtConcurrent::run(std::move(work)));
    }
  }
  /// Nothing is told of what is under way.
  void forget() {
    wanted_ = false;
    next_.reset();
  }
  [[nodiscard]] bool busy() const { return wanted_; }

 private:
  QFutureWatcher<Result> watcher_;
  std::function<void(const Result&)> told_;
  std::optional<std::function<Result()>> next_;
  bool wanted_ = false;
};

}  // namespace breccia::gui
