#include "commands/race_report.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "base/quantity_text.hpp"

namespace breccia {
namespace {

/// A gain of less than this is not worth a line in the case file.
constexpr double kWorthwhileGain = 0.03;

double step_s(const RaceResult& result, const Repetition& repetition) {
  return repetition.lasting() / static_cast<double>(result.steps);
}

double speed(const RaceResult& result, const Repetition& repetition) {
  return static_cast<double>(result.elements) * static_cast<double>(result.steps) / repetition.lasting();
}

std::string head(const RaceResult& result) {
  return fmt::format(
      "race of contact searches: {}\n{} elements on {} rank{}, {} steps from {} to {}; best of {} repetitions\n",
      result.title, count_text(result.elements), result.ranks, result.ranks == 1 ? "" : "s", count_text(result.steps),
      quantity_text(result.start, "s"), quantity_text(result.end, "s"), result.rounds);
}

std::string line(const RaceResult& result, const RaceEntry& entry, bool best) {
  const Repetition& repetition = entry.least;
  return fmt::format("{} {:<11} {:<12} {:>8} {:>8.2f} {:>9} {:>10} {:>9} {:>9} {:>9} {:>16}{}\n", best ? '*' : ' ',
                     entry.candidate.algorithm_text(), entry.candidate.buffer_text(), count_text(repetition.searches),
                     repetition.used, quantity_text(repetition.search, "s"),
                     quantity_text(repetition.one_search(), "s"), count_text(repetition.couples),
                     quantity_text(repetition.contact, "s"), quantity_text(step_s(result, repetition), "s"),
                     count_text(static_cast<std::int64_t>(speed(result, repetition))),
                     entry.candidate.as_in_case ? "  as in the case" : "");
}

std::string verdict(const RaceResult& result) {
  const RaceEntry& best = result.entries.front();
  const auto own = std::find_if(result.entries.begin(), result.entries.end(),
                                [](const RaceEntry& e) { return e.candidate.as_in_case; });
  std::string text = "best: " + best.candidate.name();
  if (own != result.entries.end()) {
    const double gain = 1.0 - best.least.lasting() / own->least.lasting();
    if (own == result.entries.begin()) {
      text += ", as in the case";
    } else if (gain < kWorthwhileGain) {
      text += fmt::format("; the case's own takes only {:.1f} % longer", 100 * (1.0 / (1.0 - gain) - 1.0));
    } else {
      text += fmt::format(", a step takes {:.1f} % less time than as in the case", 100 * gain);
    }
  }
  text += fmt::format("\n\n[detection]\nalgorithm = \"{}\"\nbuffer = \"{}\"\n", best.candidate.algorithm_text(),
                      best.candidate.buffer_text());
  return text;
}

}  // namespace

std::string race_table(const RaceResult& result) {
  std::string text;
  if (!result.entries.empty()) {
    text = head(result) + fmt::format("\n  {:<11} {:<12} {:>8} {:>8} {:>9} {:>10} {:>9} {:>9} {:>9} {:>16}\n",
                                      "algorithm", "buffer", "searches", "used up", "searching", "one search",
                                      "couples", "contact", "a step", "element-steps/s");
    for (const RaceEntry& entry : result.entries) text += line(result, entry, &entry == &result.entries.front());
    if (!result.left_out.empty()) text += "  " + result.left_out + "\n";
    text += fmt::format("all have ended in state {}\n", result.state_hash) + verdict(result);
  }
  if (result.stopped)
    text += fmt::format("stopped by request {}\n",
                        result.entries.empty() ? "before each candidate had run once" : "before the last repetition");
  return text;
}

std::string race_csv(const RaceResult& result) {
  std::string text =
      "algorithm,buffer,as in the case,searches,searches used up,search [s],one search [s],couples,contact [s],step "
      "[s],element-steps/s,steps,state hash\n";
  for (const auto& [candidate, repetition] : result.entries) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", candidate.algorithm_text(), candidate.buffer_text(),
                        candidate.as_in_case ? 1 : 0, repetition.searches, repetition.used, repetition.search,
                        repetition.one_search(), repetition.couples, repetition.contact, step_s(result, repetition),
                        speed(result, repetition), result.steps, result.state_hash);
  }
  return text;
}

std::string race_json(const RaceResult& result) {
  std::string text;
  for (const auto& [candidate, repetition] : result.entries) {
    text +=
        fmt::format(R"({{"algorithm":"{}","buffer":"{}","as_in_case":{},"searches":{},"used_up":{},"search_s":{},)"
                    R"("one_search_s":{},"couples":{},"contact_s":{},"step_s":{},)"
                    R"("element_steps_per_s":{},"steps":{},"state_hash":"{}"}})",
                    candidate.algorithm_text(), candidate.buffer_text(), candidate.as_in_case, repetition.searches,
                    repetition.used, repetition.search, repetition.one_search(), repetition.couples, repetition.contact,
                    step_s(result, repetition), speed(result, repetition), result.steps, result.state_hash) +
        "\n";
  }
  return text + fmt::format(R"({{"state":"{}","rounds":{}}})", result.stopped ? "stopped" : "complete", result.rounds) +
         "\n";
}

}  // namespace breccia
