#pragma once

#include <QComboBox>
#include <QLabel>
#include <memory>

#include "core/newest_task.hpp"
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

/// How well the elements are shaped: a histogram whose bars show their elements in the view. Elements are measured and
/// their faces found on another thread.
class QualityPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit QualityPanel(QWidget* parent = nullptr);
  /// The mesh at rest; one without elements: there is none.
  void set_mesh(const FrameData& mesh);
  /// As told last; nullptr: nothing yet.
  [[nodiscard]] const ElementValues* values() const { return values_.get(); }
  [[nodiscard]] bool busy() const { return measuring_.busy() || collecting_.busy(); }

 signals:
  /// @param faces  nullptr: nothing is chosen any more;  @param words  about them
  void elements_chosen(vtkSmartPointer<vtkPolyData> faces, const QString& words);

 private:
  using Values = std::shared_ptr<const ElementValues>;
  void measure_elements();
  void show_values(const Values& values);
  void choose(int bar);

  QComboBox* measure_;
  HistogramView* view_;
  QLabel* words_;
  FrameData mesh_;
  Values values_;
  NewestTask<Values> measuring_;
  NewestTask<vtkSmartPointer<vtkPolyData>> collecting_;
};

}  // namespace breccia::gui
