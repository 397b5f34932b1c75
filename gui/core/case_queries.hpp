#pragma once

#include <QDir>
#include <QMap>
#include <QTemporaryDir>

#include "core/document.hpp"
#include "core/own_files.hpp"
#include "core/solver_query.hpp"

namespace breccia::gui {

/// Kind of a query to the solver about a case.
enum class Query { check, mesh, domains, joints, parameters };
/// For messages.
[[nodiscard]] QString words_of(Query query);

/// Reports of the solver's commands on the edited case, saved or not: they read a draft beside the case, so that
/// relative names remain valid.
class CaseQueries final : public QObject {
  Q_OBJECT
 public:
  CaseQueries(const Document& document, QString program, QObject* parent = nullptr);
  ~CaseQueries() override;

  void check();
  /// The mesh at rest is written for the preview.
  void mesh();
  void domains(int ranks);
  void joints();
  /// Parameters that the geometry of the case offers; no query without a geometry.
  void parameters();
  [[nodiscard]] bool busy() const {
    return check_.busy() || mesh_.busy() || domains_.busy() || joints_.busy() || parameters_.busy();
  }

 signals:
  void busy_changed();
  void checked(const QJsonObject& json);
  /// @param elements_file  VTKHDF
  void meshed(const QJsonObject& json, const QString& elements_file);
  void divided(const QJsonObject& json);
  void joints_told(const QJsonObject& json);
  void parameters_told(const QJsonObject& json);
  /// @param asked  text of the case at the query, which may have been edited since
  void failed(Query what, const QString& text, const std::vector<breccia::Problem>& problems, const QByteArray& asked);

 private:
  /// Sends a query: a command line whose second word is the file that the command reads.
  void ask(SolverQuery& query, Query what, const QString& command, const QStringList& options);
  /// The file that a command reads. Empty: it could not be written, reported by `failed`.
  [[nodiscard]] QString draft(Query what);

  const Document& document_;
  QString program_;
  QTemporaryDir scratch_{QDir::temp().filePath(own_name("preview") + "-XXXXXX")};
  SolverQuery check_, mesh_, domains_, joints_, parameters_;
  QMap<const SolverQuery*, QByteArray> asked_;  ///< text of the case at each query
  int meshes_ = 0;
  QString draft_;
};

}  // namespace breccia::gui
