#include "core/solver_query.hpp"

#include <QJsonArray>
#include <QJsonDocument>

namespace breccia::gui {
namespace {

std::vector<Problem> problems_of(const QJsonObject& json) {
  std::vector<Problem> problems;
  for (const QJsonValue& value : json["problems"].toArray()) {
    const QJsonObject p = value.toObject();
    problems.push_back({p["file"].toString().toStdString(), p["line"].toInt(), p["key"].toString().toStdString(),
                        p["what"].toString().toStdString(), p["allowed"].toString().toStdString(),
                        p["given"].toString().toStdString()});
  }
  return problems;
}

}  // namespace

SolverQuery::SolverQuery(QObject* parent) : QObject(parent) {}

SolverQuery::~SolverQuery() { cancel(); }

void SolverQuery::cancel() {
  if (process_ == nullptr) return;
  QProcess* process = process_;
  process_ = nullptr;
  process->disconnect(this);
  // It is deleted when it has ended; nothing waits here.
  process->setParent(nullptr);
  connect(process, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), process, &QObject::deleteLater);
  process->kill();
}

void SolverQuery::ask(const QString& program, const QStringList& arguments) {
  cancel();
  auto* process = new QProcess(this);
  process_ = process;
  connect(process, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this,
          [this, process](int, QProcess::ExitStatus) { finish(process); });
  connect(process, &QProcess::errorOccurred, this, [this, process](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) finish(process);
  });
  process->start(program, arguments, QIODevice::ReadOnly);
}

void SolverQuery::finish(QProcess* process) {
  if (process != process_) return;
  process_ = nullptr;
  process->deleteLater();
  const QJsonObject json = QJsonDocument::fromJson(process->readAllStandardOutput()).object();
  const bool good = process->exitStatus() == QProcess::NormalExit && process->exitCode() == 0 && !json.isEmpty();
  if (good) {
    emit answered(json);
    return;
  }
  const std::vector<Problem> problems = problems_of(json);
  QString text = QString::fromUtf8(process->readAllStandardError()).trimmed();
  if (text.isEmpty()) text = process->errorString();
  emit failed(problems.empty() ? text : QString(), problems);
}

}  // namespace breccia::gui
