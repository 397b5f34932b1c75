#pragma once

#include <QComboBox>
#include <QLabel>
#include <memory>

#include "core/newest_task.hpp"
#include "render/element_values.hpp"
#include "render/scene.hpp"

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

/// How the elements of the frame in view are shaped, and how large what is coloured is: a histogram whose bars show
/// their elements or joints in the view. Numbers and faces are worked out on another thread.
class HistogramPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit HistogramPanel(QWidget* parent = nullptr);
  /// One without elements: there is none. The bar that is chosen stays chosen where another frame of a run follows.
  void set_frame(const FrameData& frame, bool follows);
  /// The histogram is of what the view is coloured by.
  void follow(Colouring colouring);
  /// The last values; nullptr: none yet.
  [[nodiscard]] const ElementValues* values() const { return counted_ == nullptr ? nullptr : &counted_->values; }
  [[nodiscard]] bool busy() const { return measuring_.busy() || collecting_.busy(); }

 signals:
  /// @param faces  nullptr: nothing is chosen any more;  @param words  about them
  void elements_chosen(vtkSmartPointer<vtkPolyData> faces, const QString& words);

 private:
  /// A frame and its numbers: those requested next may be of another frame.
  struct Counts {
    FrameData frame;
    ElementValues values;
  };
  using Counted = std::shared_ptr<const Counts>;
  void measure_elements();
  void show_values(const Counted& counted);
  void choose(int bar);
  [[nodiscard]] Measure measure() const { return static_cast<Measure>(measure_->currentData().toInt()); }

  QComboBox* measure_;
  HistogramView* view_;
  QLabel* words_;
  FrameData frame_;
  int keeps_ = -1;  ///< bar to choose again once the next frame is counted
  Counted counted_;
  NewestTask<Counted> measuring_;
  NewestTask<vtkSmartPointer<vtkPolyData>> collecting_;
};

}  // namespace breccia::gui
