#include "core/case_queries.hpp"

#include <QDir>

#include "core/mesh_parameters.hpp"
#include "core/written_file.hpp"

namespace breccia::gui {

QString words_of(Query query) {
  switch (query) {
    case Query::check:
      return CaseQueries::tr("check");
    case Query::mesh:
      return CaseQueries::tr("mesh");
    case Query::domains:
      return CaseQueries::tr("domains");
    case Query::joints:
      return CaseQueries::tr("joints");
    case Query::parameters:
      return CaseQueries::tr("parameters of the geometry");
  }
  return {};
}

CaseQueries::CaseQueries(const Document& document, QString program, QObject* parent)
    : QObject(parent), document_(document), program_(std::move(program)) {
  const auto ended = [this] {
    if (!busy() && !draft_.isEmpty()) QFile::remove(draft_);
    emit busy_changed();
  };
  const auto join = [this, ended](SolverQuery& query, Query what) {
    connect(&query, &SolverQuery::answered, this, ended);
    const SolverQuery* own = &query;
    connect(own, &SolverQuery::failed, this, [this, ended, what, own](QString text, std::vector<Problem> problems) {
      if (!draft_.isEmpty()) {  // the user knows the case by its own name
        text.replace(draft_, document_.file());
        for (Problem& p : problems)
          if (p.file == draft_.toStdString()) p.file = document_.file().toStdString();
      }
      ended();
      emit failed(what, text, problems, asked_.value(own));
    });
  };
  join(check_, Query::check);
  join(mesh_, Query::mesh);
  join(domains_, Query::domains);
  join(joints_, Query::joints);
  join(parameters_, Query::parameters);
  connect(&parameters_, &SolverQuery::answered, this, &CaseQueries::parameters_told);
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

QString CaseQueries::draft(Query what) {
  if (!document_.modified() && document_.is_on_disk()) return document_.file();
  draft_ = QDir(document_.folder()).filePath(own_name("draft") + ".toml");
  const QString error = written(draft_, document_.text());
  if (error.isEmpty()) return draft_;
  emit failed(what, tr("%1: save the case into a folder of your own").arg(error), {}, {});
  return {};
}

void CaseQueries::ask(SolverQuery& query, Query what, const QString& command, const QStringList& options) {
  asked_[&query] = document_.text();
  if (const QString file = draft(what); !file.isEmpty()) query.ask(program_, QStringList{command, file} + options);
  emit busy_changed();
}

void CaseQueries::check() { ask(check_, Query::check, "check", {"--json"}); }

void CaseQueries::mesh() {
  const QString folder = scratch_.filePath(QString::number(++meshes_));
  QDir(scratch_.filePath(QString::number(meshes_ - 2))).removeRecursively();
  ask(mesh_, Query::mesh, "mesh", {"--json", "-o", folder});
}

void CaseQueries::joints() { ask(joints_, Query::joints, "check", {"--joints"}); }

void CaseQueries::parameters() {
  const QString geometry = script_of(document_);
  if (geometry.isEmpty()) return parameters_.cancel();
  asked_[&parameters_] = document_.text();
  parameters_.ask(program_, {"mesh", geometry, "--parameters"});
  emit busy_changed();
}

void CaseQueries::domains(int ranks) {
  ask(domains_, Query::domains, "check", {"--json", "--ranks", QString::number(ranks)});
}

}  // namespace breccia::gui
