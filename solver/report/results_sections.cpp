#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "output/folder/energy_terms.hpp"
#include "report/chart.hpp"
#include "report/html.hpp"
#include "report/page.hpp"

namespace breccia::report {
namespace {

/// Name of a term's column in history.csv.
std::string column_of(const EnergyTerm& term) {
  std::string name = term.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  return name + " [J]";
}

bool is_stock(const EnergyTerm& term) {
  const std::string name = term.name;
  return name != "external_work" && name != "step_change" && name != "residual";
}

/// What the bodies had at the start, and what was put in from outside until then.
std::vector<double> put_in(const History& history) {
  double at_start = 0;
  for (const EnergyTerm& term : kEnergyTerms) {
    const std::vector<double>& values = history.column(column_of(term));
    if (is_stock(term) && !values.empty()) at_start += values.front();
  }
  std::vector<double> sum = history.column("external work [J]");
  const double before = sum.empty() ? 0 : sum.front();
  for (double& value : sum) value += at_start - before;
  return sum;
}

std::string energy_chart(const History& history) {
  Chart chart{"Energy over time", "time", "s", "energy", "J", false, false, true, {}};
  const std::vector<double>& time = history.column("time [s]");
  for (const EnergyTerm& term : kEnergyTerms) {
    const std::vector<double>& values = history.column(column_of(term));
    const bool something = std::any_of(values.begin(), values.end(), [](double v) { return v != 0; });
    if (is_stock(term) && something) chart.series.push_back({term.words, time, values});
  }
  if (chart.series.empty()) return {};
  const std::vector<double> total = put_in(history);
  if (total.size() == time.size()) chart.series.push_back({"put in", time, total, false, true});
  return figure(svg_of(chart),
                "Terms of the energy budget, stacked. The dashed line is the initial energy plus the external work: "
                "without unaccounted energy it is the top of the stack.");
}

std::string time_chart(const History& history, const std::string& title, const std::string& y_name,
                       const std::string& unit, const std::vector<std::pair<const char*, const char*>>& columns) {
  Chart chart{title, "time", "s", y_name, unit, false, false, false, {}};
  const std::vector<double>& time = history.column("time [s]");
  for (const auto& [column, words] : columns) {
    const std::vector<double>& values = history.column(column);
    if (!values.empty()) chart.series.push_back({words, time, values});
  }
  return svg_of(chart);
}

std::string figure_unless_empty(const std::string& svg, std::string_view caption) {
  return svg.empty() ? svg : figure(svg, caption);
}

/// Values of a row; NaN where there are none.
double first_of(const Row& row, const std::string& name) {
  const auto found = row.find(name);
  return found == row.end() || found->second.empty() ? std::nan("") : found->second.front();
}

double length_of(const Row& row, const std::string& name) {
  const auto found = row.find(name);
  if (found == row.end()) return std::nan("");
  double sum = 0;
  for (const double value : found->second) sum += value * value;
  return std::sqrt(sum);
}

const std::vector<Row>& table_of(const Figures& figures, const char* name) {
  static const std::vector<Row> none;
  const auto found = figures.tables.find(name);
  return found == figures.tables.end() ? none : found->second;
}

std::vector<double> curve(const Figures& figures, const std::string& name, const std::string& column) {
  const auto found = figures.curves.find(name);
  if (found == figures.curves.end()) return {};
  const auto values = found->second.find(column);
  return values == found->second.end() ? std::vector<double>() : values->second;
}

struct Fact {
  const char* words;
  double value;
  const char* unit;
};

/// A table of two columns, of those facts that are known.
std::string fact_table(const std::string& caption, std::initializer_list<Fact> facts) {
  Table table{caption, {}, {}};
  for (const Fact& fact : facts) {
    if (std::isfinite(fact.value))
      table.rows.push_back({Cell::text(fact.words), Cell::number_of(fact.value, fact.unit)});
  }
  return table.html();
}

constexpr std::pair<const char*, const char*> kFits[] = {{"rosin_rammler", "Rosin-Rammler"}, {"swebrec", "Swebrec"}};

std::string sieve_chart(const Figures& figures) {
  const std::string name = "fragments.sieve";
  const std::vector<double> size = curve(figures, name, "size");
  if (size.size() < 2) return {};
  Chart chart{"Sieve curve", "size on the sieve", "m", "share of the mass that passes", "", true, false, false, {}};
  chart.series.push_back({"fragments", size, curve(figures, name, "passing"), true});
  for (const auto& [column, words] : kFits) {
    const std::vector<double> values = curve(figures, name, column);
    if (values.size() == size.size() && std::isfinite(values.front())) chart.series.push_back({words, size, values});
  }
  return figure_unless_empty(
      svg_of(chart),
      "Share of the mass in fragments that pass a sieve (middle diameter of the ellipsoid of the "
      "same moments), with fits by least squares of the share, weighted with the mass. Parts that no crack bounds "
      "are left out.");
}

/// Why there is no curve, of each fit that is left out.
std::string fits_left_out(const Figures& figures) {
  std::string html;
  for (const auto& [name, words] : kFits) {
    const std::string reason = figures.text("fragments", std::string(name) + "_left_out");
    if (!reason.empty()) html += paragraph(fmt::format("The {} fit is left out: {}.", words, reason));
  }
  return html;
}

/// The settings of Crack Events that have found them.
std::string settings_of_events(const Figures& figures) {
  const auto fact = [&](const char* name) { return figures.fact("events", name); };
  if (!std::isfinite(fact("linking_distance"))) return {};
  return paragraph(
      fmt::format("Joints of one event are linked by at most {} and {}, with their places {}. The b-value is of the "
                  "{} magnitude. These are the settings with which the filter Crack Events starts.",
                  quantity(fact("linking_distance"), "m"), quantity(fact("linking_time"), "s"),
                  fact("at_time_shown") > 0 ? "at the time shown" : "at the time of failure",
                  fact("magnitude_of_energy") > 0 ? "energy" : "moment"));
}

}  // namespace

std::string energies(const RunRecord& run) {
  if (run.history.rows() == 0) return {};
  std::string html =
      figure_unless_empty(time_chart(run.history, "Relative residual of the energy budget over time",
                                     "residual of the budget", "", {{"relative residual", "relative residual"}}),
                          "Energy that is unaccounted, over the largest total until then.");
  Table table{"Energy at the last line of the history", {"term", "energy"}, {}};
  for (const EnergyTerm& term : kEnergyTerms) {
    const double value = run.history.last(column_of(term));
    const bool outside = std::string_view(term.name) == "external_work";
    if (std::isfinite(value))
      table.rows.push_back({Cell::text(outside ? "work from outside" : term.words), Cell::number_of(value, "J")});
  }
  const std::vector<double> total = put_in(run.history);
  if (!total.empty())
    table.rows.push_back({Cell::text("put in: start and outside"), Cell::number_of(total.back(), "J")});
  table.rows.push_back({Cell::text("relative residual"), Cell::number_of(run.history.last("relative residual"), "")});
  return energy_chart(run.history) + pair(html + table.html());
}

std::string cracks(const RunRecord& run, const Figures& figures) {
  const History& history = run.history;
  std::string html = figure_unless_empty(
      time_chart(history, "Broken joints over time", "joints", "",
                 {{"broken joints", "all broken"}, {"broken in mode I", "mode I"}, {"broken in mode II", "mode II"}}),
      "Joints that have failed: all, by opening (mode I), by sliding (mode II); the rest of all failed in both at "
      "once.");
  Table table{"At the last line of the history", {"", "joints", "area"}, {}};
  const auto row = [&](const char* words, const char* count, const char* area) {
    if (!std::isfinite(history.last(count))) return;
    table.rows.push_back(
        {Cell::text(words), Cell::count(history.last(count)), Cell::number_of(history.last(area), "m2")});
  };
  row("all", "broken joints", "broken area [m2]");
  row("mode I", "broken in mode I", "broken area in mode I [m2]");
  row("mode II", "broken in mode II", "broken area in mode II [m2]");
  const std::string facts =
      fact_table("Fracture surface at the last frame",
                 {{"area", figures.fact("cracks", "fracture_area"), "m2"},
                  {"root mean square height", figures.fact("cracks", "rms_height"), "m"},
                  {"mean speed of the crack tip", figures.fact("cracks", "tip_mean_speed"), "m/s"}});
  return pair(html + tables(table.html() + facts));
}

std::string fragments(const RunRecord& run, const Figures& figures) {
  std::string html =
      figure_unless_empty(time_chart(run.history, "Fragments over time", "fragments", "", {{"fragments", "fragments"}}),
                          "Parts that hang together through joints that have not failed.");
  html = pair(html + sieve_chart(figures));
  const auto fit = [&](const std::string& name, const char* measure) {
    return figures.text("fragments", name + "_left_out").empty() ? figures.fact("fragments", name + "_" + measure)
                                                                 : std::nan("");
  };
  std::string found = fact_table("At the last frame",
                                 {{"d50: half of the mass is in smaller ones", figures.fact("fragments", "d50"), "m"},
                                  {"d80: four fifths of it are", figures.fact("fragments", "d80"), "m"},
                                  {"Rosin-Rammler: size", figures.fact("fragments", "rosin_rammler_size"), "m"},
                                  {"Rosin-Rammler: exponent", figures.fact("fragments", "rosin_rammler_exponent"), ""},
                                  {"Rosin-Rammler: R2", fit("rosin_rammler", "r2"), ""},
                                  {"Rosin-Rammler: largest deviation", fit("rosin_rammler", "deviation"), ""},
                                  {"Swebrec: median", figures.fact("fragments", "swebrec_median"), "m"},
                                  {"Swebrec: largest", figures.fact("fragments", "swebrec_largest"), "m"},
                                  {"Swebrec: exponent", figures.fact("fragments", "swebrec_exponent"), ""},
                                  {"Swebrec: R2", fit("swebrec", "r2"), ""},
                                  {"Swebrec: largest deviation", fit("swebrec", "deviation"), ""},
                                  {"mass of all parts", figures.fact("fragments", "mass"), "kg"}});
  Table table{"The heaviest fragments at the last frame",
              {"fragment", "body", "elements", "mass", "volume", "diameter", "speed", "spin", "sphericity"},
              {}};
  for (const Row& row : table_of(figures, "fragments.largest"))
    table.rows.push_back(
        {Cell::id(first_of(row, "fragment")), Cell::text(run.body_name(first_of(row, "body"))),
         Cell::count(first_of(row, "elements")), Cell::number_of(first_of(row, "mass"), "kg"),
         Cell::number_of(first_of(row, "volume"), "m3"), Cell::number_of(first_of(row, "diameter"), "m"),
         Cell::number_of(length_of(row, "velocity"), "m/s"), Cell::number_of(length_of(row, "spin"), "rad/s"),
         Cell::number_of(first_of(row, "sphericity"), "")});
  found += table.html();
  html += fits_left_out(figures) + tables(found);
  if (!table.rows.empty())
    html += paragraph(
        "A fragment is called by the smallest id of its elements; its diameter is that of a sphere of the "
        "same volume.");
  return html;
}

std::string events(const Figures& figures) {
  const double count = figures.fact("events", "count");
  if (!(count > 0)) return {};
  Chart chart{
      "Events of a magnitude or more", "energy magnitude", "", "events of it or more", "", false, true, false, {}};
  const std::vector<double> magnitude = curve(figures, "events.magnitudes", "magnitude");
  chart.series.push_back({"events", magnitude, curve(figures, "events.magnitudes", "events_of_it_or_more"), true});
  chart.series.push_back({"Gutenberg-Richter", magnitude, curve(figures, "events.magnitudes", "gutenberg_richter")});
  for (std::size_t i = 0; i < chart.series[1].y.size(); ++i) {
    double& value = chart.series[1].y[i];
    if (i >= magnitude.size() || magnitude[i] < figures.fact("events", "completeness") - 1e-9 || value < 1)
      value = std::nan("");
  }
  const std::string html = paragraph(
      "Joints that failed near each other in space and time are one event. Its energy magnitude is two thirds of "
      "the logarithm (base 10) of its energy in joules, less 2.9.");
  const std::string drawn =
      figure_unless_empty(svg_of(chart),
                          "Number of events of a magnitude or more, with the law that fits those above the "
                          "magnitude of completeness.");
  const std::string facts =
      fact_table("At the last frame", {{"events", count, ""},
                                       {"energy of all events", figures.fact("events", "energy"), "J"},
                                       {"b-value", figures.fact("events", "b_value"), ""},
                                       {"standard error of the b-value", figures.fact("events", "b_error"), ""},
                                       {"magnitude of completeness", figures.fact("events", "completeness"), ""}});
  Table table{
      "Events with the most energy", {"event", "time", "duration", "joints", "area", "energy", "magnitude"}, {}};
  for (const Row& row : table_of(figures, "events.largest"))
    table.rows.push_back({Cell::id(first_of(row, "event")), Cell::number_of(first_of(row, "time"), "s"),
                          Cell::number_of(first_of(row, "duration"), "s"), Cell::count(first_of(row, "joints")),
                          Cell::number_of(first_of(row, "area"), "m2"), Cell::number_of(first_of(row, "energy"), "J"),
                          Cell::number_of(first_of(row, "energy_magnitude"), "")});
  return html + settings_of_events(figures) + pair(drawn + facts) + table.html();
}

std::string contacts(const RunRecord& run, const Figures& figures) {
  const std::vector<double>& touching = run.history.column("contacts");
  if (std::none_of(touching.begin(), touching.end(), [](double v) { return v > 0; })) return {};
  const std::string drawn =
      figure_unless_empty(time_chart(run.history, "Contacts over time", "contacts", "", {{"contacts", "contacts"}}),
                          "Points that touch a body.");
  const double time = figures.facts.contains("contacts") ? figures.fact("contacts", "time") : std::nan("");
  const std::string facts =
      fact_table("At the frame with the most contacts",
                 {{"time", time, "s"},
                  {"fragments that touch others", figures.fact("contacts", "fragments"), ""},
                  {"mean coordination number", figures.fact("contacts", "mean_coordination_number"), ""}});
  Table table{"Forces between bodies then", {"on body", "by body", "force", "x", "y", "z", "contacts"}, {}};
  for (const Row& row : table_of(figures, "contacts.walls")) {
    const auto force = row.find("force");
    if (force == row.end() || force->second.size() != 3) continue;
    table.rows.push_back({Cell::text(run.body_name(first_of(row, "body"))),
                          Cell::text(run.body_name(first_of(row, "other_body"))),
                          Cell::number_of(length_of(row, "force"), "N"), Cell::number_of(force->second[0], "N"),
                          Cell::number_of(force->second[1], "N"), Cell::number_of(force->second[2], "N"),
                          Cell::count(first_of(row, "contacts"))});
  }
  return pair(drawn + facts) + table.html();
}

}  // namespace breccia::report
