#include "core/value_text.hpp"

#include <QMap>
#include <QRegularExpression>

#include "case/units.hpp"
#include "case/writer.hpp"
#include "core/toml_places.hpp"

namespace breccia::gui {
namespace {

using case_::Key;
using case_::ValueType;

/// A scalar in quotes without them; anything else as it is.
QString unquoted(const QString& toml) {
  if (toml.size() < 2 || toml.front() != toml.back() || toml.contains('\\')) return toml;
  const bool quoted = toml.front() == '"' || toml.front() == '\'';
  const QString inner = toml.mid(1, toml.size() - 2);
  return quoted && !inner.contains('"') && !inner.startsWith('\'') ? inner : toml;
}

bool is_number(const QString& text) {
  static const QRegularExpression number(R"(^[+-]?(0|[1-9][0-9_]*)(\.[0-9_]+)?([eE][+-]?[0-9_]+)?$)");
  return number.match(text).hasMatch();
}

/// "3.5 mm" of "3,5 mm": a decimal comma.
QString with_point(QString text) {
  static const QRegularExpression comma(R"(^([+-]?[0-9]+),([0-9]+))");
  return text.replace(comma, "\\1.\\2");
}

/// A quantity as TOML: a bare number, or text with its unit.
QString quantity(const QString& typed) {
  const QString text = typed.trimmed();
  if (text.isEmpty() || is_number(text) || text.startsWith('"') || text.startsWith('\'') || text.startsWith('{'))
    return text;
  const QString number = with_point(text);
  return is_number(number) ? number : quoted(number);
}

bool is_angle(const Key& key) { return key.type == ValueType::number && key.unit == "rad"; }

bool is_zero(const QString& number) { return number.toDouble() == 0; }

bool is_list(ValueType type) {
  using enum ValueType;
  switch (type) {
    case text_or_list:
    case text_list:
    case text_pair:
    case number_pair:
    case vector:
    case vector_or_number:
    case integers_or_one:
    case function_vector:
      return true;
    default:
      return false;
  }
}

bool is_text(ValueType type) {
  using enum ValueType;
  return type == text || type == text_or_list || type == path || type == choice || type == axes || type == text_list ||
         type == text_pair;
}

/// Whether a list of one is written without brackets.
bool takes_one(ValueType type) {
  using enum ValueType;
  return type == text_or_list || type == vector_or_number || type == integers_or_one;
}

}  // namespace

QString quoted(const QString& text) { return QString::fromStdString(case_::toml_text(text.toStdString())); }

QString shown_value(const Key& key, const QString& toml) {
  if (toml.startsWith('[') && is_list(key.type)) {
    const TomlPlaces places("v = " + toml.toStdString());
    QStringList items;
    for (const Place& place : places.all()) {
      if (place.path == "v") continue;
      const std::string_view item = places.value(place.path);
      if (item.starts_with('[') || item.starts_with('{') || item.find('#') != std::string_view::npos) return toml;
      const QString shown = unquoted(text_of(item));
      if (shown.contains(',') || shown.isEmpty()) return toml;
      items << shown;
    }
    return items.join(", ");
  }
  // A comma would split it in two when it is committed.
  if (key.type == ValueType::text_or_list && toml.contains(',')) return toml;
  // People count angles in degrees, the text in radians where it names no unit.
  return is_angle(key) && is_number(toml) && !is_zero(toml) ? toml + " rad" : unquoted(toml);
}

QStringList names_in(const QString& toml) {
  if (!toml.startsWith('[')) return toml.isEmpty() ? QStringList() : QStringList(unquoted(toml));
  QStringList names;
  const TomlPlaces places("v = " + toml.toStdString());
  for (const Place& place : places.all())
    if (place.path != "v") names << unquoted(text_of(places.value(place.path)));
  names.removeAll(QString());
  return names;
}

QString typed_value(const Key& key, const QString& typed) {
  const QString text = typed.trimmed();
  if (text.isEmpty() || text.startsWith('"') || text.startsWith('\'') || text.startsWith('[') || text.startsWith('{'))
    return text;
  if (key.type == ValueType::boolean) return text;
  if (key.type == ValueType::integer || key.type == ValueType::column) return is_number(text) ? text : quoted(text);
  if (is_angle(key) && is_number(text) && !is_zero(text)) return quoted(text + " deg");
  if (!is_list(key.type)) return is_text(key.type) ? quoted(text) : quantity(text);
  const auto written = [&](const QString& item) { return is_text(key.type) ? quoted(item.trimmed()) : quantity(item); };
  const QStringList items = text.split(',');
  if (takes_one(key.type) && items.size() == 1) return written(text);
  QStringList out;
  for (const QString& item : items) out << written(item);
  return "[" + out.join(", ") + "]";
}

std::optional<double> number_of(const QString& typed, const char* unit, QString* error) {
  try {
    return case_::to_si(with_point(typed.trimmed()).toStdString(), unit);
  } catch (const case_::UnitError& wrong) {
    *error = QString("%1; %2").arg(QString::fromUtf8(wrong.what()), QString::fromStdString(wrong.allowed));
    return std::nullopt;
  }
}

QString shown_unit(const QString& unit) {
  static const QRegularExpression power("(?<=[A-Za-z])([23])");
  QString shown = unit == "rad" ? QString("deg") : QString(unit).replace("/s/s", "/s2");  // growth of a velocity
  for (auto match = power.match(shown); match.hasMatch(); match = power.match(shown))
    shown.replace(match.capturedStart(), 1, match.captured(1) == "2" ? "²" : "³");
  return shown;
}

QString counted(double number, const QString& one, const QString& many) {
  return QString("%1 %2").arg(number, 0, 'f', 0).arg(number == 1 ? one : many);
}

QString shown_default(const Key& key) {
  const QString fallback = text_of(key.fallback);
  if (fallback.startsWith('=')) return QObject::tr("that of %1").arg(fallback.mid(1).trimmed());
  return shown_value(key, fallback);
}

QString label_of(const Key& key) {
  QString name = text_of(key.name()).replace('_', ' ');
  if (!name.isEmpty()) name[0] = name[0].toUpper();
  return name;
}

QString symbol_of(const Key& key) {
  static const QMap<QString, QString> symbols{{"material[].young", "E"},
                                              {"material[].poisson", "ν"},
                                              {"material[].density", "ρ"},
                                              {"material[].viscosity", "μ"},
                                              {"material[].friction_angle", "φ"},
                                              {"material[].dilation_angle", "ψ"},
                                              {"material[].cohesion", "c"},
                                              {"joint[].penalty", "p"},
                                              {"joint[].penalty_factor", "p/E"},
                                              {"joint[].size", "h"},
                                              {"joint[].tensile_strength", "f_t"},
                                              {"joint[].shear_strength", "f_s"},
                                              {"joint[].friction", "tan φ"},
                                              {"joint[].friction_angle", "φ"},
                                              {"joint[].energy_mode_1", "G_I"},
                                              {"joint[].energy_mode_2", "G_II"},
                                              {"joint[].weibull_modulus", "m"},
                                              {"joint[].weibull_area", "A_0"},
                                              {"contact[].penalty", "p"},
                                              {"contact[].penalty_factor", "p/E"},
                                              {"contact[].plateau", "σ_T"},
                                              {"contact[].unloading_exponent", "b"},
                                              {"contact[].friction", "μ"},
                                              {"initial_velocity[].velocity", "v"},
                                              {"initial_velocity[].angular", "ω"},
                                              {"initial_velocity[].strain_rate", "dε/dt"},
                                              {"stage[].gravity", "g"},
                                              {"stage[].mass_damping", "α"},
                                              {"time.step", "Δt"}};
  return symbols.value(text_of(key.path));
}

QString tooltip_of(const Key& key) {
  const auto line = [](const QString& name, const QString& text) {
    return text.isEmpty() ? QString() : QString("<br><i>%1</i> %2").arg(name, text.toHtmlEscaped());
  };
  const QString unit = key.unit == "1" ? QObject::tr("none")
                       : is_angle(key) ? QObject::tr("deg; rad is typed behind the number")
                                       : shown_unit(text_of(key.unit));
  const QString fallback = key.required ? QObject::tr("none, must be given") : shown_default(key);
  return "<b>" + text_of(case_::plain_path(key.path)) + "</b><br>" + text_of(key.help).toHtmlEscaped() +
         line(QObject::tr("Symbol:"), symbol_of(key)) + line(QObject::tr("Unit:"), unit) +
         line(QObject::tr("Allowed:"), QString::fromStdString(case_::allowed_text(key))) +
         line(QObject::tr("Default:"), fallback.isEmpty() ? QObject::tr("none") : fallback) +
         line(QObject::tr("Example:"), shown_value(key, text_of(key.example)));
}

std::vector<const Key*> keys_in(const std::string& section) {
  std::vector<const Key*> found;
  for (const Key& key : case_::schema())
    if (!key.is_section() && key.section() == section) found.push_back(&key);
  return found;
}

}  // namespace breccia::gui
