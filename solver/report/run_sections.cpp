#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quantity_text.hpp"
#include "report/chart.hpp"
#include "report/html.hpp"
#include "report/page.hpp"

namespace breccia::report {
namespace {

constexpr double kResidualOfNote = 1e-2;  // of the energy budget: worth a warning

struct Tile {
  const char* name;
  std::string html;  ///< empty: not known
};

std::string number_tile(double value, std::string_view unit) {
  return std::isfinite(value) ? Cell::number_of(value, unit).html : std::string();
}

std::string count_tile(double value) { return std::isfinite(value) ? Cell::count(value).html : std::string(); }

/// At the end by the summary, or else at the last line of the history.
double known(const RunRecord& run, const std::string& column, const std::string& name) {
  const double value = run.number(name);
  return std::isfinite(value) ? value : run.history.last(column);
}

std::string wall_time(const RunRecord& run) {
  const double wall = std::isfinite(run.number("wall_s")) ? run.number("wall_s")
                      : run.status.empty()                ? std::nan("")
                                                          : run.status.back().wall;
  return std::isfinite(wall) ? fmt::format("<data value=\"{:.17g}\">{}</data>", wall, escaped(duration_text(wall)))
                             : "";
}

/// Names of gauges: columns "NAME contact force x [N]".
std::vector<std::string> gauge_names(const History& history) {
  constexpr std::string_view kMark = " contact force x [N]";
  std::vector<std::string> names;
  for (const std::string& column : history.names) {
    if (column.ends_with(kMark)) names.push_back(column.substr(0, column.size() - kMark.size()));
  }
  return names;
}

std::vector<double> length_over_time(const History& history, const std::string& name, const std::string& unit) {
  std::vector<double> length(history.rows(), 0.0);
  for (const char* axis : {" x [", " y [", " z ["}) {
    const std::vector<double>& part = history.column(name + axis + unit + "]");
    if (part.size() != length.size()) return {};
    for (std::size_t i = 0; i < length.size(); ++i) length[i] += part[i] * part[i];
  }
  for (double& value : length) value = std::sqrt(value);
  return length;
}

std::string gauge_chart(const RunRecord& run, const std::string& quantity_name, const std::string& unit,
                        const char* caption) {
  Chart chart{quantity_name + " of gauges over time", "time", "s", quantity_name, unit, false, false, false, {}};
  const History& history = run.history;
  for (const std::string& gauge : gauge_names(history)) {
    std::vector<double> values = length_over_time(history, gauge + " " + quantity_name, unit);
    if (std::any_of(values.begin(), values.end(), [](double v) { return v != 0; }))
      chart.series.push_back({run.gauge_label(gauge), history.column("time [s]"), std::move(values)});
  }
  const std::string svg = svg_of(chart);
  // A chart of one curve has no legend.
  const std::string gauge = chart.series.size() == 1 ? " The gauge is " + chart.series.front().name + "." : "";
  return svg.empty() ? svg : figure(svg, caption + gauge);
}

std::string phase_table(const RunRecord& run) {
  double sum = 0;
  for (const auto& [name, seconds] : run.phases) sum += seconds;
  if (!(sum > 0)) return {};
  Table table{"Wall time by phase", {"phase", "time", "share", ""}, {}};
  for (const auto& [name, seconds] : run.phases) {
    if (seconds <= 0) continue;
    table.rows.push_back({Cell::text(name),
                          Cell::number_of(seconds, "s"),
                          {fmt::format("{:.1f} %", 100 * seconds / sum), true},
                          Cell::raw(bar(seconds / sum))});
  }
  return table.html();
}

std::string rank_table(const Figures& figures) {
  const auto rows = figures.tables.find("ranks.rows");
  if (rows == figures.tables.end() || rows->second.size() < 2) return {};
  Table table{"Ranks at the last frame; load: cost over the mean", {"rank", "elements", "load", ""}, {}};
  double most = 0;
  const auto first = [](const Row& row, const char* name) {
    const auto found = row.find(name);
    return found == row.end() || found->second.empty() ? std::nan("") : found->second.front();
  };
  for (const Row& row : rows->second) most = std::max(most, first(row, "load"));
  for (const Row& row : rows->second) {
    const double load = first(row, "load");
    table.rows.push_back({Cell::id(first(row, "rank")), Cell::count(first(row, "elements")), Cell::number_of(load, ""),
                          Cell::raw(bar(most > 0 ? load / most : 0))});
  }
  return table.html();
}

std::string list(const std::vector<std::string>& lines) {
  std::string html = "<ul>\n";
  for (const std::string& line : lines) html += "<li>" + escaped(line) + "</li>\n";
  return html + "</ul>\n";
}

}  // namespace

std::string key_figures(const RunRecord& run, const Figures& figures) {
  const double time = known(run, "time [s]", "simulated_time");
  std::string simulated = number_tile(time, "s");
  if (!simulated.empty() && run.end > 0 && time < run.end * (1 - 1e-9))
    simulated += " of " + escaped(quantity(run.end, "s"));
  const Tile tiles[]{
      {"simulated time", simulated},
      {"steps", count_tile(known(run, "step", "steps"))},
      {"elements", count_tile(run.number("elements"))},
      {"joints", count_tile(run.number("joints"))},
      {"broken joints", count_tile(known(run, "broken joints", "broken_joints"))},
      {"broken area", number_tile(run.history.last("broken area [m2]"), "m2")},
      {"fragments", count_tile(known(run, "fragments", "fragments"))},
      {"d50 of the fragments", number_tile(figures.fact("fragments", "d50"), "m")},
      {"crack events", count_tile(figures.fact("events", "count"))},
      {"largest speed at the end", number_tile(run.history.last("max speed [m/s]"), "m/s")},
      {"residual of the energy budget", number_tile(known(run, "relative residual", "energy_residual_relative"), "")},
      {"ranks", count_tile(std::isfinite(run.number("ranks")) ? run.number("ranks") : run.provenance.ranks)},
      {"wall time", wall_time(run)},
      {"speed", number_tile(run.number("element_steps_per_s"), "element-steps/s")}};
  std::string html = "<dl class=\"tiles\">\n";
  for (const Tile& tile : tiles) {
    if (!tile.html.empty()) html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", tile.name, tile.html);
  }
  return html + "</dl>\n";
}

std::string warnings(const RunRecord& run, const Figures& figures) {
  std::vector<std::string> lines;
  if (run.state != "complete" && run.state != "running" && run.state != "paused")
    lines.push_back("The run did not come to its end: " + run.state + (run.message.empty() ? "" : ", " + run.message) +
                    ".");
  if (run.state == "running" || run.state == "paused")
    lines.emplace_back("The run is in progress; the page shows its state when it was written.");
  const double residual = std::abs(known(run, "relative residual", "energy_residual_relative"));
  if (residual > kResidualOfNote)
    lines.push_back(fmt::format("The energy budget does not close: {:.2g} of the energy is unaccounted.", residual));
  if (const double inverted = run.number("inverted_elements"); inverted > 0)
    lines.push_back("Elements that were turned inside out: " + count_text(std::llround(inverted)) + ".");
  for (const RunEvent& event : run.events) {
    if (!event.accepted) lines.push_back(fmt::format("At {}: {}", quantity(event.time, "s"), event.text));
  }
  lines.insert(lines.end(), run.flaws.begin(), run.flaws.end());
  if (!figures.missing.empty()) lines.push_back("Pictures and statistics of frames: " + figures.missing + ".");
  for (const std::string& problem : figures.problems) lines.push_back("ParaView, " + problem);
  if (lines.empty()) return {};
  return "<section class=\"warning\" aria-label=\"Warnings\">\n<strong>Warnings</strong>\n" + list(lines) +
         "</section>\n";
}

std::string pictures(const Figures& figures) {
  std::string html;
  for (const Picture& picture : figures.pictures)
    html += fmt::format(
        "<figure>\n<img src=\"data:image/png;base64,{}\" width=\"900\" height=\"600\" alt=\"{}\">\n"
        "<figcaption><strong>{}</strong>, at {}. {}</figcaption>\n</figure>\n",
        picture.png, escaped(picture.title + ": " + picture.text), escaped(picture.title),
        escaped(quantity(picture.time, "s")), escaped(picture.text));
  return pair(html);
}

std::string gauges(const RunRecord& run) {
  const std::string html =
      gauge_chart(run, "contact force", "N", "Length of the sum of contact forces on a gauge.") +
      gauge_chart(run, "reaction", "N", "Length of the sum of reactions of prescribed motions on a gauge.") +
      gauge_chart(run, "velocity", "m/s", "Speed of a gauge, mean by mass.");
  return pair(html);
}

std::string effort(const RunRecord& run, const Figures& figures) {
  std::string html = phase_table(run);
  Chart chart{
      "Imbalance of the ranks over time", "wall time", "s", "largest over mean load", "", false, false, false, {}};
  Series imbalance{"imbalance", {}, {}};
  for (const StatusPoint& point : run.status) {
    imbalance.x.push_back(point.wall);
    imbalance.y.push_back(point.imbalance);
  }
  chart.series.push_back(std::move(imbalance));
  const double ranks = std::isfinite(run.number("ranks")) ? run.number("ranks") : run.provenance.ranks;
  if (ranks > 1 && !run.status.empty())
    html += pair(figure(svg_of(chart), "Imbalance: largest load of a rank over the mean; 1 is even."));
  html += rank_table(figures);
  Table table{"", {}, {}};
  const auto add = [&](const char* name, double value, const char* unit) {
    if (std::isfinite(value)) table.rows.push_back({Cell::text(name), Cell::number_of(value, unit)});
  };
  add("divisions among ranks", run.number("decompositions"), "");
  add("contact searches", run.number("searches"), "");
  add("messages", run.number("messages"), "");
  add("sent in messages", run.number("message_bytes"), "B");
  add("largest memory of a rank", run.number("max_rss_bytes"), "B");
  add("checkpoints", run.number("checkpoints.written"), "");
  return html + table.html();
}

std::string origin(const RunRecord& run, const Figures& figures, const std::string& made) {
  const Provenance& p = run.provenance;
  Table table{"", {}, {}};
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) table.rows.push_back({Cell::text(name), Cell::text(value)});
  };
  std::string command;
  for (const std::string& word : p.command_line) command += (command.empty() ? "" : " ") + word;
  add("program", p.version.empty() ? "" : "breccia " + p.version + (p.commit.empty() ? "" : ", sources " + p.commit));
  if (!command.empty())
    table.rows.push_back({Cell::text("command"), Cell::raw("<code>" + escaped(command) + "</code>")});
  add("started", p.started);
  for (const RunEvent& event : run.events) {
    if (event.kind == "resume") add("resumed", event.text);
  }
  add("ranks", p.ranks > 0 ? std::to_string(p.ranks) : "");
  const auto simd = run.words.find("simd");
  add("machine", p.host + (p.processor.empty() ? "" : ", " + p.processor) +
                     (p.cores > 0 ? ", " + std::to_string(p.cores) + " hardware threads" : "") +
                     (simd == run.words.end() ? "" : ", " + simd->second));
  add("built with", p.compiler + (p.flags.empty() ? "" : ", " + p.flags));
  add("libraries", p.libraries);
  if (const auto hash = run.words.find("state_hash"); hash != run.words.end())
    table.rows.push_back(
        {Cell::text("hash of the last state"), Cell::raw("<code>" + escaped(hash->second) + "</code>")});
  add("pictures and statistics", figures.paraview.empty() ? "" : "ParaView " + figures.paraview);
  add("folder", run.folder.string());
  add("this page", made);
  Table inputs{"Inputs", {"file", "SHA-256"}, {}};
  for (const Provenance::Input& input : p.inputs)
    inputs.rows.push_back({Cell::text(input.file), Cell::raw("<code>" + escaped(input.sha256) + "</code>")});
  std::string html = table.html() + inputs.html();
  if (!run.case_text.empty())
    html +=
        "<details>\n<summary>The case as it was run</summary>\n<pre>" + escaped(run.case_text) + "</pre>\n</details>\n";
  return html;
}

}  // namespace breccia::report
