#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>

#include "core/solver_run.hpp"

class QVBoxLayout;

namespace breccia::gui {

/// Start and control of a run: estimate, ranks, command line, progress, pause, checkpoint, stop, and resume from a
/// checkpoint.
class RunPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit RunPanel(QWidget* parent = nullptr);

  [[nodiscard]] int ranks() const { return ranks_->value(); }
  void set_ranks(int ranks) { ranks_->setValue(ranks); }
  /// There are no more than cores, or the user has agreed to that.
  [[nodiscard]] bool accepts_ranks() const;
  /// Puts the cursor where one agrees to more ranks than cores.
  void ask_for_agreement() { oversubscribe_->setFocus(Qt::OtherFocusReason); }
  /// @param go_on  that to resume the selected run from its checkpoint; empty: it cannot be resumed
  void set_command(const QStringList& command, const QStringList& go_on);
  void set_problems(int count);
  /// Answer of `check --json`.
  void set_estimate(const QString& html);
  /// nullptr: no run is in hand.
  void show_run(const SolverRun* run);

 signals:
  void run_wanted();
  void queue_wanted();
  void pause_wanted();
  void stop_wanted();
  void checkpoint_wanted();
  void go_on_wanted();
  void check_wanted();
  void results_wanted();
  void ranks_changed(int ranks);

 private:
  [[nodiscard]] QWidget* command_row(QLineEdit* line, const QString& name, const QString& title);
  void make_ranks(QVBoxLayout& column);
  void make_buttons(QVBoxLayout& column);
  void set_state_words(const SolverRun& run);
  void show_checkpoints(const SolverRun& run);

  QSpinBox* ranks_;
  QCheckBox* oversubscribe_;
  QPushButton *run_, *queue_, *pause_, *checkpoint_, *stop_, *go_on_, *check_, *results_;
  QLineEdit *command_, *go_on_command_;
  QWidget* go_on_row_ = nullptr;
  QLabel *estimate_, *state_, *warning_, *checkpoints_;
  QProgressBar* progress_;
  QPlainTextEdit* failure_;
  int problems_ = 0;
  bool running_ = false;
};

/// "Run" or, with problems, how many: "Run (2 problems)".
[[nodiscard]] QString run_words(int problems);
/// "3 min 20 s".
[[nodiscard]] QString duration_words(double seconds);
/// Remaining time of a run: "3 min 20 s"; "-" for one that is not in progress.
[[nodiscard]] QString to_go_words(const SolverRun& run);
/// The same of a run in progress.
[[nodiscard]] QString to_go_words(const RunStatus& status);
/// "12.3 us" with a prefix of the unit.
[[nodiscard]] QString quantity_words(double value, const QString& unit);

}  // namespace breccia::gui
