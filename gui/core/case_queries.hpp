#pragma once

#include <QDir>
#include <QMap>
#include <QTemporaryDir>

#include "core/document.hpp"
#include "core/own_files.hpp"
#include "core/solver_query.hpp"

namespace breccia::gui {

/// What the solver is asked about a case.
enum class Query { check, mesh, domains, joints, parameters };
/// For messages.
[[nodiscard]] QString words_of(Query query);

/// What the solver's commands say of the case as it is edited, saved or not: a draft beside the case is what they read,
/// so that relative names hold.
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
  /// What the geometry of the case lets it set; nothing is asked where there is none.
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
  /// @param asked  text of the case that was asked about, which may have been edited since
  void failed(Query what, const QString& text, const std::vector<breccia::Problem>& problems, const QByteArray& asked);

 private:
  /// Asks with a command line of which the file that the command reads is the second word.
  void ask(SolverQuery& query, Query what, const QString& command, const QStringList& options);
  /// The file that a command reads. Empty: it could not be written, told by `failed`.
  [[nodiscard]] QString draft(Query what);

  const Document& document_;
  QString program_;
  QTemporaryDir scratch_{QDir::temp().filePath(own_name("preview") + "-XXXXXX")};
  SolverQuery check_, mesh_, domains_, joints_, parameters_;
  QMap<const SolverQuery*, QByteArray> asked_;  ///< text of the case when each was asked
  int meshes_ = 0;
  QString draft_;
};

}  // namespace breccia::gui
