#include "output/folder/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/printable.hpp"
#include "base/quantity_text.hpp"
#include "output/folder/energy_terms.hpp"
#include "output/folder/summary_gauges.hpp"
#include "system/atomic_file.hpp"
#include "system/bounded_file.hpp"

namespace breccia {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t kLabelWidth = 26;

void add_line(std::string& text, std::string_view label, std::string_view value) {
  fmt::format_to(std::back_inserter(text), "  {:<{}} {}\n", label, kLabelWidth, value);
}

void add_share(std::string& text, std::string_view label, const std::string& value, double share) {
  fmt::format_to(std::back_inserter(text), "    {:<{}} {:>12} {:>7.2f} %\n", label, kLabelWidth - 2, value,
                 100 * share);
}

double largest_energy(const EnergyBudget& energy) {
  double largest = 0;
  for (const EnergyTerm& term : kEnergyTerms) largest = std::max(largest, std::abs(energy.*term.value));
  return largest;
}

void add_phases(std::string& text, const Summary& summary) {
  double total = 0;
  for (const auto& [name, seconds] : summary.phases) total += seconds;
  if (total <= 0) return;
  text += "  time by phase\n";
  for (const auto& [name, seconds] : summary.phases) add_share(text, name, duration_text(seconds), seconds / total);
}

void add_energies(std::string& text, const EnergyBudget& energy) {
  const double largest = largest_energy(energy);
  if (largest <= 0) return;
  if (energy.is_round_off) return add_line(text, "energy", "no more than round-off, " + quantity_text(largest, "J"));
  text += "  energy, share of the largest term\n";
  for (const EnergyTerm& term : kEnergyTerms) {
    const double value = energy.*term.value;
    if (value != 0) add_share(text, term.words, quantity_text(value, "J"), value / largest);
  }
}

/// Share of the wall time of this span that the starts of pipelines took.
double insitu_start_share(const Summary& summary) {
  double seconds = 0;
  for (const PipelineReport& p : summary.insitu) seconds += p.start_s;
  return summary.span_s > 0 ? seconds / summary.span_s : 0.0;
}

/// Share of the wall time of this span that pipelines took, starts included.
double insitu_share(const Summary& summary) {
  double seconds = 0;
  for (const PipelineReport& p : summary.insitu) seconds += p.seconds;
  return insitu_start_share(summary) + (summary.span_s > 0 ? seconds / summary.span_s : 0.0);
}

OrderedJson insitu_json(const Summary& summary) {
  OrderedJson json;
  json["share"] = insitu_share(summary);
  json["start_share"] = insitu_start_share(summary);
  json["pipelines"] = OrderedJson::array();
  for (const PipelineReport& p : summary.insitu) {
    json["pipelines"].push_back({{"name", p.name},
                                 {"executed", p.executed},
                                 {"passed_over", p.passed_over},
                                 {"failed", p.failed},
                                 {"start_s", p.start_s},
                                 {"seconds", p.seconds},
                                 {"bytes", p.bytes}});
  }
  return json;
}

OrderedJson at_time(double value, double time) { return {{"value", value}, {"time", time}}; }

OrderedJson conditions_json(const std::vector<ConditionReport>& conditions) {
  OrderedJson list = OrderedJson::array();
  for (const ConditionReport& c : conditions) {
    OrderedJson values = OrderedJson::object();
    for (const auto& [name, value] : c.values) values[name] = value;
    list.push_back({{"key", c.key},
                    {"when", c.when},
                    {"action", c.action},
                    {"times", c.times},
                    {"first", {{"step", c.first_step}, {"time", c.first_time}}},
                    {"last", {{"step", c.last_step}, {"time", c.last_time}, {"values", values}}}});
  }
  return list;
}

OrderedJson peaks_json(const std::vector<PeakReport>& peaks) {
  OrderedJson list = OrderedJson::array();
  for (const PeakReport& p : peaks) {
    OrderedJson& entry = list.emplace_back(OrderedJson{{"gauge", p.gauge},
                                                       {"quantity", p.quantity},
                                                       {"unit", p.unit},
                                                       {"largest", at_time(p.largest, p.largest_at)},
                                                       {"smallest", at_time(p.smallest, p.smallest_at)}});
    if (p.first_peak) entry["first_peak"] = at_time(*p.first_peak, p.first_peak_at);
  }
  return list;
}

/// Speed, energies and counts of what has happened are of the whole run; what the program has spent is of this span.
std::string wall_text(const Summary& summary) {
  std::string text = duration_text(summary.wall_s);
  if (summary.resumed_at >= 0)
    text += fmt::format("; {} since the resume at step {}, to which phases, messages, pipelines and checkpoints belong",
                        duration_text(summary.span_s), count_text(summary.resumed_at));
  return text;
}

void add_pipelines(std::string& text, const Summary& summary) {
  if (summary.insitu.empty()) return;
  add_line(text, "in situ",
           fmt::format("{:.2f} % of the wall time, {:.2f} % to start", 100 * insitu_share(summary),
                       100 * insitu_start_share(summary)));
  for (const PipelineReport& p : summary.insitu) {
    std::string line =
        fmt::format("    {}: {} times in {}, start {}, {}", p.name, count_text(p.executed), duration_text(p.seconds),
                    duration_text(p.start_s), bytes_text(static_cast<std::uint64_t>(p.bytes)));
    if (p.passed_over > 0) line += fmt::format("; {} times passed over for max_overhead", count_text(p.passed_over));
    if (p.failed > 0) line += fmt::format("; failed {} times", count_text(p.failed));
    text += line + "\n";
  }
}

void add_checkpoints(std::string& text, const CheckpointReport& report) {
  if (report.written + report.failed == 0) return;
  std::string line =
      fmt::format("{}, {} each; steps waited {} in all, {} at most", count_text(report.written),
                  bytes_text(report.bytes), duration_text(report.pause_s), duration_text(report.longest_pause_s));
  if (report.failed > 0) line += fmt::format("; {} failed", count_text(report.failed));
  add_line(text, "checkpoints", line);
}

}  // namespace

