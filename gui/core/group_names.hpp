#pragma once

#include <QString>
#include <QStringList>
#include <optional>

#include "case/schema.hpp"
#include "core/document.hpp"

namespace breccia::gui {

/// Which groups of the mesh a value of the case may name.
enum class GroupKind { none, volume, surface, any };
[[nodiscard]] GroupKind group_kind(const case_::Key& key);
/// Whether a value may name several, as a list.
[[nodiscard]] bool names_many_groups(const case_::Key& key);

/// A list of groups, as it is shown in its field, with one more; one that it has already leaves it as it is.
[[nodiscard]] QString with_group(const QString& shown, const QString& group);

/// Groups of that kind; while the mesh is not known, volumes are those with a material.
[[nodiscard]] QStringList groups_of_kind(GroupKind kind, const TomlPlaces& places,
                                         const std::optional<MeshGroups>& mesh);

/// Lines of a new entry of a list: the first group that has no such entry, and names. Physical values are left out,
/// since an invented one would be taken for one that was meant.
[[nodiscard]] QString lines_of_new_entry(const QString& list, const TomlPlaces& places,
                                         const std::optional<MeshGroups>& mesh);

}  // namespace breccia::gui
