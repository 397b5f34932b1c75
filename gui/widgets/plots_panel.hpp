#pragma once

#include <QVTKOpenGLNativeWidget.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>

#include <QHash>
#include <QTimer>
#include <QTreeWidget>
#include <QWidget>
#include <array>

#include "core/run_folder.hpp"
#include "render/history_chart.hpp"

class QLabel;

namespace breccia::gui {

/// Curves of the history over simulated time: those that are ticked in a list of all, in a chart for each unit.
class PlotsPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit PlotsPanel(QWidget* parent = nullptr);
  /// @param history  valid until the next call, as those of the others
  /// @param others   runs to compare with: every curve that is chosen is shown of them as well
  void show_history(const History& history, const std::vector<std::pair<QString, const History*>>& others = {});
  void set_dark(bool dark);
  [[nodiscard]] int num_curves() const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  static constexpr std::size_t kMostCharts = 4;
  struct Chart {
    HistoryChart chart;
    vtkNew<vtkGenericOpenGLRenderWindow> window;
    QVTKOpenGLNativeWidget* canvas = nullptr;
    bool wanted = false;
    std::array<int, 2> size{};  ///< at which it was drawn last, pixels
  };
  using CurvesByUnit = std::vector<std::pair<QString, std::vector<Curve>>>;

  void list_columns();
  void tell_round_off();
  void ticked(QTreeWidgetItem* item);
  [[nodiscard]] bool is_drawn(int column) const;
  [[nodiscard]] CurvesByUnit chosen_curves() const;
  void draw();
  void unfold();
  void render();

  std::array<Chart, kMostCharts> charts_;
  QTreeWidget* list_;
  QLabel *no_data_, *too_many_;
  QTimer unfolding_;
  History history_none_;
  const History* history_ = &history_none_;
  std::vector<std::pair<QString, const History*>> others_;
  std::vector<bool> round_off_;  ///< by column
  QStringList listed_;           ///< columns of the list
  QHash<QString, bool> ticks_;   ///< columns that someone has ticked or unticked
  bool stale_ = false;           ///< the charts have changed since they were drawn
};

}  // namespace breccia::gui
