#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "output/folder/run_folder.hpp"
#include "output/sink.hpp"
#include "run_folder/history.hpp"

namespace breccia::report {

using run_folder::History;

/// A line of status.jsonl with the progress of the run.
struct StatusPoint {
  double wall = 0;  ///< s, since the start or the resumption
  double time = 0;  ///< s, simulated
  double imbalance = 1;
};

/// Data of a run's files, whether it is complete, in progress or was killed.
struct RunRecord {
  std::filesystem::path folder;
  std::string title;
  std::string state;    ///< "complete", "running", "paused", "stopped", "failed", "interrupted", or "unknown"
  std::string message;  ///< with the state
  double end = 0;       ///< s, simulated: where the case ends; 0: unknown
  Provenance provenance;
  std::string case_text;  ///< resolved
  std::vector<case_::Material> materials;
  std::vector<case_::Joint> joints;
  std::vector<case_::Contact> contacts;
  char up = 'z';                    ///< axis against gravity, or of the fastest initial motion
  std::vector<std::string> bodies;  ///< their names by their numbers; empty in runs of before
  History history;
  std::vector<StatusPoint> status;
  std::vector<RunEvent> events;
  std::map<std::string, double> numbers;               ///< of summary.json, nested ones as "checkpoints.bytes"
  std::map<std::string, std::string> words;            ///< of summary.json
  std::vector<std::pair<std::string, double>> phases;  ///< s
  std::vector<std::string> flaws;                      ///< files that are missing or not whole

  /// "body 12" where there is no name; empty for what is no number of a body.
  [[nodiscard]] std::string body_name(double number) const;
  /// What a gauge is called: one that is named by a body's number, "body 3", by the body's name as well.
  [[nodiscard]] std::string gauge_label(const std::string& gauge) const;
  /// NaN if the summary lacks it.
  [[nodiscard]] double number(const std::string& name) const;
};

/// Reads the existing files; incomplete lines and files are skipped and reported in `flaws`.
/// Throws OutputError for a folder that is no run of breccia's (no provenance.json and no history.csv), or one that
/// cannot be read.
[[nodiscard]] RunRecord read_run(const std::filesystem::path& folder);

}  // namespace breccia::report
