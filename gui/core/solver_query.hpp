#pragma once

#include <QJsonObject>
#include <QObject>
#include <QProcess>
#include <vector>

#include "base/error.hpp"
#include "core/newest_task.hpp"

namespace breccia::gui {

/// One question to the solver (`check --json`, `mesh --json`): a child process whose answer is a JSON object. A new
/// question ends the one before.
class SolverQuery final : public QObject {
  Q_OBJECT
 public:
  explicit SolverQuery(QObject* parent = nullptr);
  ~SolverQuery() override;

  void ask(const QString& program, const QStringList& arguments);
  void cancel();
  [[nodiscard]] bool busy() const { return process_ != nullptr || reading_.busy(); }

 signals:
  void answered(const QJsonObject& json);
  /// @param problems  of the case; empty: the program failed, `text` is the reason
  void failed(const QString& text, const std::vector<breccia::Problem>& problems);

 private:
  struct Answer {
    QJsonObject json;
    bool good = false;
    QString errors, fault;  ///< of the program; of the process
  };
  void finish(QProcess* process);
  void tell(const Answer& answer);
  QProcess* process_ = nullptr;
  NewestTask<Answer> reading_;  ///< that of a large mesh takes longer than the window may wait
};

}  // namespace breccia::gui
