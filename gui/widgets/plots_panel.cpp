#include "widgets/plots_panel.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace breccia::gui {
namespace {

QVTKOpenGLNativeWidget* canvas(vtkGenericOpenGLRenderWindow* window, HistoryChart& chart, const QString& name) {
  auto* widget = new QVTKOpenGLNativeWidget;
  window->SetMultiSamples(0);
  widget->setRenderWindow(window);
  window->AddRenderer(chart.renderer());
  widget->setAccessibleName(name);
  widget->setToolTip(name);
  widget->setMinimumSize(240, 140);
  widget->setFocusPolicy(Qt::StrongFocus);
  return widget;
}

/// Curves of those columns that are there and are not zero throughout.
std::vector<Curve> curves_of(const History& history, const QStringList& columns, const QString& unit) {
  std::vector<Curve> curves;
  for (const QString& name : columns) {
    const int column = history.column(unit.isEmpty() ? name : name + " [" + unit + "]");
    if (column < 0) continue;
    const std::vector<double>& values = history.values(column);
    bool zero = true;
    for (const double x : values) zero = zero && !(x != 0);
    if (!zero) curves.push_back({name.toStdString(), values});
  }
  return curves;
}

/// The curve of another run.
void add_other(std::vector<Curve>& curves, const QString& run, const History& history, const QString& name,
               const QString& unit) {
  const int time = history.column("time [s]"),
            column = history.column(unit.isEmpty() ? name : name + " [" + unit + "]");
  if (time >= 0 && column >= 0)
    curves.push_back({(run + ": " + name).toStdString(), history.values(column), history.values(time)});
}

}  // namespace

PlotsPanel::PlotsPanel(QWidget* parent)
    : QWidget(parent),
      energies_canvas_(canvas(energies_window_, energies_, tr("Energies [J] over time [us]"))),
      breaking_canvas_(canvas(breaking_window_, breaking_, tr("Broken joints and fragments over time [us]"))) {
  setObjectName("plots");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(2, 2, 2, 2);
  no_data_ = new QLabel(tr("No data yet: curves appear with the first samples of a run."));
  no_data_->setObjectName("no_data");
  no_data_->setWordWrap(true);
  auto* row = new QHBoxLayout;
  column->addWidget(no_data_);
  column->addLayout(row, 1);
  for (QWidget* chart : {energies_canvas_, breaking_canvas_}) {
    row->addWidget(chart);
    chart->hide();
  }
  unfolding_.setSingleShot(true);
  connect(&unfolding_, &QTimer::timeout, this, &PlotsPanel::unfold);
}

/// It is in front: a panel behind another one is never painted.
void PlotsPanel::paintEvent(QPaintEvent* event) {
  QWidget::paintEvent(event);
  if (stale_ || energies_canvas_->isHidden()) unfolding_.start(0);
}

/// OpenGL takes a tenth of a second to begin in each chart: one at a time, and only where they are seen.
void PlotsPanel::unfold() {
  for (QWidget* chart : {energies_canvas_, breaking_canvas_}) {
    if (!chart->isHidden()) continue;
    chart->show();
    unfolding_.start(0);
    return;
  }
  render();
}

void PlotsPanel::render() {
  stale_ = energies_canvas_->isHidden() || breaking_canvas_->isHidden() || visibleRegion().isEmpty();
  if (stale_) return;
  energies_window_->Render();
  breaking_window_->Render();
}

void PlotsPanel::show_history(const History& history, const std::vector<std::pair<QString, const History*>>& others) {
  const int time = history.column("time [s]");
  if (time < 0) {
    energies_.show({}, {}, "energy [J]");
    breaking_.show({}, {}, "count");
  } else {
    std::vector<Curve> energies = curves_of(history,
                                            {"kinetic", "elastic", "joint mode 1", "joint mode 2", "contact friction",
                                             "damping", "plastic", "external work", "residual"},
                                            "J");
    std::vector<Curve> breaking = curves_of(
        history, {"damaged joints", "broken joints", "broken in mode I", "broken in mode II", "fragments"}, "");
    for (const auto& [run, other] : others) {
      add_other(energies, run, *other, "kinetic", "J");
      add_other(breaking, run, *other, "broken joints", {});
    }
    energies_.show(history.values(time), energies, "energy [J]");
    breaking_.show(history.values(time), breaking, "count");
  }
  no_data_->setVisible(num_curves() == 0);
  render();
}

void PlotsPanel::set_dark(bool dark) {
  energies_.set_dark(dark);
  breaking_.set_dark(dark);
  render();
}

int PlotsPanel::num_curves() const { return static_cast<int>(energies_.num_curves() + breaking_.num_curves()); }

}  // namespace breccia::gui
