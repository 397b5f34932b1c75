#pragma once

#include <QString>
#include <QStringList>
#include <optional>
#include <string_view>

#include "case/schema.hpp"

namespace breccia::gui {

/// A text of the table of keys (case/schema.hpp) as one of Qt's.
[[nodiscard]] inline QString text_of(std::string_view s) {
  return QString::fromUtf8(s.data(), static_cast<int>(s.size()));
}

/// A value as people write it in a field, of its TOML text: "75 GPa" for "\"75 GPa\"", "0, -3 m/s, 0" for a list of
/// quantities, "0.6 rad" for a bare angle. Tables, functions and lists of lists stay TOML.
[[nodiscard]] QString shown_value(const case_::Key& key, const QString& toml);

/// The names in the TOML text of a text or of a list of texts.
[[nodiscard]] QStringList names_in(const QString& toml);

/// TOML text of what was typed into the field of a key; empty: the key is taken out. A text that is TOML already
/// (begins with a quote or a bracket) is taken as it is.
[[nodiscard]] QString typed_value(const case_::Key& key, const QString& typed);

/// A quantity as people type it, in SI. None: it is not one of that dimension. @param error  out: the solver's words
[[nodiscard]] std::optional<double> number_of(const QString& typed, const char* unit, QString* error);

/// A unit as people read it: "kg/m³", and degrees for "rad", in which angles are shown and a bare number is typed.
[[nodiscard]] QString shown_unit(const QString& unit);

/// "1 element", "12 elements".
[[nodiscard]] QString counted(double number, const QString& one, const QString& many);

/// Default of a key as it is shown, empty when there is none.
[[nodiscard]] QString shown_default(const case_::Key& key);

/// "Tensile strength" of joint[].tensile_strength.
[[nodiscard]] QString label_of(const case_::Key& key);
/// Symbol of the quantity in the method, if it has a usual one: "E".
[[nodiscard]] QString symbol_of(const case_::Key& key);
/// Path, meaning, symbol, unit, what is allowed, default and an example, as plain lines or as HTML.
[[nodiscard]] QString tooltip_of(const case_::Key& key);

/// Keys that stand directly in a section ("material[]", "stage[].constraint[]", "mesh"), in the order of the table.
[[nodiscard]] std::vector<const case_::Key*> keys_in(const std::string& section);

/// A text in TOML's quotes.
[[nodiscard]] QString quoted(const QString& text);

}  // namespace breccia::gui
