#pragma once

#include <QString>
#include <vector>

#include "core/document.hpp"

namespace breccia::gui {

/// A stage of the work and the sections of the case that belong to it, as patterns of the table of keys.
struct WorkStage {
  enum class Kind { sections, run, results };
  QString name;
  Kind kind = Kind::sections;
  std::vector<std::string> sections;
};

/// In the order of the work. Every section of the table of keys is in one of them.
[[nodiscard]] const std::vector<WorkStage>& work_stages();

/// One line of the outline of a case.
struct OutlineRow {
  QString path;   ///< "material[0]", "mesh.raster"; ""  the title
  QString label;  ///< "material: glass"
  int depth = 0;
  bool present = false;  ///< it stands in the text
  bool removable = false;
};

/// The sections of a stage that the case has, and those of one piece that it may have.
[[nodiscard]] std::vector<OutlineRow> outline(const WorkStage& stage, const TomlPlaces& places);

/// Lists to which an entry can be added in a stage: "material", "stage[0].constraint".
[[nodiscard]] std::vector<QString> lists_of(const WorkStage& stage, const TomlPlaces& places);

/// What a path names, for people: "softening c of joint: glass" for "joint[0].softening.c".
[[nodiscard]] QString words_of(const QString& path, const TomlPlaces& places);

/// Which entry a path is, by numbers: "stage 1, constraint 2" for "stage[0].constraint[1]".
[[nodiscard]] QString numbered_words(const QString& path);

/// The stage that a path belongs to.
[[nodiscard]] int stage_of(const std::string& path);

}  // namespace breccia::gui
