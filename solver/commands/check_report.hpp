#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "commands/advice.hpp"
#include "commands/step_report.hpp"
#include "mesh/finish.hpp"
#include "mesh/quality.hpp"
#include "model/model.hpp"
#include "parallel/domain_report.hpp"

namespace breccia {

/// Lowest and highest coordinates of a mesh, m. @pre it has nodes
[[nodiscard]] std::array<Vec3, 2> box_of(const Mesh& mesh);

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
  double frames = 0;         ///< number
  double disk = 0;           ///< bytes of the frames, compressed, as long as few joints break
};

/// The state that a case with [start] goes on from; the model of a report is that before the first step of all runs.
struct StartedFrom {
  double time = 0;    ///< s
  std::string words;  ///< "step 1200 at 2.4 s of FILE"; empty: the case starts at rest
};

[[nodiscard]] RunEstimate estimate_run(const case_::Case& input, const Model& model, const StepReport& step,
                                       double start = 0);

/// How a run on `parts` ranks divides the model: elements, joints, proxies, messages and bytes a step by domain, or the
/// least, mean and most and the slowest three of many; imbalance and predicted efficiency.
/// @param model  at least bare.  Throws as assign_domains.
[[nodiscard]] std::string domain_table(const case_::Case& input, const Model& model, int parts);

/// The same in one line.
[[nodiscard]] std::string domain_line(const case_::Case& input, const Model& model, int parts);

/// Everything that can be told before the first step: size, stable step and what limits it, steps, memory, run time on
/// this machine (from a few steps of a scratch copy), joints against the fracture process zone, softness added by the
/// joints, and advice.
[[nodiscard]] std::string check_report(const case_::Case& input, const Model& model, const StartedFrom& from = {});

/// The parts of that report.
struct CheckReport {
  std::string text;  ///< lines
  Advice advice;
  StepReport step;
  RunEstimate estimate;
};

[[nodiscard]] CheckReport full_report(const case_::Case& input, const Model& model, const StartedFrom& from = {});

}  // namespace breccia
