#pragma once

#include <QString>
#include <QStringList>
#include <vector>

#include "core/solver_run.hpp"

namespace breccia::gui {

/// A shipped case to begin with.
struct Template {
  QString title, text;
  QString case_file;  ///< absolute
  QString picture;    ///< absolute; empty: none
};

/// Places of program and files on this machine. The environment may override them: BRECCIA_PROGRAM, BRECCIA_MESHES,
/// BRECCIA_PROJECTS, BRECCIA_STATE.
struct Places {
  Launch launch;
  QString desktop;   ///< this program, which works the queue of runs as well
  QString meshes;    ///< folder of the shipped cases
  QString projects;  ///< new cases go below it
  QString state;     ///< snapshots, runs, recent cases

  [[nodiscard]] static Places of_this_machine();
};

/// Those whose case file is there.
[[nodiscard]] std::vector<Template> templates(const Places& places);

/// Copies a case with the meshes beside it into a new folder below the projects. Returns the new case file.
/// @param error  out: what went wrong; then the result is empty
[[nodiscard]] QString copy_template(const Template& chosen, const Places& places, QString* error);

/// Recent cases, newest first; those that are no more are left out.
[[nodiscard]] QStringList recent_cases(const Places& places);
/// Returns what went wrong, empty: nothing.
[[nodiscard]] QString remember_case(const Places& places, const QString& file);

}  // namespace breccia::gui
