#include "core/newest_task.hpp"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QElapsedTimer>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace breccia::gui::newest_task_test {
namespace {

void process_events(int ms) {
  QElapsedTimer timer;
  timer.start();
  while (timer.elapsed() < ms) QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
}

/// What waited used to be done, and told, last of all when the work before it had just ended.
TEST(NewestTask, WhatWaitedIsNotDoneAfterWhatWasAskedForLater) {
  std::vector<int> told;
  NewestTask<int> task([&](const int& result) { told.push_back(result); });
  std::atomic<bool> ended = false;
  task.start([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ended = true;
    return 1;
  });
  task.start([] { return 2; });
  while (!ended) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // it has ended, which nobody has been told yet
  task.start([] { return 3; });
  process_events(300);
  EXPECT_EQ(told, std::vector<int>{3});
  EXPECT_FALSE(task.busy());
}

}  // namespace
}  // namespace breccia::gui::newest_task_test
