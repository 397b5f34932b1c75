#pragma once

#include <QString>
#include <vector>

#include "core/document.hpp"

namespace breccia::gui {

/// One value of a material: a key of material[] or, with `joint.` before it, of joint[].
struct MaterialValue {
  QString key;     ///< "young", "joint.tensile_strength"
  QString toml;    ///< as it stands in a case
  QString source;  ///< where it was published; "assumed: ..." or "derived: ..." where it was not
};

/// A material of the library.
struct LibraryMaterial {
  QString name, kind, note;
  bool own = false;  ///< of the user's library
  std::vector<MaterialValue> values;
  /// TOML text of a key; empty: not known.
  [[nodiscard]] QString value(const QString& key) const;
};

/// Materials of a library's text: [[material]] with name, kind and note, keys, their sources below `source`, and what
/// concerns joints below `joint`.
[[nodiscard]] std::vector<LibraryMaterial> read_materials(const QByteArray& toml);
/// Those that come with the program.
[[nodiscard]] std::vector<LibraryMaterial> shipped_materials();

/// The user's own, in a file of the state folder.
class UserLibrary {
 public:
  explicit UserLibrary(QString file) : file_(std::move(file)) {}
  [[nodiscard]] std::vector<LibraryMaterial> load() const;
  /// Adds one, or takes the place of one of that name. Returns what went wrong, empty: nothing.
  [[nodiscard]] QString add(const LibraryMaterial& material) const;
  [[nodiscard]] QString remove(const QString& name) const;

 private:
  /// Why the file must not be written anew: it is not, or not all, what was read. Empty: it may.
  [[nodiscard]] QString trouble() const;
  [[nodiscard]] QString save(const std::vector<LibraryMaterial>& list) const;
  QString file_;
};

/// The values of a material of the case, and of the joints of its group.
/// @param path  "material[0]"
[[nodiscard]] LibraryMaterial material_of(const Document& document, const QString& path, const QString& name);

/// Puts the values into material `path` and into the joints of its group, as one undoable step. Without such joints
/// theirs are left out.
void take_material(Document& document, const QString& path, const LibraryMaterial& material);

}  // namespace breccia::gui
