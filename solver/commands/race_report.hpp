#pragma once

#include <string>

#include "commands/race.hpp"

namespace breccia {

/// What a race has found, in three forms. All times as in Repetition; a step is that of a long run.

/// A table, the best first, and the lines for the case file. For a terminal.
[[nodiscard]] std::string race_table(const RaceResult& result);
/// The content of race.csv: SI, a line a candidate, the best first.
[[nodiscard]] std::string race_csv(const RaceResult& result);
/// A JSON object a candidate, the best first, each on its line.
[[nodiscard]] std::string race_json(const RaceResult& result);

}  // namespace breccia
