#pragma once

#include <QObject>
#include <QProcess>
#include <QString>

namespace breccia::gui {

/// Has the solver write its report of a run, `breccia report`, while the window lives.
class ReportMaker final : public QObject {
  Q_OBJECT
 public:
  explicit ReportMaker(QObject* parent = nullptr);
  ~ReportMaker() override;
  [[nodiscard]] bool busy() const { return process_.state() != QProcess::NotRunning; }
  /// @pre not busy
  void make(const QString& program, const QString& run_folder, const QString& file);
  void cancel();

 signals:
  /// @param error  in the solver's words; empty: the page is written
  /// @param notes  what the page lacks, and why; empty: nothing
  void done(const QString& file, const QString& error, const QString& notes);

 private:
  QProcess process_;
  QString file_;
  bool cancelled_ = false;
};

}  // namespace breccia::gui
