#pragma once

#include <gtest/gtest.h>

#include <QProcess>

#include "gui/desk.hpp"

namespace breccia::gui::test {

inline constexpr int kSolver = 240000;  // ms; the machine may be busy

/// A bar that is pulled slowly: displacements that are not seen.
inline QByteArray pulled_block(const QByteArray& more = "frame_interval = \"20 us\"\n") {
  return block_case(2, "100 us") + R"([[stage.constraint]]
group = "block.x1"
velocity = { x = "0.05 m/s" }
[[stage.constraint]]
group = "block.x0"
fixed = "x"
[output]
)" + more;
}

/// The desktop with the last frame of a run in view.
struct RunDesk : Desk {
  QString run;
  explicit RunDesk(const QByteArray& text) {
    run = scratch.filePath("run");
    EXPECT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", written_case(scratch, text), "-o", run, "--progress", "none"}),
              0);
    window->open_path(run);
    EXPECT_TRUE(wait_until([this] { return caption().startsWith("time ") && !window->busy(); }, kSolver));
    window->activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(window.get()));
  }
  [[nodiscard]] Scene& scene() { return window->view().scene(); }
  [[nodiscard]] QString caption() { return window->view().caption(); }
  [[nodiscard]] QString seen_words() { return QString::fromStdString(scene().caption()); }
};

}  // namespace breccia::gui::test
