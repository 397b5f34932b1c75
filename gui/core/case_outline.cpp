#include "core/case_outline.hpp"

#include <QCoreApplication>

#include "case/schema.hpp"
#include "core/value_text.hpp"

namespace breccia::gui {
namespace {

QString stage_text(const char* words) { return QCoreApplication::translate("stages", words); }

QString plain(const std::string& name) { return QString::fromStdString(name).replace('_', ' '); }

/// Distinguishes an entry from its neighbours: its name, group, surface or pair.
QString title_of(const std::string& path, const TomlPlaces& places) {
  for (const char* key : {"name", "group", "surface", "between"}) {
    const std::string own = path + "." + key;
    const case_::Key* row = case_::find_key(case_::pattern_of(own));
    const std::string_view value = places.value(own);
    if (row != nullptr && !value.empty())
      return shown_value(*row, QString::fromUtf8(value.data(), static_cast<int>(value.size())));
  }
  return {};
}

/// Every path that fits a pattern: "stage[].constraint[]" -> stage[0].constraint[0], ...
std::vector<std::string> paths_of(const std::string& pattern, const TomlPlaces& places) {
  std::vector<std::string> found{""};
  for (std::size_t at = 0; at <= pattern.size();) {
    const std::size_t end = std::min(pattern.find('.', at), pattern.size());
    std::string part = pattern.substr(at, end - at);
    const bool list = part.ends_with("[]");
    if (list) part.resize(part.size() - 2);
    std::vector<std::string> next;
    for (const std::string& path : found) {
      const std::string own = path.empty() ? part : path + "." + part;
      if (!list) {
        next.push_back(own);
      } else {
        for (int i = 0; i < places.count(own); ++i) next.push_back(own + "[" + std::to_string(i) + "]");
      }
    }
    found = std::move(next);
    at = end + 1;
  }
  return found;
}

}  // namespace

const std::vector<WorkStage>& work_stages() {
  using Kind = WorkStage::Kind;
  static const std::vector<WorkStage> stages{
      {stage_text("Geometry and mesh"),
       Kind::sections,
       {"", "start", "mesh", "mesh.raster", "mesh.raster.slit", "plane"}},
      {stage_text("Materials"), Kind::sections, {"material[]"}},
      {stage_text("Joints"), Kind::sections, {"joint[]", "joint[].softening", "joints"}},
      {stage_text("Contacts"), Kind::sections, {"contact[]", "contact_points", "sphere", "detection"}},
      {stage_text("Loads and constraints"),
       Kind::sections,
       {"initial_velocity[]", "stage[]", "stage[].constraint[]", "stage[].pressure[]", "stage[].traction[]",
        "stage[].force[]"}},
      {stage_text("Time"), Kind::sections, {"time"}},
      {stage_text("Domains"), Kind::sections, {"domains"}},
      {stage_text("Output and in situ"),
       Kind::sections,
       {"output", "gauge[]", "trigger[]", "checkpoint", "insitu", "insitu.live", "insitu.live.region",
        "insitu.pipeline[]", "insitu.pipeline[].region", "insitu.pipeline[].probe[]"}},
      {stage_text("Run"), Kind::run, {}},
      {stage_text("Results"), Kind::results, {}}};
  return stages;
}

std::vector<OutlineRow> outline(const WorkStage& stage, const TomlPlaces& places) {
  std::vector<OutlineRow> rows;
  for (const std::string& section : stage.sections) {
    if (section.find("[].") != std::string::npos) continue;  // stands below its entry
    for (const std::string& path : paths_of(section, places)) {
      const auto add = [&](const std::string& own, int depth) {
        const bool entry = own.ends_with(']');
        const std::string name = own.substr(own.rfind('.') == std::string::npos ? 0 : own.rfind('.') + 1);
        const QString title = title_of(own, places), kind = plain(name.substr(0, name.find('[')));
        const bool present = own.empty() || places.find(own) != nullptr || !places.names_below(own).empty();
        const QString label = own.empty() ? stage_text("title") : title.isEmpty() ? kind : kind + ": " + title;
        rows.push_back({QString::fromStdString(own), label, depth, present,
                        entry || (present && !own.empty() && places.find(own) != nullptr)});
      };
      add(path, 0);
      for (const std::string& inner : stage.sections)
        if (inner.size() > section.size() && inner.starts_with(section + ".") && section.ends_with("[]"))
          for (const std::string& below : paths_of(inner, places))
            if (below.starts_with(path + ".")) add(below, 1);
    }
  }
  return rows;
}

std::vector<QString> lists_of(const WorkStage& stage, const TomlPlaces& places) {
  std::vector<QString> lists;
  for (const std::string& section : stage.sections) {
    if (!section.ends_with("[]")) continue;
    const std::string name = leaf_of(section);
    const std::string parent = parent_of(section);
    const std::string list = name.substr(0, name.size() - 2);
    if (parent.empty()) {
      lists.push_back(QString::fromStdString(list));
    } else {
      for (const std::string& path : paths_of(parent, places))
        lists.push_back(QString::fromStdString(path + "." + list));
    }
  }
  return lists;
}

QString words_of(const QString& path, const TomlPlaces& places) {
  const auto end = path.lastIndexOf(']') + 1;  // of the entry
  const QString entry = path.left(end), rest = plain(path.mid(end).toStdString()).replace('.', ' ').trimmed();
  if (entry.isEmpty()) return rest;
  const QString title = title_of(entry.toStdString(), places);
  QString words = plain(leaf_of(entry.toStdString()));
  words = words.left(words.indexOf('[')) + (title.isEmpty() ? QString() : ": " + title);
  return rest.isEmpty() ? words : QCoreApplication::translate("stages", "%1 of %2").arg(rest, words);
}

QString numbered_words(const QString& path) {
  QStringList words;
  for (const QString& part : path.split('.')) {
    const QString name = plain(part.section('[', 0, 0).toStdString()), index = part.section('[', 1).remove(']');
    words << (index.isEmpty() ? name : QString("%1 %2").arg(name).arg(index.toInt() + 1));
  }
  return words.join(", ");
}

int stage_of(const std::string& path) {
  const std::string pattern = case_::pattern_of(path);
  int best = 0;
  std::size_t length = 0;
  const std::vector<WorkStage>& stages = work_stages();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    for (const std::string& section : stages[i].sections) {
      const bool inside = pattern == section || pattern.starts_with(section + ".") ||
                          (section.ends_with("[]") && pattern == section.substr(0, section.size() - 2));
      if (!section.empty() && inside && section.size() >= length) {
        best = static_cast<int>(i);
        length = section.size();
      }
    }
  }
  return best;
}

}  // namespace breccia::gui
