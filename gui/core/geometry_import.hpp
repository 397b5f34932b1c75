#pragma once

#include <QJsonObject>
#include <QString>
#include <QStringList>
#include <array>
#include <vector>

#include "core/places.hpp"

/// A case made of a solid or a mesh from elsewhere.
namespace breccia::gui {

/// A unit that the lengths of a file may have.
struct LengthUnit {
  QString name;
  double metres = 1;
};
[[nodiscard]] const std::vector<LengthUnit>& length_units();

/// Patterns of a dialog for files: "*.inp", "*.INP", ... @param scripts  those of gmsh as well, which may need others
[[nodiscard]] QStringList geometry_patterns(bool scripts);

/// Whether the user has to state the unit of this file.
[[nodiscard]] bool needs_unit(const QString& file);

/// Edges of the box in the answer of `breccia mesh FILE --json`, in units of the file.
[[nodiscard]] std::array<double, 3> box_of_answer(const QJsonObject& mesh);

/// Copies the file into a new folder below the projects and writes a case beside it: a material and a joint for each of
/// its volumes, with the values of a concrete of the shipped library to begin with, contact, one stage. Returns the
/// case file.
/// @param mesh    the answer of `breccia mesh FILE --json`
/// @param metres  a length of 1 in the file; 1 where the file states its unit
/// @param error   out: what went wrong; then the result is empty
[[nodiscard]] QString import_geometry(const QString& file, const QJsonObject& mesh, double metres, const Places& places,
                                      QString* error);

}  // namespace breccia::gui
