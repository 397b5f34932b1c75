#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "advice/advice.hpp"
#include "case/case.hpp"
#include "commands/step_report.hpp"
#include "mesh/finish.hpp"
#include "mesh/quality.hpp"
#include "model/model.hpp"
#include "parallel/domain_report.hpp"

namespace breccia {

/// Box, bodies, groups, repairs and quality of a mesh, for a terminal.
[[nodiscard]] std::string mesh_report(const FinishedMesh& made, const QualityReport& quality);

/// How a model is divided among ranks.
struct Division {
  std::string how;  ///< "rcb", "grid of 2 x 2 x 1"
  DomainReport report;
  std::vector<int> owner;  ///< (elements) rank
};

/// @param model  at least bare.  Throws as assign_domains.
[[nodiscard]] Division divide_model(const case_::Case& input, const Model& model, int parts);

/// What a run is likely to take here, from a few steps of a scratch copy.
struct RunEstimate {
  double steps = 0;
  double seconds = 0;         ///< s, of one rank on this machine while little breaks
  double likely_seconds = 0;  ///< s, of a run in which much breaks: the mean of these two, since damage grows over the
                              ///< run; measured times of runs are 0.8 to 1.4 of it
  /// s, if all joints that can break had done so, and bodies had met, from the start; contact among the debris is not
  /// in it: a column that collapsed into a heap took 4 times as long
  double most_seconds = 0;
  bool breaks = false;       ///< there are joints that can break
  bool meets = false;        ///< there are none, and bodies that come to meet make the step shorter
  std::uint64_t memory = 0;  ///< bytes, largest so far of this process
  FramesEstimate frames;
};

[[nodiscard]] RunEstimate estimate_run(const Subject& subject, const StepReport& step);

/// How a run on `parts` ranks divides the model: elements, joints, proxies, messages and bytes a step by domain, or the
/// least, mean and most and the slowest three of many; imbalance and predicted efficiency.
/// @param model  at least bare.  Throws as assign_domains.
[[nodiscard]] std::string domain_table(const case_::Case& input, const Model& model, int parts);

/// The same in one line.
[[nodiscard]] std::string domain_line(const case_::Case& input, const Model& model, int parts);

/// Everything that can be reported before the first step.
struct CheckReport {
  /// Lines: size, stable step and what limits it, steps, memory, run time on this machine (from a few steps of a
  /// scratch copy), joints against the fracture process zone, softness added by the joints.
  std::string text;
  std::vector<Advice> advice;
  StepReport step;
  RunEstimate estimate;
};

/// @param subject  its model is not a bare one; that before the first step of all runs, also for a case with [start]
/// @param from     "step 1200 at 2.4 s of FILE" of such a case; empty: it starts at rest
[[nodiscard]] CheckReport full_report(const Subject& subject, const std::string& from = {});

/// A line for each, at most so many and how many there are more.
[[nodiscard]] std::string advice_list(const std::vector<Advice>& advice, std::size_t most);

}  // namespace breccia
