#include "core/geometry_import.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <algorithm>

#include "base/geometry_file.hpp"
#include "core/material_library.hpp"
#include "core/value_text.hpp"
#include "core/written_file.hpp"

namespace breccia::gui {
namespace {

QString import_text(const char* words) { return QCoreApplication::translate("import", words); }

/// What a new case begins with.
LibraryMaterial first_material() {
  constexpr const char* kName = "Concrete C30/37";
  for (LibraryMaterial& material : shipped_materials())
    if (material.name == kName) return material;
  return {};
}

QString case_text(const QString& file, const QStringList& groups, double metres) {
  const QFileInfo about(file);
  const LibraryMaterial material = first_material();
  QString out = "title = " + quoted(about.completeBaseName()) + "\n\n[mesh]\nfile = " + quoted(about.fileName()) + "\n";
  if (metres != 1) out += "scale = " + QString::number(metres, 'g', 17) + "\n";
  QStringList names;
  for (const QString& group : groups) names << quoted(group);
  const QString all = names.size() == 1 ? names[0] : "[" + names.join(", ") + "]";
  out +=
      "\n[[material]]                         # values of \"" + material.name + "\" of the library: put in your own\n";
  out += "group = " + all + "\n";
  for (const char* key : {"young", "poisson", "density"}) out += QString("%1 = %2\n").arg(key, material.value(key));
  out += "joints = \"breakable\"\n\n[[joint]]\ngroup = " + (names.size() == 1 ? all : quoted("*")) + "\n";
  for (const MaterialValue& v : material.values)
    if (v.key.startsWith("joint.")) out += v.key.mid(6) + " = " + v.toml + "\n";
  out += "\n[[contact]]\nbetween = [\"*\", \"*\"]\nfriction = 0.4\n";
  return out + "\n[[stage]]\nend = \"1 ms\"\n\n[output]\nframe_interval = \"20 us\"\n";
}

}  // namespace

const std::vector<LengthUnit>& length_units() {
  static const std::vector<LengthUnit> units{{import_text("millimetre"), 0.001},
                                             {import_text("metre"), 1},
                                             {import_text("centimetre"), 0.01},
                                             {import_text("inch"), 0.0254}};
  return units;
}

QStringList geometry_patterns(bool scripts) {
  QStringList patterns;
  for (const std::string& ending : geometry_endings()) {
    const QString pattern = "*" + QString::fromStdString(ending);
    for (const QString& one : {pattern, pattern.toUpper()}) {
      const GeometryFile kind = geometry_file(one.toStdString());
      if (kind != GeometryFile::unknown && (scripts || kind != GeometryFile::script)) patterns << one;
    }
  }
  return patterns;
}

bool needs_unit(const QString& file) { return states_no_unit(geometry_file(file.toStdString())); }

std::array<double, 3> box_of_answer(const QJsonObject& mesh) {
  const QJsonObject box = mesh["box"].toObject();
  const QJsonArray lower = box["lower"].toArray(), upper = box["upper"].toArray();
  return {upper[0].toDouble() - lower[0].toDouble(), upper[1].toDouble() - lower[1].toDouble(),
          upper[2].toDouble() - lower[2].toDouble()};
}

QString import_geometry(const QString& file, const QJsonObject& mesh, double metres, const Places& places,
                        QString* error) {
  const QFileInfo from(file);
  const QDir projects(places.projects);
  QString folder = projects.filePath(from.completeBaseName());
  for (int i = 2; QFileInfo::exists(folder); ++i)
    folder = projects.filePath(QString("%1-%2").arg(from.completeBaseName()).arg(i));
  QStringList groups;
  for (const QJsonValue& group : mesh["groups"].toObject()["volumes"].toArray())
    groups << group.toObject()["name"].toString();
  if (!QDir().mkpath(folder) || !QFile::copy(file, QDir(folder).filePath(from.fileName()))) {
    *error = import_text("%1 cannot be copied into %2").arg(file, folder);
    return {};
  }
  const QString name = QDir(folder).filePath("case.toml");
  *error = written(name, case_text(file, groups, metres).toUtf8());
  return error->isEmpty() ? name : QString();
}

}  // namespace breccia::gui
