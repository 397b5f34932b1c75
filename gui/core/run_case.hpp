#pragma once

#include <QByteArray>
#include <QString>

#include "core/solver_run.hpp"

/// Which case a run is of.
namespace breccia::gui {

/// The case that a run was started from, by what was noted when it was started, by its study, by its provenance, or by
/// its name and place; the copy in its folder where that case is no more; empty: there is none that can be read.
[[nodiscard]] QString case_of_run(const RunRecord& record);

/// Whether a run is one of a case, which may have been edited since.
/// @param text  of the case as it is edited
[[nodiscard]] bool is_run_of(const RunRecord& record, const QString& case_file, const QByteArray& text);

/// Whether a run was started from that case file here, or has a copy of that text.
[[nodiscard]] bool is_run_with(const RunRecord& record, const QString& case_file, const QByteArray& text);

/// False for a run whose frames have no elements.
[[nodiscard]] bool writes_elements(const QString& run_folder);

}  // namespace breccia::gui
