#include "widgets/results_panel.hpp"

#include <QAbstractItemView>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QSignalBlocker>

#include "widgets/named_button.hpp"
#include "widgets/run_panel.hpp"

namespace breccia::gui {
namespace {

constexpr int kPace = 80;  // ms that a frame is seen while frames are played, beside the time that it takes to draw one

}  // namespace

ResultsPanel::ResultsPanel(QWidget* parent)
    : QWidget(parent),
      runs_(new QComboBox),
      time_(new QLabel),
      slider_(new QSlider(Qt::Horizontal)),
      follow_(new QCheckBox(tr("F&ollow the newest frame"))),
      back_(new QPushButton("◀")),
      forward_(new QPushButton("▶")),
      play_(named_button(tr("Pla&y"), "play", tr("Show the frames one after the other; from the last one, all (F9)"))),
      paraview_(new QPushButton(tr("Open in ParaVie&w"))),
      picture_(new QPushButton(tr("Save p&icture..."))),
      curves_(new QPushButton(tr("Export &curves..."))),
      animation_(new QPushButton(tr("Save &animation..."))),
      report_(named_button(tr("Re&port..."), "report",
                           tr("Have the solver write a page about this run, with figures, curves and pictures by "
                              "ParaView, that needs nothing beside it; it opens in the browser"))),
      other_(named_button(tr("Another..."), "other_run", tr("Open the folder of any other run"))) {
  time_->setObjectName("frame_time");
  slider_->setObjectName("frame");
  slider_->setAccessibleName(tr("Frame"));
  slider_->setToolTip(tr("Walk through the recorded frames (arrow keys)"));
  slider_->setRange(0, 0);
  follow_->setChecked(true);
  follow_->setObjectName("follow");
  follow_->setAccessibleName(tr("Follow the newest frame"));
  follow_->setToolTip(tr("Show each frame as soon as the run has written it"));
  back_->setObjectName("previous_frame");
  back_->setAccessibleName(tr("Previous frame"));
  back_->setToolTip(tr("Previous frame"));
  forward_->setObjectName("next_frame");
  forward_->setAccessibleName(tr("Next frame"));
  forward_->setToolTip(tr("Next frame"));
  play_->setCheckable(true);
  play_->setShortcut(QKeySequence(Qt::Key_F9));
  paraview_->setObjectName("open_paraview");
  paraview_->setAccessibleName(tr("Open in ParaView"));
  paraview_->setToolTip(
      tr("Start ParaView with the frames of this run, bodies by stress and joints by time of failure"));
  picture_->setObjectName("save_picture");
  picture_->setAccessibleName(tr("Save picture"));
  picture_->setToolTip(tr("Save the 3D view as PNG"));
  curves_->setObjectName("export_curves");
  curves_->setAccessibleName(tr("Export curves"));
  curves_->setToolTip(tr("Save the history of this run, and of those ticked in the table of runs, as CSV"));
  animation_->setObjectName("save_animation");
  animation_->setAccessibleName(tr("Save animation"));
  animation_->setToolTip(tr("Save all frames, as the 3D view shows them, as a film (MP4, by ffmpeg) or as pictures"));
  auto* column = new QVBoxLayout(this);
  make_picker(*column);
  column->addWidget(follow_);
  auto* row = new QHBoxLayout;
  row->addWidget(back_);
  row->addWidget(slider_, 1);
  row->addWidget(forward_);
  column->addLayout(row);
  auto* below = new QHBoxLayout;
  below->addWidget(time_, 1);
  below->addWidget(play_);
  column->addLayout(below);
  column->addWidget(paraview_);
  column->addWidget(picture_);
  column->addWidget(animation_);
  column->addWidget(curves_);
  column->addWidget(report_);
  column->addStretch();
  connect(slider_, &QSlider::valueChanged, this, &ResultsPanel::moved);
  connect(back_, &QPushButton::clicked, this, [this] {
    follow_->setChecked(false);
    slider_->setValue(slider_->value() - 1);
  });
  connect(forward_, &QPushButton::clicked, this, [this] { slider_->setValue(slider_->value() + 1); });
  connect(slider_, &QSlider::actionTriggered, this, [this] { follow_->setChecked(false); });
  pace_.setSingleShot(true);
  pace_.setInterval(kPace);
  connect(&pace_, &QTimer::timeout, this, &ResultsPanel::play_next);
  connect(play_, &QPushButton::toggled, this, &ResultsPanel::play);
  connect(paraview_, &QPushButton::clicked, this, &ResultsPanel::paraview_wanted);
  connect(picture_, &QPushButton::clicked, this, &ResultsPanel::picture_wanted);
  connect(curves_, &QPushButton::clicked, this, &ResultsPanel::curves_wanted);
  connect(report_, &QPushButton::clicked, this, &ResultsPanel::report_wanted);
  connect(other_, &QPushButton::clicked, this, &ResultsPanel::other_run_wanted);
  connect(animation_, &QPushButton::clicked, this, &ResultsPanel::animation_wanted);
  set_run({});
  set_has_curves(false);
}

void ResultsPanel::make_picker(QVBoxLayout& column) {
  runs_->setObjectName("results_run");
  runs_->setAccessibleName(tr("Run that is shown"));
  runs_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  runs_->setMinimumContentsLength(12);
  connect(runs_, qOverload<int>(&QComboBox::activated), this, [this](int row) {
    const QString folder = runs_->itemData(row).toString();
    if (!folder.isEmpty() && folder != folder_) emit run_chosen(folder);
  });
  auto* row = new QHBoxLayout;
  auto* label = new QLabel(tr("Ru&n"));
  label->setBuddy(runs_);
  row->addWidget(label, 1);
  row->addWidget(other_);
  column.addLayout(row);
  column.addWidget(runs_);
}

void ResultsPanel::set_choices(const std::vector<RunChoice>& choices) {
  if (choices == choices_) return;
  choices_ = choices;
  choose_shown();
}

void ResultsPanel::choose_shown() {
  const QSignalBlocker quiet(runs_);
  runs_->clear();
  for (const RunChoice& choice : choices_) {
    runs_->addItem(choice.words, choice.folder);
    runs_->setItemData(runs_->count() - 1, choice.folder, Qt::ToolTipRole);
  }
  int shown = runs_->findData(folder_);
  if (shown < 0) {
    runs_->insertItem(0, folder_.isEmpty() ? tr("no run is open") : QFileInfo(folder_).fileName(), folder_);
    shown = 0;
  }
  runs_->setCurrentIndex(shown);
  runs_->view()->setMinimumWidth(runs_->view()->sizeHintForColumn(0));  // names of runs differ in their ends
  const QString tip = tr("The runs of this case, newest first: name, state, start, ranks");
  runs_->setToolTip(folder_.isEmpty() ? tip : tip + "\n" + folder_);
}

void ResultsPanel::set_reporting(bool on) {
  report_->setText(on ? tr("The report is written...") : tr("Re&port..."));
  report_->setEnabled(!on && !folder_.isEmpty());
}

void ResultsPanel::set_run(const QString& folder) {
  folder_ = folder;
  choose_shown();
  set_reporting(false);
  stop_playing();
  set_frames({});
  follow_->setChecked(true);
}

void ResultsPanel::play(bool on) {
  if (!on) return pace_.stop();
  follow_->setChecked(false);
  if (slider_->value() < slider_->maximum()) return play_next();
  slider_->setValue(0);
  if (slider_->maximum() == 0) stop_playing();  // there is one frame alone, which is seen
}

void ResultsPanel::play_next() {
  if (slider_->value() == slider_->maximum()) return stop_playing();
  slider_->setValue(slider_->value() + 1);
}

void ResultsPanel::frame_shown() {
  if (play_->isChecked()) pace_.start();
}

void ResultsPanel::hideEvent(QHideEvent* event) {
  stop_playing();
  QWidget::hideEvent(event);
}

void ResultsPanel::set_frames(const std::vector<RunFrame>& frames) {
  frames_ = frames;
  const bool any = !frames_.empty();
  for (QWidget* w : {static_cast<QWidget*>(slider_), static_cast<QWidget*>(back_), static_cast<QWidget*>(forward_),
                     static_cast<QWidget*>(play_), static_cast<QWidget*>(paraview_), static_cast<QWidget*>(picture_),
                     static_cast<QWidget*>(animation_)})
    w->setEnabled(any);
  const int last = any ? static_cast<int>(frames_.size()) - 1 : 0;
  const int now = follow_->isChecked() ? last : std::min(slider_->value(), last);
  {
    const QSignalBlocker quiet(slider_);
    slider_->setRange(0, last);
    slider_->setValue(now);
  }
  if (any && follow_->isChecked()) {
    moved(now);
  } else if (any) {
    time_->setText(tr("frame %1 of %2").arg(now + 1).arg(frames_.size()));
  } else {
    time_->setText(tr("no frames yet"));
  }
}

void ResultsPanel::moved(int number) {
  if (number < 0 || number >= static_cast<int>(frames_.size())) return;
  time_->setText(tr("frame %1 of %2, time %3")
                     .arg(number + 1)
                     .arg(frames_.size())
                     .arg(quantity_words(frames_[static_cast<std::size_t>(number)].time, "s")));
  emit frame_wanted(number);
}

}  // namespace breccia::gui
