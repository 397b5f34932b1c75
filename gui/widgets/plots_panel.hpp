#pragma once

#include <QVTKOpenGLNativeWidget.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>

#include <QTimer>
#include <QWidget>

#include "core/run_folder.hpp"
#include "render/history_chart.hpp"

class QLabel;

namespace breccia::gui {

/// Energies on the left, what breaks on the right, over simulated time.
class PlotsPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit PlotsPanel(QWidget* parent = nullptr);
  /// @param others  runs to compare with: their kinetic energy and broken joints are shown as well
  void show_history(const History& history, const std::vector<std::pair<QString, const History*>>& others = {});
  void set_dark(bool dark);
  [[nodiscard]] int num_curves() const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void unfold();
  void render();

  HistoryChart energies_, breaking_;
  vtkNew<vtkGenericOpenGLRenderWindow> energies_window_, breaking_window_;
  QVTKOpenGLNativeWidget *energies_canvas_, *breaking_canvas_;
  QLabel* no_data_ = nullptr;
  QTimer unfolding_;
  bool stale_ = false;  ///< the charts have changed since they were drawn
};

}  // namespace breccia::gui