std::string summary_json(const Summary& summary) {
  OrderedJson json;
  json["title"] = summary.title;
  json["status"] = summary.status;
  json["version"] = summary.version;
  json["host"] = summary.host;
  json["simd"] = summary.simd;
  json["ranks"] = summary.ranks;
  json["decompositions"] = summary.decompositions;
  json["imbalance"] = summary.imbalance;
  json["messages"] = summary.messages;
  json["message_bytes"] = summary.message_bytes;
  json["steps"] = summary.steps;
  json["simulated_time"] = summary.simulated_time;
  json["time_step"] = summary.time_step;
  json["elements"] = summary.elements;
  json["joints"] = summary.joints;
  json["broken_joints"] = summary.broken_joints;
  json["fragments"] = summary.fragments;
  json["searches"] = summary.searches;
  json["inverted_elements"] = summary.inverted_elements;
  json["wall_s"] = summary.wall_s;
  json["element_steps_per_s"] = summary.element_steps_per_s;
  if (summary.resumed_at >= 0) json["since_resume"] = {{"step", summary.resumed_at}, {"wall_s", summary.span_s}};
  json["phases"] = OrderedJson::object();
  for (const auto& [name, seconds] : summary.phases) json["phases"][name] = seconds;
  if (!summary.insitu.empty()) json["insitu"] = insitu_json(summary);
  json["checkpoints"] = {{"written", summary.checkpoints.written},
                         {"failed", summary.checkpoints.failed},
                         {"pause_s", summary.checkpoints.pause_s},
                         {"longest_pause_s", summary.checkpoints.longest_pause_s},
                         {"bytes", summary.checkpoints.bytes}};
  if (!summary.conditions.empty()) json["conditions"] = conditions_json(summary.conditions);
  if (!summary.peaks.empty()) json["gauges"] = peaks_json(summary.peaks);
  json["energy"] = OrderedJson::object();
  for (const EnergyTerm& term : kEnergyTerms) json["energy"][term.name] = summary.energy.*term.value;
  json["energy_residual_relative"] = summary.energy.residual_relative;
  json["max_rss_bytes"] = summary.max_rss_bytes;
  json["state_hash"] = summary.state_hash;
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::string summary_text(const Summary& summary) {
  std::string text = fmt::format("{}: {}\n", summary.title.empty() ? "run" : printable(summary.title), summary.status);
  add_line(text, "simulated",
           fmt::format("{} in {} steps of {}", quantity_text(summary.simulated_time, "s"), count_text(summary.steps),
                       quantity_text(summary.time_step, "s")));
  add_line(text, "elements", count_text(summary.elements));
  add_line(text, "joints", fmt::format("{}, {} broken", count_text(summary.joints), count_text(summary.broken_joints)));
  add_line(text, "fragments", count_text(summary.fragments));
  add_line(text, "contact searches", count_text(summary.searches));
  if (summary.inverted_elements > 0) add_line(text, "inverted elements", count_text(summary.inverted_elements));
  add_line(text, "wall time", wall_text(summary));
  add_line(text, "speed", quantity_text(summary.element_steps_per_s, "element-steps/s"));
  add_phases(text, summary);
  add_pipelines(text, summary);
  add_checkpoints(text, summary.checkpoints);
  text += conditions_text(summary.conditions);
  text += peaks_text(summary.peaks);
  add_energies(text, summary.energy);
  add_line(text, "relative energy residual", fmt::format("{:.2e}", summary.energy.residual_relative));
  add_line(text, "memory", bytes_text(summary.max_rss_bytes));
  add_line(text, "host",
           fmt::format("{}, {} rank{}, {}", summary.host, summary.ranks, summary.ranks == 1 ? "" : "s", summary.simd));
  if (summary.ranks > 1) {
    add_line(text, "divisions of the model",
             fmt::format("{}, imbalance {:.2f}", count_text(summary.decompositions), summary.imbalance));
    add_line(text, "messages",
             fmt::format("{}, {}", count_text(summary.messages),
                         bytes_text(static_cast<std::uint64_t>(summary.message_bytes))));
  }
  add_line(text, "version", summary.version);
  add_line(text, "state hash", summary.state_hash);
  return text;
}

std::uint64_t max_resident_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

void SummarySink::finish(const Summary& summary) {
  write_file_atomically(text_, summary_text(summary));
  write_file_atomically(json_, summary_json(summary));
}

}  // namespace breccia
