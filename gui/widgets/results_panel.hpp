#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTimer>
#include <QVBoxLayout>

#include "core/run_folder.hpp"

namespace breccia::gui {

/// A run that can be chosen: its name, state, when it was started, and ranks.
struct RunChoice {
  QString folder, words;
  bool operator==(const RunChoice&) const = default;
};

/// Selection of a run, and playback of its recorded frames, also during the run.
class ResultsPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit ResultsPanel(QWidget* parent = nullptr);
  /// @param folder  empty: none
  void set_run(const QString& folder);
  /// The runs of the case, newest first, with the one that is shown among them.
  void set_choices(const std::vector<RunChoice>& choices);
  /// There are curves to be exported: of the run that is shown, or of others that are ticked.
  void set_has_curves(bool any) { curves_->setEnabled(any); }
  /// The report is being written.
  void set_reporting(bool on);
  void set_frames(const std::vector<RunFrame>& frames);
  [[nodiscard]] bool follows() const { return follow_->isChecked(); }
  void set_follow(bool on) { follow_->setChecked(on); }
  /// The frame in hand is wanted once more, since it is to be drawn otherwise.
  void ask_again() { moved(slider_->value()); }
  void stop_playing() { play_->setChecked(false); }
  /// The frame requested last is shown: while frames are played, the next one follows.
  void frame_shown();

 signals:
  void frame_wanted(int number);
  void paraview_wanted();
  void picture_wanted();
  void curves_wanted();
  void animation_wanted();
  void report_wanted();
  void run_chosen(const QString& folder);
  void other_run_wanted();

 protected:
  void hideEvent(QHideEvent* event) override;

 private:
  void moved(int number);
  void choose_shown();
  void make_picker(QVBoxLayout& column);
  void play(bool on);
  void play_next();

  QComboBox* runs_;
  QLabel* time_;
  QSlider* slider_;
  QCheckBox* follow_;
  QPushButton *back_, *forward_, *play_, *paraview_, *picture_, *curves_, *animation_, *report_, *other_;
  QString folder_;  ///< of the run that is shown; empty: none
  std::vector<RunChoice> choices_;
  std::vector<RunFrame> frames_;
  QTimer pace_;
};

}  // namespace breccia::gui
