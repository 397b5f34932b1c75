#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "model/model.hpp"
#include "output/folder/race_progress.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Settings of a comparison of contact searches.
struct RaceSettings {
  std::vector<case_::DetectionAlgorithm> algorithms;  ///< empty: all, brute_force only where the model is small enough
  std::vector<double> buffers{0.5, 1, 2, 4};          ///< multiples of the case's own buffer, which is always compared
  double from = 0;                                    ///< s, simulated: where the race starts
  double time = 0;                                    ///< s, simulated: length of a repetition; 0: see steps
  std::int64_t steps = 0;                             ///< length of a repetition; 0 and no time: chosen (race_case)
};

/// One search algorithm with its settings.
struct SearchCandidate {
  case_::DetectionAlgorithm algorithm;
  double buffer = 0;  ///< m; 0: "auto"
  bool as_in_case = false;

  [[nodiscard]] std::string algorithm_text() const;  ///< "ms", as the case file names it
  [[nodiscard]] std::string buffer_text() const;     ///< "0.0005 m" or "auto", likewise
  /// "ms, buffer 0.0005 m"
  [[nodiscard]] std::string name() const { return algorithm_text() + ", buffer " + buffer_text(); }
};

/// Times of one repetition, s, those of the slowest rank. Each of up to a thousand segments has its shortest time over
/// all repetitions; on one rank all but search and contact is the same for all candidates, the shortest time of any.
struct Repetition {
  double wall = 0, contact = 0;
  double search = 0;          ///< with what fracture makes touch between searches
  double full_search = 0;     ///< of it, in steps with a search
  std::int64_t searches = 0;  ///< done: the first at the start of the repetition
  double used = 0;            ///< of these: the last one counts as far as nodes have used its buffer up
  std::int64_t couples = 0;   ///< of the whole model at the end

  [[nodiscard]] double one_search() const { return full_search / static_cast<double>(searches); }
  /// Wall time of as many steps in a long run, which pays only for the searches that it uses.
  [[nodiscard]] double lasting() const { return wall - (static_cast<double>(searches) - used) * one_search(); }
};

struct RaceEntry {
  SearchCandidate candidate;
  Repetition least;
};

struct RaceResult {
  std::string title, left_out;  ///< left_out: why an algorithm is left out; empty: none is
  std::int64_t elements = 0, steps = 0;
  int ranks = 1, rounds = 0;       ///< rounds that all candidates have finished
  double start = 0, end = 0;       ///< s, simulated
  std::vector<RaceEntry> entries;  ///< the fastest step first; none unless a round was finished
  std::string state_hash;          ///< in which every repetition has ended
  bool stopped = false;            ///< by request
};

/// Runs the case from the same state to the same step with every algorithm and buffer, and compares the times.
///
/// The case runs once to the start, and its state is kept. A repetition rebuilds the model from that state and steps
/// it, without output, budgets and detection.verify; the division among ranks is that at the start. The first
/// repetition, with the settings of the case, warms up caches, determines the automatic buffer, and is discarded. Then
/// each candidate runs three times, in alternating order, so that none is always first. Without a length in the
/// settings a repetition has ten searches of the setting of the case and at least fifty steps, or fewer so that all
/// repetitions take a minute; where rebuilding takes too long for that, there are fewer rounds than three. No
/// repetition passes the end of the case; time.max_steps limits runs only.
///
/// Collective. @param whole  the model built from the case, on the root; null elsewhere
/// @param progress           of this rank
/// Memory: the model and a second copy of its state. Ends after the present step when `stop_requested` (run.hpp).
/// Throws InputError if the race would start after the end of the case or nothing can touch; SimulationError as a run;
/// and InternalError that names both candidates if two repetitions end in different states.
[[nodiscard]] RaceResult race_case(const case_::Case& input, const RaceSettings& settings, std::unique_ptr<Model> whole,
                                   RaceProgress& progress, const Communicator& communicator);

}  // namespace breccia
