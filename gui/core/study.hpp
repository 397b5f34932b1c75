#pragma once

#include <optional>
#include <vector>

#include "core/document.hpp"
#include "core/plot_line.hpp"
#include "core/run_queue.hpp"

/// A run matrix: the same case with every combination of the values of one or two of its keys.
namespace breccia::gui {

struct StudyParameter {
  QString key;         ///< path in the case, as `--set` takes it ("material[0].young", "mesh.parameters.h"), or "ranks"
  QStringList values;  ///< as typed: "70 GPa"
  /// "young" of material[0].young.
  [[nodiscard]] QString name() const { return key.section('.', -1); }
};

struct StudyRun {
  QString folder;
  QStringList values;  ///< of the parameters, in their order
};

struct Study {
  QString folder;  ///< of all its runs; study.json is there
  QString case_file;
  int ranks = 1;  ///< where they are no parameter
  std::vector<StudyParameter> parameters;
  std::vector<StudyRun> runs;
};

constexpr int kMostStudyRuns = 400;

/// Values as people type them: "70 GPa; 75 GPa". A list of numbers such as a vector has commas of its own.
[[nodiscard]] QStringList study_values(const QString& typed);

/// What may be a parameter: ranks, the values of the case, the numbers of its geometry.
[[nodiscard]] QStringList study_keys(const Document& document);

/// Every combination, the last parameter changes fastest.
/// @param problems  out: what the solver's reader refuses, with the run's values, and each problem once; then there are
///                  no wishes
[[nodiscard]] std::vector<RunWish> plan_study(const Document& document, Study& study, QStringList* problems);

/// study.json. Returns what went wrong, empty: nothing.
[[nodiscard]] QString save_study(const Study& study);
[[nodiscard]] std::optional<Study> load_study(const QString& folder);
/// Folders of the studies of a case in a folder of runs, latest first.
[[nodiscard]] QStringList find_studies(const QString& runs_folder, const QString& case_file);

/// What a run of a study has come to.
struct StudyResult {
  QString state = "waiting";
  QStringList columns;         ///< "wall time [s]", "steps", then those of history.csv
  std::vector<double> values;  ///< at the end of the run or as far as it is; same length
  [[nodiscard]] std::optional<double> value(const QString& column) const;
};

/// @param queue  for those that wait or run
[[nodiscard]] std::vector<StudyResult> study_results(const Study& study, const QueueContents& queue);

/// A column over the first parameter, a line for each value of the second one.
struct StudyPlot {
  std::vector<PlotLine> lines;
  QString x_title;
  QStringList x_words;  ///< where the first parameter has words: what stands at 0, 1, 2...
};
[[nodiscard]] StudyPlot study_plot(const Study& study, const std::vector<StudyResult>& results, const QString& column);

/// A row a run: parameters as typed and in SI, state, then every column that a run has.
[[nodiscard]] QByteArray study_csv(const Study& study, const std::vector<StudyResult>& results);

/// A value in SI; nothing: it is a word.
[[nodiscard]] std::optional<double> number_of(const QString& typed);

}  // namespace breccia::gui
