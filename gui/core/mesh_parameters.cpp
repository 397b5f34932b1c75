#include "core/mesh_parameters.hpp"

#include <QDir>
#include <QJsonArray>
#include <algorithm>

#include "base/geometry_file.hpp"
#include "core/value_text.hpp"

namespace breccia::gui {
namespace {

const std::string kTable = "mesh.parameters";

QString below(const QString& name) { return QString::fromStdString(kTable) + "." + name; }

}  // namespace

QString ParameterRow::path() const { return below(name); }

std::vector<MeshParameter> mesh_parameters(const QJsonObject& answer) {
  std::vector<MeshParameter> found;
  for (const QJsonValue& value : answer["parameters"].toArray()) {
    const QJsonObject row = value.toObject();
    MeshParameter parameter{{}, row["default"].toString(), row["words"].toString()};
    for (const QJsonValue& name : row["names"].toArray())
      if (!name.toString().contains('.'))
        parameter.names << name.toString();  // it could not be distinguished from a path
    if (!parameter.names.isEmpty()) found.push_back(std::move(parameter));
  }
  return found;
}

std::vector<ParameterRow> parameter_rows(const std::optional<std::vector<MeshParameter>>& known,
                                         const TomlPlaces& places) {
  const Place* table = places.find(kTable);
  if (table != nullptr && table->kind == Place::Kind::value) return {};
  QStringList given;
  for (const std::string& name : places.names_below(kTable)) given << QString::fromStdString(name);
  std::vector<ParameterRow> rows;
  for (const MeshParameter& parameter : known.value_or(std::vector<MeshParameter>())) {
    const auto own = std::find_if(parameter.names.begin(), parameter.names.end(),
                                  [&](const QString& name) { return given.contains(name); });
    const QString name = own == parameter.names.end() ? parameter.names.front() : *own;
    rows.push_back({name, parameter.fallback, parameter.words});
    given.removeAll(name);
  }
  for (const QString& name : given) rows.push_back({name, {}, {}, !known});
  return rows;
}

bool is_mesh_parameter(const QString& path) { return path.startsWith(below({})); }

void set_parameter(Document& document, const QString& path, const QString& toml) {
  const TomlPlaces& places = document.places();
  if (toml.isEmpty()) return document.remove(path);
  if (places.find(kTable) != nullptr || !places.names_below(kTable).empty()) return document.set_value(path, toml);
  const QString name = QString::fromStdString(toml_key(leaf_of(path.toStdString())));
  document.set_value(QString::fromStdString(kTable), "{ " + name + " = " + toml + " }");
}

QString script_of(const Document& document) {
  const QString name = shown_value(case_::key_of("mesh.file"), document.value("mesh.file"));
  const bool is_script = geometry_file(name.toStdString()) == GeometryFile::script;
  return is_script ? QDir(document.folder()).absoluteFilePath(name) : QString();
}

}  // namespace breccia::gui
