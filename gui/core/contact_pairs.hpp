#pragma once

#include <QString>
#include <QStringList>

#include "core/document.hpp"

namespace breccia::gui {

/// Volume groups that the case names in its materials.
[[nodiscard]] QStringList groups_of(const Document& document);

/// The [[material]] of a volume group, else the one of "*": "material[1]"; empty: it has none.
[[nodiscard]] QString material_entry_of(const Document& document, const QString& group);

/// The [[contact]] that holds for two groups: "contact[1]"; empty: they do not touch. "*" fits every group; of several
/// that fit the one that names more of them wins, of these the later one.
/// @param own  out: it names both
[[nodiscard]] QString contact_of(const Document& document, const QString& a, const QString& b, bool* own);

/// Gives a pair an entry of its own with the values of the one that holds for it now, or with the examples of the table
/// of keys. One undoable step. Returns its path.
QString give_own_contact(Document& document, const QString& a, const QString& b);

}  // namespace breccia::gui
