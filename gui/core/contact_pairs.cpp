#include "core/contact_pairs.hpp"

#include "core/case_outline.hpp"
#include "core/value_text.hpp"

namespace breccia::gui {

QStringList groups_of(const Document& document) {
  QStringList groups;
  for (int i = 0; i < document.places().count("material"); ++i)
    groups += names_in(document.value(QString("material[%1].group").arg(i)));
  groups.removeAll(QString());
  groups.removeDuplicates();
  return groups;
}

QString material_entry_of(const Document& document, const QString& group) {
  QString of_any;
  for (int i = 0; i < document.places().count("material"); ++i) {
    const QString path = QString("material[%1]").arg(i);
    const QStringList names = names_in(document.value(path + ".group"));
    if (names.contains(group)) return path;
    if (names == QStringList("*")) of_any = path;
  }
  return of_any;
}

QString contact_of(const Document& document, const QString& a, const QString& b, bool* own) {
  const auto fits = [](const QString& pattern, const QString& name) { return pattern == "*" || pattern == name; };
  QString found;
  int most = -1;
  for (int i = 0; i < document.places().count("contact"); ++i) {
    const QString path = QString("contact[%1]").arg(i);
    const QStringList pair = names_in(document.value(path + ".between"));
    if (pair.size() != 2) continue;
    const int names = (pair[0] != "*" ? 1 : 0) + (pair[1] != "*" ? 1 : 0);
    const bool named = (fits(pair[0], a) && fits(pair[1], b)) || (fits(pair[1], a) && fits(pair[0], b));
    if (!named || names < most) continue;
    most = names;
    found = path;
  }
  *own = most == 2;
  return found;
}

QString give_own_contact(Document& document, const QString& a, const QString& b) {
  bool own = false;
  const QString now = contact_of(document, a, b, &own);
  if (own) return now;
  QString lines = "between = [" + quoted(a) + ", " + quoted(b) + "]\n";
  if (!now.isEmpty())
    for (const std::string& key : document.places().names_below(now.toStdString()))
      if (key != "between")
        lines += QString::fromStdString(key) + " = " + document.value(now + "." + QString::fromStdString(key)) + "\n";
  document.add_entry("contact", lines);
  return contact_of(document, a, b, &own);
}

}  // namespace breccia::gui
