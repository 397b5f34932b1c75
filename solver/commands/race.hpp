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

/// What a race is about.
struct RaceSettings {
  std::vector<case_::DetectionAlgorithm> algorithms;  ///< empty: all, brute_force only where the model is small enough
  std::vector<double> buffers{0.5, 1, 2, 4};          ///< multiples of the case's own buffer, which races in any event
  double from = 0;                                    ///< s, simulated: where the race starts
  double time = 0;                                    ///< s, simulated: length of a lap; 0: see steps
  std::int64_t steps = 0;                             ///< length of a lap; 0 and no time: chosen (race_case)
};

/// One search algorithm with its settings.
struct Racer {
  case_::DetectionAlgorithm algorithm;
  double buffer = 0;  ///< m; 0: "auto"
  bool as_in_case = false;

  [[nodiscard]] std::string algorithm_text() const;  ///< "ms", as the case file names it
  [[nodiscard]] std::string buffer_text() const;     ///< "0.0005 m" or "auto", likewise
  /// "ms, buffer 0.0005 m"
  [[nodiscard]] std::string name() const { return algorithm_text() + ", buffer " + buffer_text(); }
};

/// A lap of a racer: times of the slowest rank, s. A lap is timed in up to a thousand pieces, each as fast as in the
/// fastest of its laps; on one rank what is neither search nor contact is the same for all, as fast as in anybody's
/// fastest lap.
struct Lap {
  double wall = 0, contact = 0;
  double search = 0;          ///< with what fracture makes touch between searches
  double full_search = 0;     ///< of it, in steps with a search
  std::int64_t searches = 0;  ///< done: the first at the start of the lap
  double used = 0;            ///< of these: the last one counts as far as nodes have used its buffer up
  std::int64_t couples = 0;   ///< of the whole model at the end

  [[nodiscard]] double one_search() const { return full_search / static_cast<double>(searches); }
  /// Wall time of as many steps in a long run, which pays only for the searches that it uses.
  [[nodiscard]] double lasting() const { return wall - (static_cast<double>(searches) - used) * one_search(); }
};

struct RaceEntry {
  Racer racer;
  Lap least;
};

struct RaceResult {
  std::string title, left_out;  ///< left_out: why one of them does not race; empty: all do
  std::int64_t elements = 0, steps = 0;
  int ranks = 1, rounds = 0;       ///< rounds that all racers have finished
  double start = 0, end = 0;       ///< s, simulated
  std::vector<RaceEntry> entries;  ///< the fastest step first; none unless a round was finished
  std::string state_hash;          ///< in which every lap has ended
  bool stopped = false;            ///< by request
};

/// Runs the case from the same state to the same step with every algorithm and buffer, and compares what that costs.
///
/// The case is run once to the start, and its state kept. A lap rebuilds the model from that state and steps it,
/// without output, budgets and detection.verify; ranks share the work as they did at the start. The first lap, with the
/// settings of the case, warms up caches, determines the automatic buffer, and is discarded; then all take turns three
/// times, in alternating order, so that none is always first. Unless the settings give its length a lap lasts for ten
/// searches of the case's own setting and at least fifty steps, or for as long as all laps fit into a minute; where
/// rebuilding takes so long that they do not, there are fewer rounds than three. No lap goes beyond the end of the
/// case; time.max_steps binds runs only.
///
/// Collective. @param whole  the model built from the case, on the root; null elsewhere
/// @param progress           of this rank
/// Memory: the model and a second copy of its state. Ends after the present step when `stop_requested` (run.hpp).
/// Throws InputError if the race would start after the end of the case or nothing can touch; SimulationError as a run;
/// and InternalError that names both racers if two laps end in different states.
[[nodiscard]] RaceResult race_case(const case_::Case& input, const RaceSettings& settings, std::unique_ptr<Model> whole,
                                   RaceProgress& progress, const Communicator& communicator);

}  // namespace breccia
