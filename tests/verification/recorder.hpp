#pragma once

#include <string>
#include <vector>

#include "output/frames/frame.hpp"

namespace breccia::test {

/// What a run told: all lines of its history, all frames and its summary.
struct Recording {
  std::vector<HistoryRow> rows;
  std::vector<Frame> frames;
  Summary summary;

  /// Largest relative energy residual of all lines; NaN where one is.
  [[nodiscard]] double worst_residual() const;
};

/// Runs a case of meshes/. @param file  "bar_wave/case.toml";  @param overrides  key=value
Recording run_case_file(const std::string& file, const std::vector<std::string>& overrides = {});

/// Runs a case given as text.
Recording run_case_text(const std::string& text);

}  // namespace breccia::test
