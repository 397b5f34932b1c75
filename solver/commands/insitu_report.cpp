#include "commands/insitu_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/extent.hpp"
#include "base/printable.hpp"
#include "base/quantity_text.hpp"
#include "mesh/holding_elements.hpp"
#include "output/insitu/trigger.hpp"

namespace breccia {
namespace {

std::vector<Vec3> points_of(const case_::Probe& probe) {
  std::vector<Vec3> points;
  const auto share = [](int i, int count) { return count > 1 ? static_cast<double>(i) / (count - 1) : 0.0; };
  for (int row = 0; row < probe.rows; ++row) {
    for (int i = 0; i < probe.points; ++i)
      points.emplace_back(probe.at + share(i, probe.points) * probe.along + share(row, probe.rows) * probe.across);
  }
  return points;
}

std::string box_of(const Mesh& mesh) {
  const auto [lower, upper] = extent_of(mesh.nodes);
  return fmt::format("the model is from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m", lower.x(), lower.y(),
                     lower.z(), upper.x(), upper.y(), upper.z());
}

/// Instants of a time interval: its multiples from the start on, and the end; no more than steps, and the end.
std::string instants_every(double interval, double span, double steps) {
  const double count = std::min(std::ceil(span / interval - 1e-9), steps) + 1;
  return fmt::format("{:.0f} instants", count);
}

/// "every 0.6 ms: 8 instants".
std::string instants_of(const case_::Pipeline& pipeline, double span, double steps) {
  std::string text;
  const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
  if (!pipeline.has_trigger())
    add(fmt::format("evenly over the run: {}", instants_every(span / Trigger::kTimes, span, steps)));
  if (pipeline.every_time > 0)
    add(fmt::format("every {}: {}", quantity_text(pipeline.every_time, "s"),
                    instants_every(pipeline.every_time, span, steps)));
  if (pipeline.every_steps > 0)
    add(fmt::format("every {} steps: about {:.0f} instants", count_text(pipeline.every_steps),
                    std::ceil(steps / static_cast<double>(pipeline.every_steps)) + 1));
  if (pipeline.every_broken > 0) add(fmt::format("for every {} broken joints", count_text(pipeline.every_broken)));
  if (pipeline.first_break) add("at the first break");
  if (pipeline.every_wall > 0) add(fmt::format("every {} of wall time", duration_text(pipeline.every_wall)));
  return text;
}

std::string region_line(const case_::Region& region, const Mesh& mesh) {
  const auto holds = [&](const std::array<Index, 4>& corners) {
    Vec3 centre = Vec3::Zero();
    for (const Index node : corners) centre += 0.25 * mesh.nodes[at(node)];
    return (centre.array() >= region.lower.array()).all() && (centre.array() <= region.upper.array()).all();
  };
  const auto count = std::count_if(mesh.elements.begin(), mesh.elements.end(), holds);
  std::string text = fmt::format("    its region holds {} of {} elements before the first step", count_text(count),
                                 count_text(mesh.num_elements()));
  if (count == 0) text += "; " + box_of(mesh);
  return text + "\n";
}

std::string probe_line(const case_::Probe& probe, const Mesh& mesh) {
  const std::vector<HoldingElement> held = holding_elements(mesh, points_of(probe));
  const auto points = std::ssize(held);
  const auto inside = std::count_if(held.begin(), held.end(), [](const HoldingElement& h) { return h.element >= 0; });
  std::string text = fmt::format("    probe {}: {} of {} points in elements before the first step",
                                 printable(probe.name), count_text(inside), count_text(points));
  if (inside < points) text += "; " + box_of(mesh);
  return text + "\n";
}

}  // namespace

std::string insitu_report(const case_::Case& input, const Mesh& mesh, double begin, double steps) {
  if (input.insitu.pipelines.empty()) return {};
  const double span = input.stages.back().end - begin;
  std::string text = "in situ\n";
  for (const case_::Pipeline& pipeline : input.insitu.pipelines) {
    text += fmt::format("  {}: {}", printable(pipeline.name), instants_of(pipeline, span, steps));
    if (!pipeline.strict)
      text += fmt::format(", or fewer within {:.3g} % of the wall time{}", 100 * input.insitu.max_overhead,
                          pipeline.least > 0 ? fmt::format(", but {} at least", pipeline.least) : "");
    text += "\n";
    if (pipeline.region) text += region_line(*pipeline.region, mesh);
    for (const case_::Probe& probe : pipeline.probes) text += probe_line(probe, mesh);
  }
  if (input.insitu.live && input.insitu.live->region)
    text += "  live view\n" + region_line(*input.insitu.live->region, mesh);
  return text;
}

}  // namespace breccia
