#pragma once

#include <QFutureWatcher>
#include <QtConcurrent>
#include <functional>
#include <optional>
#include <utility>

namespace breccia::gui {

/// Work on another thread whose result is delivered on this one. Of several requests during a task the last is done
/// next, and the others are dropped.
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
      next_.reset();  // the current task may have ended without its result being delivered
      watcher_.setFuture(QtConcurrent::run(std::move(work)));
    }
  }
  /// Drops the result of the current task.
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
