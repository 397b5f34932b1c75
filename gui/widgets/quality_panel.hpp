#pragma once

#include <QComboBox>
#include <QFutureWatcher>
#include <QLabel>

#include "render/mesh_quality.hpp"

namespace breccia::gui {

/// Bars that are chosen by a click or the arrow keys.
class HistogramView final : public QWidget {
  Q_OBJECT
 public:
  explicit HistogramView(QWidget* parent = nullptr);
  void show_bars(const Histogram& bars, const QString& title);
  [[nodiscard]] const Histogram& bars() const { return bars_; }
  /// -1: none.
  [[nodiscard]] int chosen() const { return chosen_; }
  void choose(int bar);
  [[nodiscard]] QRectF place_of(int bar) const;
  [[nodiscard]] QSize sizeHint() const override { return {420, 190}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {220, 110}; }

 signals:
  void bar_chosen(int bar);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  Histogram bars_;
  QString title_;
  int chosen_ = -1;
};

/// How well the elements are shaped: a histogram whose bars show their elements in the view.
class QualityPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit QualityPanel(QWidget* parent = nullptr);
  /// The mesh at rest, as the solver has written it; it is read on another thread.
  void set_mesh(const QString& elements_file);

 signals:
  /// @param faces  nullptr: nothing is chosen any more;  @param words  about them
  void elements_chosen(vtkSmartPointer<vtkPolyData> faces, const QString& words);

 private:
  void show_measure();
  void choose(int bar);
  [[nodiscard]] ShapeMeasure measure() const;

  QComboBox* measure_;
  HistogramView* view_;
  QLabel* words_;
  MeshShapes shapes_;
  QFutureWatcher<MeshShapes> reader_;
  QString next_;
};

}  // namespace breccia::gui
