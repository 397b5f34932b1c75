#pragma once

#include <QComboBox>
#include <QFutureWatcher>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QTimer>

#include "core/study.hpp"
#include "widgets/line_chart.hpp"

class QVBoxLayout;

namespace breccia::gui {

/// A run matrix: one or two keys with their values on the left, the runs of a study as a table, one of their results as
/// a plot.
class StudyPanel final : public QWidget {
  Q_OBJECT
 public:
  StudyPanel(const Document& document, const RunQueue& queue, QWidget* parent = nullptr);

  /// Studies of the case in hand; the first one is shown.
  void set_studies(const QStringList& folders);
  /// Why a study was not started; empty: it was.
  void show_problems(const QStringList& problems);
  [[nodiscard]] const std::optional<Study>& study() const { return study_; }
  [[nodiscard]] const std::vector<StudyResult>& results() const { return results_; }

 signals:
  void start_wanted(const std::vector<breccia::gui::StudyParameter>& parameters);
  void export_wanted();
  void run_chosen(const QString& folder);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void make_setup(QVBoxLayout& column);
  void make_results(QVBoxLayout& column);
  [[nodiscard]] std::vector<StudyParameter> parameters() const;
  void take_edit();
  void count_runs();
  void fill_keys();
  void show_study(const QString& folder);
  void look();
  void take_results();
  void show_table();
  void show_plot();

  const Document& document_;
  const RunQueue& queue_;
  QComboBox* keys_[2];
  QLineEdit* values_[2];
  QPushButton *start_, *export_;
  QLabel* words_;
  QComboBox *studies_, *column_;
  QTableWidget* table_;
  LineChart* chart_;
  QTimer timer_;
  std::optional<Study> study_;
  std::vector<StudyResult> results_;
  QFutureWatcher<std::vector<StudyResult>> reader_;
  QString read_folder_;  ///< of what the reader reads
};

}  // namespace breccia::gui
