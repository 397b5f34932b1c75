#include "widgets/plots_panel.hpp"

#include <QCoreApplication>
#include <QEvent>
#include <QHeaderView>
#include <QLabel>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "core/history_columns.hpp"

namespace breccia::gui {
namespace {

/// Of a chart and of a part of the list.
QString quantity_of(const QString& unit) {
  static const QHash<QString, const char*> words{
      {"J", QT_TRANSLATE_NOOP("plots", "energy")},   {"N", QT_TRANSLATE_NOOP("plots", "force")},
      {"m", QT_TRANSLATE_NOOP("plots", "length")},   {"m/s", QT_TRANSLATE_NOOP("plots", "velocity")},
      {"Pa", QT_TRANSLATE_NOOP("plots", "stress")},  {"m2", QT_TRANSLATE_NOOP("plots", "area")},
      {"s", QT_TRANSLATE_NOOP("plots", "duration")}, {"N m", QT_TRANSLATE_NOOP("plots", "torque")},
      {"rad/s", QT_TRANSLATE_NOOP("plots", "spin")}, {"kg m/s", QT_TRANSLATE_NOOP("plots", "momentum")},
      {"", QT_TRANSLATE_NOOP("plots", "number")},    {"kg m2/s", QT_TRANSLATE_NOOP("plots", "angular momentum")}};
  return QCoreApplication::translate("plots", words.value(unit, QT_TRANSLATE_NOOP("plots", "value")));
}

/// Ticked before anyone has chosen: the terms of the energy, what breaks, and what gauges are mostly there for.
bool is_first_choice(const QString& column) {
  static const QStringList list{"kinetic [J]",          "elastic [J]",    "joint mode 1 [J]", "joint mode 2 [J]",
                                "contact friction [J]", "damping [J]",    "plastic [J]",      "external work [J]",
                                "residual [J]",         "damaged joints", "broken joints",    "broken in mode I",
                                "broken in mode II",    "fragments"};
  static const QRegularExpression gauge(
      R"(^.+(?<! max) displacement [xyz] \[m\]$|^.+ reaction [xyz] \[N\]$|^.+ elongation \[m\]$)");
  return list.contains(column) || gauge.match(column).hasMatch();
}

QVTKOpenGLNativeWidget* canvas(vtkGenericOpenGLRenderWindow* window, HistoryChart& chart) {
  auto* widget = new QVTKOpenGLNativeWidget;
  window->SetMultiSamples(0);
  widget->setRenderWindow(window);
  window->AddRenderer(chart.renderer());
  widget->setMinimumSize(120, 100);
  widget->setFocusPolicy(Qt::StrongFocus);
  widget->hide();
  return widget;
}

}  // namespace

PlotsPanel::PlotsPanel(QWidget* parent)
    : QWidget(parent),
      list_(new QTreeWidget),
      no_data_(new QLabel(tr("No data yet: curves appear with the first samples of a run."))),
      too_many_(new QLabel(tr("Curves of %1 units are drawn at most.").arg(kMostCharts))) {
  setObjectName("plots");
  no_data_->setObjectName("no_data");
  no_data_->setWordWrap(true);
  too_many_->setWordWrap(true);
  too_many_->hide();
  list_->setObjectName("curves");
  list_->setAccessibleName(tr("Curves"));
  list_->setToolTip(tr("Curves to draw, in a chart for each unit (space ticks the current one)"));
  list_->header()->hide();
  list_->setMinimumWidth(120);
  auto* row = new QSplitter;
  row->addWidget(list_);
  row->setChildrenCollapsible(false);
  for (Chart& chart : charts_) {
    row->addWidget(chart.canvas = canvas(chart.window, chart.chart));
    chart.canvas->installEventFilter(this);
    row->setStretchFactor(row->count() - 1, 1);
  }
  list_->setMaximumWidth(260);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(2, 2, 2, 2);
  column->addWidget(no_data_);
  column->addWidget(too_many_);
  column->addWidget(row, 1);
  unfolding_.setSingleShot(true);
  connect(&unfolding_, &QTimer::timeout, this, &PlotsPanel::unfold);
  connect(list_, &QTreeWidget::itemChanged, this, &PlotsPanel::ticked);
}

/// It is in front: a panel behind another one is never painted.
void PlotsPanel::paintEvent(QPaintEvent* event) {
  QWidget::paintEvent(event);
  if (stale_) unfolding_.start(0);
}

/// OpenGL takes a tenth of a second to begin in each chart: one at a time, and only where they are seen.
void PlotsPanel::unfold() {
  for (Chart& chart : charts_) {
    if (!chart.wanted || !chart.canvas->isHidden()) continue;
    chart.canvas->show();
    unfolding_.start(0);
    return;
  }
  render();
}

bool PlotsPanel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) unfolding_.start(0);
  return QWidget::eventFilter(watched, event);
}

void PlotsPanel::render() {
  const auto waits = [](const Chart& chart) { return chart.wanted && chart.canvas->isHidden(); };
  stale_ = std::any_of(charts_.begin(), charts_.end(), waits) || visibleRegion().isEmpty();
  if (stale_) return update();
  for (Chart& chart : charts_) {
    if (!chart.wanted || !chart.window->GetReadyForRendering()) continue;
    chart.window->Render();
    const std::array<int, 2> size{chart.window->GetSize()[0], chart.window->GetSize()[1]};
    if (size == std::exchange(chart.size, size)) continue;
    // A chart that got another size lays its axes out in one picture and draws by them in the next.
    chart.chart.renew_range();
    for (int picture = 0; picture < 2; ++picture) chart.window->Render();
  }
}

