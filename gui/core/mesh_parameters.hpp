#pragma once

#include <QJsonObject>
#include <QString>
#include <QStringList>
#include <optional>
#include <vector>

#include "core/document.hpp"

namespace breccia::gui {

/// A number of a geometry that the case can set, as reported by the solver.
struct MeshParameter {
  QStringList names;  ///< any of them sets it
  QString fallback;   ///< its default in the geometry; empty: not stated
  QString words;      ///< comment of the geometry
  friend bool operator==(const MeshParameter&, const MeshParameter&) = default;
};

/// Of the answer of `mesh --parameters`.
[[nodiscard]] std::vector<MeshParameter> mesh_parameters(const QJsonObject& answer);

/// A row of the form.
struct ParameterRow {
  QString name;  ///< by which the case sets it, or would
  QString fallback, words;
  bool is_known = true;  ///< by the geometry
  [[nodiscard]] QString path() const;
  friend bool operator==(const ParameterRow&, const ParameterRow&) = default;
};

/// Those of the geometry in its order, then others that the case sets. Empty if mesh.parameters is no table.
/// @param known  of the geometry; none: not reported yet
[[nodiscard]] std::vector<ParameterRow> parameter_rows(const std::optional<std::vector<MeshParameter>>& known,
                                                       const TomlPlaces& places);

/// Whether a path is that of one of mesh.parameters.
[[nodiscard]] bool is_mesh_parameter(const QString& path);

/// Sets one as an edit that can be undone; the table is made where there is none. @param toml  empty: it is taken out
void set_parameter(Document& document, const QString& path, const QString& toml);

/// The .geo that mesh.file of a case names, absolute; empty: it names none.
[[nodiscard]] QString script_of(const Document& document);

}  // namespace breccia::gui
