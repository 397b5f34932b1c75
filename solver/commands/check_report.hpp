#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "commands/step_report.hpp"
#include "mesh/finish.hpp"
#include "model/model.hpp"
#include "parallel/domain_report.hpp"

namespace breccia {

/// Bodies, groups, repairs and quality of a mesh, for a terminal.
[[nodiscard]] std::string mesh_report(const FinishedMesh& made);

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
  double seconds = 0;        ///< s, of one rank on this machine while little breaks
  double most_seconds = 0;   ///< s, if all joints that can break had done so from the start
  bool breaks = false;       ///< there are joints that can break
  std::uint64_t memory = 0;  ///< bytes, largest so far of this process
};

/// Frames of a run and the room they take, bytes, while nothing has broken.
struct FramesEstimate {
  double frames = 0, bytes = 0;
};

[[nodiscard]] FramesEstimate estimate_frames(const case_::Case& input, const Model& model);

[[nodiscard]] RunEstimate estimate_run(const case_::Case& input, const Model& model, const StepReport& step);

/// How a run on `parts` ranks divides the model: elements, joints, proxies, messages and bytes a step by domain, or the
/// least, mean and most and the slowest three of many; imbalance and predicted efficiency.
/// @param model  at least bare.  Throws as assign_domains.
[[nodiscard]] std::string domain_table(const case_::Case& input, const Model& model, int parts);

/// The same in one line.
[[nodiscard]] std::string domain_line(const case_::Case& input, const Model& model, int parts);

/// Everything that can be told before the first step: size, stable step and what limits it, steps, memory, run time on
/// this machine (from a few steps of a scratch copy), joints against the fracture process zone, softness added by the
/// joints, and advice as sentences with their remedy.
[[nodiscard]] std::string check_report(const case_::Case& input, const Model& model);

/// The parts of that report.
struct CheckReport {
  std::string text, advice;  ///< lines; each advice begins with "- "
  StepReport step;
  RunEstimate estimate;
};

[[nodiscard]] CheckReport full_report(const case_::Case& input, const Model& model);

}  // namespace breccia
