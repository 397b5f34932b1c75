#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTimer>

#include "core/run_folder.hpp"

namespace breccia::gui {

/// Walks through the recorded frames of a run, also while it goes on.
class ResultsPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit ResultsPanel(QWidget* parent = nullptr);
  void set_run(const QString& folder);
  void set_frames(const std::vector<RunFrame>& frames);
  [[nodiscard]] bool follows() const { return follow_->isChecked(); }
  void set_follow(bool on) { follow_->setChecked(on); }
  void stop_playing() { play_->setChecked(false); }
  /// The frame that was asked for last is seen: while frames are played, the next one follows.
  void frame_shown();

 signals:
  void frame_wanted(int number);
  void paraview_wanted();
  void picture_wanted();
  void curves_wanted();
  void animation_wanted();

 protected:
  void hideEvent(QHideEvent* event) override;

 private:
  void moved(int number);
  void play(bool on);
  void play_next();

  QLabel *run_, *time_;
  QSlider* slider_;
  QCheckBox* follow_;
  QPushButton *back_, *forward_, *play_, *paraview_, *picture_, *curves_, *animation_;
  std::vector<RunFrame> frames_;
  QTimer pace_;
};

}  // namespace breccia::gui
