#include "core/case_queries.hpp"

#include <QDir>

#include "core/written_file.hpp"

namespace breccia::gui {

CaseQueries::CaseQueries(const Document& document, QString program, QObject* parent)
    : QObject(parent), document_(document), program_(std::move(program)) {
  const auto ended = [this] {
    if (!busy() && !draft_.isEmpty()) QFile::remove(draft_);
    emit busy_changed();
  };
  const auto join = [this, ended](SolverQuery& query, const QString& what) {
    connect(&query, &SolverQuery::answered, this, ended);
    connect(&query, &SolverQuery::failed, this, [this, ended, what](QString text, std::vector<Problem> problems) {
      if (!draft_.isEmpty()) {  // the user knows the case by its own name
        text.replace(draft_, document_.file());
        for (Problem& p : problems)
          if (p.file == draft_.toStdString()) p.file = document_.file().toStdString();
      }
      ended();
      emit failed(what, text, problems);
    });
  };
  join(check_, tr("check"));
  join(mesh_, tr("mesh"));
  join(domains_, tr("domains"));
  join(joints_, tr("joints"));
  connect(&joints_, &SolverQuery::answered, this, &CaseQueries::joints_told);
  connect(&check_, &SolverQuery::answered, this, &CaseQueries::checked);
  connect(&domains_, &SolverQuery::answered, this, &CaseQueries::divided);
  connect(&mesh_, &SolverQuery::answered, this, [this](const QJsonObject& json) {
    emit meshed(json, scratch_.filePath(QString("%1/elements_000000.vtkhdf").arg(meshes_)));
  });
}

CaseQueries::~CaseQueries() {
  if (!draft_.isEmpty()) QFile::remove(draft_);
}

QString CaseQueries::draft(const QString& what) {
  if (!document_.modified() && document_.is_on_disk()) return document_.file();
  draft_ = QDir(document_.folder()).filePath(own_name("draft") + ".toml");
  const QString error = written(draft_, document_.text());
  if (error.isEmpty()) return draft_;
  emit failed(what, tr("%1: save the case into a folder of your own").arg(error), {});
  return {};
}

void CaseQueries::check() {
  if (const QString file = draft(tr("check")); !file.isEmpty()) check_.ask(program_, {"check", file, "--json"});
  emit busy_changed();
}

void CaseQueries::mesh() {
  const QString folder = scratch_.filePath(QString::number(++meshes_));
  QDir(scratch_.filePath(QString::number(meshes_ - 2))).removeRecursively();
  if (const QString file = draft(tr("mesh")); !file.isEmpty())
    mesh_.ask(program_, {"mesh", file, "--json", "-o", folder});
  emit busy_changed();
}

void CaseQueries::joints() {
  if (const QString file = draft(tr("joints")); !file.isEmpty()) joints_.ask(program_, {"check", file, "--joints"});
  emit busy_changed();
}

void CaseQueries::domains(int ranks) {
  if (const QString file = draft(tr("domains")); !file.isEmpty())
    domains_.ask(program_, {"check", file, "--json", "--ranks", QString::number(ranks)});
  emit busy_changed();
}

}  // namespace breccia::gui
