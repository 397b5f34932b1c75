#pragma once

#include <time.h>

#include <QApplication>
#include <QEvent>
#include <QMetaEnum>
#include <algorithm>
#include <string>
#include <vector>

namespace breccia::gui::test {

/// Processor time of this thread, ms: what others do on the machine does not count.
inline double busy_ms() {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// Remembers which events took the thread of the window longest.
class TimedApplication final : public QApplication {
 public:
  struct Call {
    double ms = 0;
    std::string what;  ///< class of the receiver and kind of the event
  };

  using QApplication::QApplication;
  [[nodiscard]] static TimedApplication& own() { return *static_cast<TimedApplication*>(instance()); }

  bool notify(QObject* receiver, QEvent* event) override {
    if (depth_ > 0 || !on_) return QApplication::notify(receiver, event);
    const std::string name = receiver->metaObject()->className() + (" " + receiver->objectName().toStdString());
    const auto kind = event->type();
    const double begin = busy_ms();
    ++depth_;
    const bool taken = QApplication::notify(receiver, event);
    --depth_;
    const char* key = QMetaEnum::fromType<QEvent::Type>().valueToKey(kind);
    calls_.push_back({busy_ms() - begin, name + ": " + (key == nullptr ? std::to_string(kind) : key)});
    return taken;
  }

  void start() {
    on_ = true;
    calls_.clear();
  }

  /// The longest, longest first, and no more are counted.
  [[nodiscard]] std::vector<Call> stop(std::size_t most = 3) {
    on_ = false;
    std::sort(calls_.begin(), calls_.end(), [](const Call& a, const Call& b) { return a.ms > b.ms; });
    calls_.resize(std::min(calls_.size(), most));
    return calls_;
  }

 private:
  std::vector<Call> calls_;
  int depth_ = 0;
  bool on_ = false;
};

}  // namespace breccia::gui::test
