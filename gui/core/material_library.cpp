#include "core/material_library.hpp"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QRegularExpression>
#include <algorithm>

#include "core/shipped_materials.hpp"
#include "core/value_text.hpp"
#include "core/written_file.hpp"

namespace breccia::gui {
namespace {

const QString kJoint = "joint.";

/// The text of a basic or a literal TOML string.
QString string_of(const QString& toml) {
  if (toml.startsWith('\'')) return toml.mid(1, toml.size() - 2);
  const QJsonArray one = QJsonDocument::fromJson("[" + toml.toUtf8() + "]").array();
  return one.isEmpty() ? QString() : one[0].toString();
}

/// Path of the joints inside the groups of a material: "joint[1]"; empty: there are none.
QString joints_of(const Document& document, const QString& material) {
  const QStringList groups = names_in(document.value(material + ".group"));
  const int count = document.places().count("joint");
  QString of_any;
  for (int i = 0; i < count; ++i) {
    const QString path = QString("joint[%1]").arg(i);
    const QStringList names = names_in(document.value(path + ".group"));
    if (names == QStringList("*")) of_any = path;
    if (std::any_of(names.begin(), names.end(), [&](const QString& name) { return groups.contains(name); }))
      return path;
  }
  return of_any;
}

QByteArray text_of(const LibraryMaterial& material) {
  QString text = "[[material]]\nname = " + quoted(material.name) + "\nkind = " + quoted(material.kind) + "\n";
  if (!material.note.isEmpty()) text += "note = " + quoted(material.note) + "\n";
  for (const MaterialValue& v : material.values) text += v.key + " = " + v.toml + "\n";
  for (const MaterialValue& v : material.values)
    if (!v.source.isEmpty()) text += "source." + v.key + " = " + quoted(v.source) + "\n";
  return (text + "\n").toUtf8();
}

}  // namespace

QString LibraryMaterial::value(const QString& key) const {
  for (const MaterialValue& v : values)
    if (v.key == key) return v.toml;
  return {};
}

std::vector<LibraryMaterial> read_materials(const QByteArray& toml) {
  const TomlPlaces places(toml.toStdString());
  const auto text = [&](const std::string& path) {
    const std::string_view found = places.value(path);
    return QString::fromUtf8(found.data(), static_cast<int>(found.size()));
  };
  std::vector<LibraryMaterial> list;
  for (int i = 0; i < places.count("material"); ++i) {
    const std::string path = "material[" + std::to_string(i) + "]";
    LibraryMaterial material;
    material.name = string_of(text(path + ".name"));
    material.kind = string_of(text(path + ".kind"));
    material.note = string_of(text(path + ".note"));
    const auto add = [&](const QString& key) {
      material.values.push_back(
          {key, text(path + "." + key.toStdString()), string_of(text(path + ".source." + key.toStdString()))});
    };
    for (const std::string& key : places.names_below(path))
      if (key != "name" && key != "kind" && key != "note" && key != "source" && key != "joint")
        add(QString::fromStdString(key));
    for (const std::string& key : places.names_below(path + ".joint")) add(kJoint + QString::fromStdString(key));
    if (!material.name.isEmpty()) list.push_back(std::move(material));
  }
  return list;
}

std::vector<LibraryMaterial> shipped_materials() { return read_materials(shipped_materials_text()); }

std::vector<LibraryMaterial> UserLibrary::load() const {
  QFile file(file_);
  if (!file.open(QIODevice::ReadOnly)) return {};
  std::vector<LibraryMaterial> list = read_materials(file.readAll());
  for (LibraryMaterial& material : list) material.own = true;
  return list;
}

QString UserLibrary::trouble() const {
  QFile file(file_);
  if (!file.exists()) return {};
  if (!file.open(QIODevice::ReadOnly))
    return Document::tr("%1 cannot be read: %2; nothing was changed").arg(file_, file.errorString());
  const QByteArray text = file.readAll();
  static const QRegularExpression entry(R"(^\s*\[\[\s*material\s*\]\])", QRegularExpression::MultilineOption);
  int entries = 0;
  for (auto match = entry.globalMatch(QString::fromUtf8(text)); match.hasNext(); match.next()) ++entries;
  if (static_cast<int>(read_materials(text).size()) == entries && (entries > 0 || text.trimmed().isEmpty())) return {};
  return Document::tr(
             "%1 has entries that are no named materials and would be lost; correct or move the "
             "file")
      .arg(file_);
}

QString UserLibrary::save(const std::vector<LibraryMaterial>& list) const {
  QByteArray text;
  for (const LibraryMaterial& material : list) text += text_of(material);
  return written(file_, text);
}

QString UserLibrary::add(const LibraryMaterial& material) const {
  if (QString error = trouble(); !error.isEmpty()) return error;
  std::vector<LibraryMaterial> list = load();
  for (LibraryMaterial& old : list) {
    if (old.name != material.name) continue;
    old = material;
    return save(list);
  }
  list.push_back(material);
  return save(list);
}

QString UserLibrary::remove(const QString& name) const {
  if (QString error = trouble(); !error.isEmpty()) return error;
  std::vector<LibraryMaterial> rest;
  for (LibraryMaterial& material : load())
    if (material.name != name) rest.push_back(std::move(material));
  return save(rest);
}

LibraryMaterial material_of(const Document& document, const QString& path, const QString& name) {
  LibraryMaterial material{name, Document::tr("own"), {}, true, {}};
  const QString source = Document::tr("case %1").arg(QFileInfo(document.file()).fileName());
  const auto add_all = [&](const QString& section, const QString& prefix) {
    for (const std::string& key : document.places().names_below(section.toStdString())) {
      const QString own = QString::fromStdString(key), value = document.value(section + "." + own);
      if (own != "group" && own != "between" && !value.isEmpty())
        material.values.push_back({prefix + own, value, source});
    }
  };
  add_all(path, {});
  const QString joints = joints_of(document, path);
  if (!joints.isEmpty()) add_all(joints, kJoint);
  return material;
}

void take_material(Document& document, const QString& path, const LibraryMaterial& material) {
  const QString joints = joints_of(document, path);
  document.undo_stack().beginMacro(Document::tr("take %1").arg(material.name));
  for (const MaterialValue& v : material.values) {
    const bool of_joint = v.key.startsWith(kJoint);
    if (of_joint && joints.isEmpty()) continue;
    document.set_value(of_joint ? joints + "." + v.key.mid(kJoint.size()) : path + "." + v.key, v.toml);
  }
  document.undo_stack().endMacro();
}

}  // namespace breccia::gui