/// All but the step and the time themselves, by unit. It stays as it is while the columns do.
void PlotsPanel::list_columns() {
  if (listed_ == history_->columns()) return;
  listed_ = history_->columns();
  const QSignalBlocker quiet(list_);
  list_->clear();
  QHash<QString, QTreeWidgetItem*> parts;
  for (const QString& column : listed_) {
    if (column == "step" || column == "time [s]") continue;
    const auto [name, unit] = parts_of(column);
    QTreeWidgetItem*& part = parts[unit];
    if (part == nullptr) {
      const QString words = unit.isEmpty() ? quantity_of(unit) : QString("%1 [%2]").arg(quantity_of(unit), unit);
      part = new QTreeWidgetItem(list_, {words});
      part->setFlags(Qt::ItemIsEnabled);
    }
    auto* item = new QTreeWidgetItem(part, {name});
    item->setData(0, Qt::UserRole, column);
    item->setToolTip(0, column);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    const bool on = ticks_.value(column, is_first_choice(column));
    item->setCheckState(0, on ? Qt::Checked : Qt::Unchecked);
    if (on) part->setExpanded(true);
  }
}

void PlotsPanel::ticked(QTreeWidgetItem* item) {
  ticks_[item->data(0, Qt::UserRole).toString()] = item->checkState(0) == Qt::Checked;
  draw();
}

/// A curve that is not selected by the user is drawn once it is neither zero throughout nor mere rounding.
bool PlotsPanel::is_drawn(int column) const {
  const QString& name = history_->columns()[column];
  if (ticks_.contains(name)) return ticks_.value(name);
  return is_first_choice(name) && history_->largest(column) > 0 && !round_off_[static_cast<std::size_t>(column)];
}

/// Curves that are mere rounding are marked; those not ticked by the user are drawn once they are more.
void PlotsPanel::tell_round_off() {
  round_off_ = are_round_off(*history_);
  const QSignalBlocker quiet(list_);
  for (QTreeWidgetItemIterator it(list_); *it != nullptr; ++it) {
    const QString column = (*it)->data(0, Qt::UserRole).toString();
    if (column.isEmpty()) continue;
    const bool rounding = round_off_[static_cast<std::size_t>(history_->column(column))];
    const QString name = parts_of(column).name, words = rounding ? tr("%1 (only rounding)").arg(name) : name;
    if ((*it)->text(0) == words) continue;
    (*it)->setText(0, words);
    (*it)->setToolTip(0, rounding ? tr("%1: zero except for rounding; tick to draw it").arg(column) : column);
    if (!ticks_.contains(column))
      (*it)->setCheckState(0, is_first_choice(column) && !rounding ? Qt::Checked : Qt::Unchecked);
  }
}

/// In the order of the columns; those of other runs follow theirs.
PlotsPanel::CurvesByUnit PlotsPanel::chosen_curves() const {
  CurvesByUnit chosen;
  const int first = history_->column("kinetic [J]");  // columns of a history always follow each other in one order
  for (int column = 0; column < history_->columns().size(); ++column) {
    if (!is_drawn(column)) continue;
    const auto [name, unit] = parts_of(history_->columns()[column]);
    auto part = std::find_if(chosen.begin(), chosen.end(), [&](const auto& one) { return one.first == unit; });
    if (part == chosen.end()) part = chosen.insert(part, {unit, {}});
    const int look = std::max(0, column - first);
    part->second.push_back({name.toStdString(), history_->values(column), look});
    int number = 0;
    for (const auto& [run, other] : others_) {
      ++number;
      const int time = other->column("time [s]"), same = other->column(history_->columns()[column]);
      if (time < 0 || same < 0) continue;
      part->second.push_back(
          {name.toStdString(), other->values(same), look, number, run.toStdString(), other->values(time)});
    }
  }
  return chosen;
}

void PlotsPanel::show_history(const History& history, const std::vector<std::pair<QString, const History*>>& others) {
  history_ = &history;
  others_ = others;
  list_columns();
  tell_round_off();
  draw();
}

void PlotsPanel::draw() {
  const int time = history_->column("time [s]");
  const CurvesByUnit chosen = time < 0 ? CurvesByUnit() : chosen_curves();
  for (std::size_t i = 0; i < charts_.size(); ++i) {
    Chart& chart = charts_[i];
    chart.wanted = i < chosen.size();
    if (!chart.wanted) {
      chart.chart.show({}, {}, {}, {});
      chart.canvas->hide();
      continue;
    }
    const auto& [unit, curves] = chosen[i];
    const QString quantity = quantity_of(unit), words = tr("%1 over time").arg(quantity);
    chart.chart.show(history_->values(time), curves, quantity.toStdString(), unit.toStdString());
    chart.canvas->setAccessibleName(words);
    chart.canvas->setToolTip(words);
  }
  too_many_->setVisible(chosen.size() > charts_.size());
  no_data_->setVisible(num_curves() == 0);
  list_->setVisible(list_->topLevelItemCount() > 0);
  render();
}

void PlotsPanel::set_dark(bool dark) {
  for (Chart& chart : charts_) chart.chart.set_dark(dark);
  render();
}

int PlotsPanel::num_curves() const {
  std::size_t count = 0;
  for (const Chart& chart : charts_) count += chart.chart.num_curves();
  return static_cast<int>(count);
}

}  // namespace breccia::gui
