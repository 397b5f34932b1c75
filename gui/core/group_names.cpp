#include "core/group_names.hpp"

#include <algorithm>

#include "core/value_text.hpp"

namespace breccia::gui {
namespace {

using case_::Key;
using case_::ValueType;

/// A word of the user's own, not a quantity.
bool is_a_name(const Key& key) {
  using enum ValueType;
  return key.type == text || key.type == text_or_list || key.type == choice || key.type == text_pair ||
         key.type == text_list;
}

/// The names that the entries of a list have under a key.
QStringList taken(const std::string& list, const Key& key, const TomlPlaces& places) {
  QStringList names;
  for (int i = 0; i < places.count(list); ++i)
    names << names_in(text_of(places.value(list + "[" + std::to_string(i) + "]." + std::string(key.name()))));
  return names;
}

QStringList strings(const std::vector<std::string>& names) {
  QStringList list;
  for (const std::string& name : names) list << QString::fromStdString(name);
  return list;
}

}  // namespace

GroupKind group_kind(const Key& key) {
  if (key.path == "mesh.raster.group") return GroupKind::none;  // it gives the group its name
  const std::string_view name = key.name();
  for (const char* any : {"stage[].constraint[].group", "stage[].force[].group", "output.gauges", "gauge[].group"})
    if (key.path == any) return GroupKind::any;
  if (key.type == ValueType::text_or_list && name == "group") return GroupKind::volume;
  if (key.type == ValueType::text_or_list && name == "surface") return GroupKind::surface;
  const bool surfaces = name == "broken" || name == "absorbing" || name == "surfaces";
  return key.type == ValueType::text_list && surfaces ? GroupKind::surface : GroupKind::none;
}

bool names_many_groups(const Key& key) {
  return key.type == ValueType::text_list && group_kind(key) != GroupKind::none;
}

QString with_group(const QString& shown, const QString& group) {
  QStringList names;
  for (const QString& name : shown.split(',')) names << name.trimmed();
  names.removeAll(QString());
  if (!names.contains(group)) names << group;
  return names.join(", ");
}

QStringList groups_of_kind(GroupKind kind, const TomlPlaces& places, const std::optional<MeshGroups>& mesh) {
  if (kind == GroupKind::none) return {};
  QStringList volumes = mesh ? strings(mesh->volumes) : taken("material", case_::key_of("material[].group"), places);
  volumes.removeAll(QString());
  if (!mesh) volumes.removeAll("*");
  const QStringList surfaces = mesh ? strings(mesh->surfaces) : QStringList();
  const QStringList nodes = mesh ? strings(mesh->nodes) : QStringList();
  const QStringList sets = mesh ? strings(mesh->sets) : QStringList();
  return kind == GroupKind::volume    ? volumes
         : kind == GroupKind::surface ? surfaces
                                      : surfaces + nodes + volumes + sets;
}

QString lines_of_new_entry(const QString& list, const TomlPlaces& places, const std::optional<MeshGroups>& mesh) {
  const std::string own = list.toStdString(), pattern = case_::pattern_of(own) + "[]";
  QString lines;
  for (const Key* key : keys_in(pattern)) {
    const GroupKind kind = group_kind(*key);
    const bool of_joint = pattern == "joint[]" && key->name() == "group";  // or of a pair, which is rarer
    QString value;
    if (kind != GroupKind::none && (key->required || of_joint)) {
      const QStringList used = taken(own, *key, places), all = groups_of_kind(kind, places, mesh);
      const auto free = std::find_if(all.begin(), all.end(), [&](const QString& name) { return !used.contains(name); });
      if (free != all.end()) value = quoted(*free);
    } else if (key->required && is_a_name(*key)) {
      value = QString::fromUtf8(key->example.data(), static_cast<int>(key->example.size()));
    }
    if (!value.isEmpty())
      lines += QString::fromUtf8(key->name().data(), static_cast<int>(key->name().size())) + " = " + value + "\n";
  }
  return lines;
}

}  // namespace breccia::gui
