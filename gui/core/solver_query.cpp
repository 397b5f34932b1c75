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

SolverQuery::SolverQuery(QObject* parent) : QObject(parent), reading_([this](const Answer& answer) { tell(answer); }) {}

SolverQuery::~SolverQuery() { cancel(); }

void SolverQuery::cancel() {
  reading_.forget();
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
  const bool good = process->exitStatus() == QProcess::NormalExit && process->exitCode() == 0;
  reading_.start([output = process->readAllStandardOutput(), errors = process->readAllStandardError(),
                  fault = process->errorString(), good] {
    const QJsonObject json = QJsonDocument::fromJson(output).object();
    return Answer{json, good && !json.isEmpty(), QString::fromUtf8(errors).trimmed(), fault};
  });
}

void SolverQuery::tell(const Answer& answer) {
  if (answer.good) {
    emit answered(answer.json);
    return;
  }
  const std::vector<Problem> problems = problems_of(answer.json);
  const QString text = answer.errors.isEmpty() ? answer.fault : answer.errors;
  emit failed(problems.empty() ? text : QString(), problems);
}

}  // namespace breccia::gui
