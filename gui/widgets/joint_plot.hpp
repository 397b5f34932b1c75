#pragma once

#include <QJsonObject>
#include <QWidget>
#include <vector>

namespace breccia::gui {

/// A joint law as the solver evaluates it (`check --joints`): traction over opening and slip with the energies as
/// areas and a line of unloading; beside it the strength under any traction.
class JointPlot final : public QWidget {
  Q_OBJECT
 public:
  explicit JointPlot(QWidget* parent = nullptr);
  /// @param law  one of the answer's `laws`; empty: nothing is drawn, and `words` give the reason
  void show_law(const QJsonObject& law, const QString& words);
  [[nodiscard]] QSize sizeHint() const override { return {700, 200}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {400, 140}; }
  /// Number of points drawn; for tests.
  [[nodiscard]] int num_points() const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Series {
    std::vector<double> x, y;
  };
  void paint_curves(QPainter& painter, const QRectF& box) const;
  void paint_envelope(QPainter& painter, const QRectF& box) const;
  [[nodiscard]] static Series series(const QJsonObject& from, const char* x, const char* y, double x_scale);

  Series normal_, shear_, unloading_, envelope_;
  double energy_1_ = 0, energy_2_ = 0;
  QString words_;
};

}  // namespace breccia::gui
