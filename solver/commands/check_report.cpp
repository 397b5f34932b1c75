#include "commands/check_report.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <numeric>

#include "advice/overlaps.hpp"
#include "base/error.hpp"
#include "base/extent.hpp"
#include "base/geometry_file.hpp"
#include "base/index.hpp"
#include "base/printable.hpp"
#include "base/quantity_text.hpp"
#include "commands/contact_report.hpp"
#include "commands/data_report.hpp"
#include "commands/insitu_report.hpp"
#include "commands/joint_report.hpp"
#include "commands/refusals.hpp"
#include "contact/search_params.hpp"
#include "domains/decomposition.hpp"
#include "domains/global_step.hpp"
#include "mesh/geometry.hpp"
#include "model/node_sets.hpp"
#include "model/parameters.hpp"
#include "model/surfaces_to_break.hpp"
#include "output/folder/summary.hpp"
#include "parallel/domain_report.hpp"
#include "parallel/whole_fragments.hpp"
#include "simulation/step.hpp"

namespace breccia {
namespace {

/// Share of the stable step with which steps are timed: nothing moves, for any given step.
constexpr double kShort = 1e-3;

/// Seconds of a core that a step takes here at rest, on a scratch copy: what other programs take is not counted.
/// @param broken  with all joints broken that can break
double seconds_a_step(const case_::Case& input, const Model& model, double dt, bool broken) {
  constexpr int kLeast = 8;
  constexpr double kLongEnough = 0.2;  // s
  Domain scratch(model, search_params(input, model));
  begin_stage(scratch, stage_loads(input.stages.front(), model), dt);
  if (broken) {
    std::vector<LoadedFace> faces;
    for (const ModelJoint& joint : model.joints) {
      if (model.joint_laws[at(joint.law)].breakable())
        faces.push_back({model.local.slot_of_element[at(joint.face.a)], joint.face.face_a});
    }
    break_joints(scratch, faces);
  }
  for (int i = 0; i < 3; ++i) step(scratch);  // the first search, joints that come to the list
  const std::clock_t start = std::clock();
  double seconds = 0;
  int steps = 0;
  while (steps < kLeast || seconds < kLongEnough) {
    step(scratch);
    seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    ++steps;
  }
  return seconds / steps;
}

std::string frames_line(const FramesEstimate& estimate) {
  return fmt::format("{:.0f} frames, about {} on disk, more where joints break\n", estimate.frames,
                     quantity_text(estimate.disk, "B"));
}

/// A line for each pair of groups that overlap, or one that none do.
std::string overlap_report(const Subject& subject) {
  if (!subject.model().has_contact || subject.begun() > 0) return {};
  if (subject.overlaps().empty()) return "no bodies overlap before the first step\n";
  std::string text;
  for (const GroupOverlap& groups : subject.overlaps()) text += overlap_description(subject.model(), groups) + "\n";
  return text;
}

/// What an estimate leaves out. Two bodies that cannot break share one zone of contact, which costs little.
std::string not_counted(const Model& model, bool breaks) {
  constexpr Index kCheapBodies = 2;
  if (!model.has_contact || (!breaks && model.mesh.num_bodies <= kCheapBodies)) return {};
  return fmt::format(" (not counted: contact among {}, with which it can be several times as long)",
                     breaks ? "debris" : "many bodies");
}

/// The estimate as a line.
std::string run_time(const Model& model, const StepReport& step, const RunEstimate& estimate, double end) {
  std::string text = fmt::format("{:.0f} steps of {} to {}; about {} on this machine{}", estimate.steps,
                                 quantity_text(step.dt, "s"), quantity_text(end, "s"),
                                 quantity_text(estimate.seconds, "s"), estimate.breaks ? " while little breaks" : "");
  if (estimate.meets)
    text += fmt::format(" while no bodies meet, {} if they had met from the start",
                        quantity_text(estimate.most_seconds, "s"));
  if (estimate.breaks)
    text += fmt::format(", {} where much does, up to {} where everything does at once",
                        quantity_text(estimate.likely_seconds, "s"), quantity_text(estimate.most_seconds, "s"));
  text += not_counted(model, estimate.breaks);
  return text + fmt::format(", memory {:.0f} MB\n", static_cast<double>(estimate.memory) / 1e6);
}

/// Mean size of all elements, m: about that of the contactors.
double mean_size(const Mesh& mesh) {
  double volume = 0;
  for (const auto& c : mesh.elements) {
    volume +=
        geometry::tetra_volume(mesh.nodes[at(c[0])], mesh.nodes[at(c[1])], mesh.nodes[at(c[2])], mesh.nodes[at(c[3])]);
  }
  return std::cbrt(6 * std::sqrt(2.0) * volume / static_cast<double>(mesh.elements.size()));
}

constexpr std::size_t kMostLines = 16;
constexpr std::size_t kSlowest = 3;

/// Columns of the table of domains.
constexpr std::array<const char*, 8> kColumns{"elements", "joints",   "shared",   "cut faces",
                                              "proxies",  "gathered", "messages", "kB a step"};

std::array<double, 8> columns(const DomainLoad& load) {
  const auto number = [](auto n) { return static_cast<double>(n); };
  return {number(load.elements), number(load.joints),   number(load.shared),     number(load.cut_faces),
          number(load.held),     number(load.gathered), number(load.neighbours), 1e-3 * number(load.bytes())};
}

std::string table_line(const std::string& name, const std::array<double, 8>& values) {
  std::string text = fmt::format("  {:<10}", name);
  for (const double value : values) text += fmt::format(" {:>11.0f}", value);
  return text + "\n";
}

/// Least, mean and most of each column; the columns are apart from each other.
std::string extremes(const std::vector<DomainLoad>& domains) {
  std::array<double, 8> least = columns(domains.front()), most = least, sum{};
  for (const DomainLoad& load : domains) {
    const auto values = columns(load);
    for (std::size_t c = 0; c < values.size(); ++c) {
      least[c] = std::min(least[c], values[c]);
      most[c] = std::max(most[c], values[c]);
      sum[c] += values[c] / static_cast<double>(domains.size());
    }
  }
  return table_line("least", least) + table_line("mean", sum) + table_line("most", most);
}

std::string verdict(const Division& division) {
  const DomainReport& report = division.report;
  return fmt::format("{} domains, {}: imbalance {:.3f}, pairwise exchanges in {} steps, predicted efficiency {:.1f} %",
                     report.domains.size(), division.how, report.imbalance, report.exchange_steps,
                     100 * report.efficiency);
}

std::vector<double> longest_edges(const Mesh& mesh) {
  std::vector<double> lengths;
  for (Index e = 0; e < mesh.num_elements(); ++e)
    lengths.push_back(geometry::longest_edge(geometry::corners_of(mesh, e)));
  return lengths;
}

std::vector<std::array<GlobalId, 4>> vertices_of(const Mesh& mesh) {
  std::vector<std::array<GlobalId, 4>> vertices;
  for (const auto& c : mesh.elements) vertices.push_back({c[0], c[1], c[2], c[3]});
  return vertices;
}

}  // namespace

RunEstimate estimate_run(const Subject& subject, const StepReport& step) {
  const case_::Case& input = subject.input();
  const Model& model = subject.model();
  const double end = input.stages.back().end - subject.begun();
  RunEstimate estimate;
  estimate.steps = subject.steps();
  estimate.seconds = estimate.steps * seconds_a_step(input, model, kShort * std::min(step.dt, step.limit), false);
  estimate.most_seconds = estimate.seconds;
  estimate.breaks = std::any_of(model.joint_laws.begin(), model.joint_laws.end(),
                                [](const JointLawParams& law) { return law.breakable(); });
  const double dt = input.time.step > 0 ? step.dt : std::min(step.dt, input.time.safety * step.broken);
  estimate.meets = !estimate.breaks && dt < 0.99 * step.dt;
  if (estimate.breaks || estimate.meets) {
    const double most =
        std::ceil(end / dt) * seconds_a_step(input, model, kShort * std::min(dt, step.limit), estimate.breaks);
    estimate.most_seconds = std::max(most, estimate.seconds);
  }
  estimate.likely_seconds = 0.5 * (estimate.seconds + estimate.most_seconds);
  estimate.memory = max_resident_bytes();
  estimate.frames = subject.frames();
  return estimate;
}

Division divide_model(const case_::Case& input, const Model& model, int parts) {
  const Mesh& mesh = model.mesh;
  std::vector<Vec3> centroids;
  centroids.reserve(mesh.elements.size());
  for (const auto& c : mesh.elements) {
    Vec3 sum = Vec3::Zero();
    for (const Index node : c) sum += mesh.nodes[at(node)];
    centroids.emplace_back(0.25 * sum);
  }
  std::vector<std::array<Index, 4>> neighbours;
  for (const auto& links : model.topology.links) {
    neighbours.push_back({links[0].neighbour, links[1].neighbour, links[2].neighbour, links[3].neighbour});
  }
  const Communicator alone;
  const std::vector<double> lengths = longest_edges(mesh);
  const Sizes sizes = sizes_of_all(alone, lengths);
  const double buffer = model.has_contact ? largest_buffer(input.detection.buffer, mean_size(mesh)) : 0.0;
  const Reach reach = reach_of(input, sizes.mean, buffer);
  const DomainSpec spec = settled(alone, domain_spec(input), parts, centroids, sizes.largest);
  const std::vector<double> weight(centroids.size(), 1.0);
  const double share = static_cast<double>(centroids.size()) / parts;
  const std::vector<Vec3> places = places_of_fragments(centroids, neighbours, share, reach.distance(sizes.mean));
  const std::vector<int> owner = assign_domains(alone, spec, parts, places, weight, sizes.largest);
  std::vector<Index> sets;
  sets.reserve(model.discretisation.size());
  for (Index group = 0; group < static_cast<Index>(model.discretisation.size()); ++group)
    sets.push_back(node_set(model.discretisation, model.whole.node_sets, group));
  return {spec.kind == DomainKind::rcb ? "rcb" : fmt::format("grid of {} x {} x {}", spec.n[0], spec.n[1], spec.n[2]),
          report_domains(mesh, model.topology, sets, owner, parts, distances(alone, vertices_of(mesh), lengths, reach)),
          owner};
}

std::string domain_line(const case_::Case& input, const Model& model, int parts) {
  return verdict(divide_model(input, model, parts)) + "\n";
}

const char* word_for(Index count, const char* one, const char* many) { return count == 1 ? one : many; }

std::string domain_table(const case_::Case& input, const Model& model, int parts) {
  const Division division = divide_model(input, model, parts);
  const std::vector<DomainLoad>& domains = division.report.domains;
  std::string text =
      fmt::format("{}\n{} {}, {}\n  {:<10}", printable(input.title), model.mesh.num_elements(),
                  word_for(model.mesh.num_elements(), "element", "elements"), verdict(division), "domain");
  for (const char* column : kColumns) text += fmt::format(" {:>11}", column);
  text += "\n";
  std::vector<std::size_t> shown(domains.size());
  std::iota(shown.begin(), shown.end(), std::size_t{0});
  if (domains.size() > kMostLines) {
    text += extremes(domains) + "  the slowest\n";
    std::partial_sort(shown.begin(), shown.begin() + kSlowest, shown.end(), [&](std::size_t a, std::size_t b) {
      return domains[a].step != domains[b].step ? domains[a].step > domains[b].step : a < b;
    });
    shown.resize(kSlowest);
  }
  for (const std::size_t d : shown) text += table_line(std::to_string(d), columns(domains[d]));
  const auto empty =
      std::count_if(domains.begin(), domains.end(), [](const DomainLoad& load) { return load.elements == 0; });
  if (empty > 0) {
    text += fmt::format(
        "- {} domains hold no element and their ranks have nothing to do: use domains.kind = \"rcb\".\n", empty);
  }
  if (model.has_contact) {
    text +=
        "- Contact is not included: a rank also gathers and searches elements near to its own, which depends on the "
        "motion of the bodies.\n";
  }
  return text;
}

std::string mesh_report(const FinishedMesh& made, const QualityReport& q) {
  const MeshReport& r = made.report;
  std::string text = fmt::format("{}: {} {}, {} {}, {} {}\n", printable(made.mesh.source), r.elements,
                                 word_for(r.elements, "element", "elements"), r.nodes,
                                 word_for(r.nodes, "node", "nodes"), r.bodies, word_for(r.bodies, "body", "bodies"));
  const auto [lower, upper] = extent_of(made.mesh.nodes);
  const Vec3 size = upper - lower;
  text += fmt::format("  box           {:.4g} x {:.4g} x {:.4g} m, from ({:.4g}, {:.4g}, {:.4g})\n", size.x(), size.y(),
                      size.z(), lower.x(), lower.y(), lower.z());
  const GeometryFile kind = geometry_file(made.mesh.source);
  if (kind == GeometryFile::step) text += "  unit          the one that the file states, times mesh.scale\n";
  if (states_no_unit(kind)) text += "  unit          the file states none: a length of 1 is mesh.scale metres\n";
  for (const MeshReport::Group& g : r.volume_groups)
    text += fmt::format("  volume  {:<20} {:>9} {}\n", printable(g.name), g.count,
                        word_for(g.count, "element", "elements"));
  for (const MeshReport::Group& g : r.element_sets)
    text += fmt::format("  set     {:<20} {:>9} {}, without a material of its own\n", printable(g.name), g.count,
                        word_for(g.count, "element", "elements"));
  for (const MeshReport::Group& g : r.surface_groups)
    text += fmt::format("  surface {:<20} {:>9} {}\n", printable(g.name), g.count,
                        word_for(g.count, "triangle", "triangles"));
  for (const MeshReport::Group& g : r.node_groups)
    text += fmt::format("  nodes   {:<20} {:>9} on a curve or at a point\n", printable(g.name), g.count);
  const auto note = [&](Index count, const char* what) {
    if (count > 0) text += fmt::format("  {} {}\n", count, what);
  };
  note(r.inverted_repaired, "inverted elements turned round");
  note(r.orphan_nodes, "nodes of no element dropped");
  note(r.merged_nodes, "nodes merged with others near to them (mesh.merge_nodes)");
  note(r.split_nodes, "nodes added where volumes that are not glued touch");
  note(r.duplicate_nodes, "nodes coincide with others: volumes there are not joined");
  note(r.ungrouped_elements, "tetrahedra outside every physical volume left out");
  for (const std::string& group : r.empty_groups)
    text += fmt::format("  group   {:<20} without element or node, left out\n", printable(group));
  for (const std::string& one : r.notes) text += fmt::format("  note          {}\n", printable(one));
  text += fmt::format("  edge          median {:.4g} m, from {:.4g} to {:.4g} m\n", q.mean_edge.median, q.mean_edge.min,
                      q.mean_edge.max);
  text += fmt::format("  radius ratio  median {:.3f}, 1 % below {:.3f}, worst {:.3f} (1 is regular)\n",
                      q.radius_ratio.median, q.radius_ratio.p01, q.radius_ratio.min);
  text += fmt::format("  dihedral      {:.1f} to {:.1f} degrees\n", q.min_dihedral.min * 180 / std::numbers::pi,
                      q.max_dihedral.max * 180 / std::numbers::pi);
  text += "  worst elements (id in the source, radius ratio):";
  for (std::size_t i = 0; i < std::min<std::size_t>(5, q.worst.size()); ++i) {
    text += fmt::format(" {} {:.3f}{}", made.mesh.element_source_id[at(q.worst[i].element)],
                        q.worst[i].quality.radius_ratio, i < 4 ? "," : "");
  }
  return text + "\n";
}

CheckReport full_report(const Subject& subject, const std::string& from) {
  const case_::Case& input = subject.input();
  const Model& model = subject.model();
  refuse_contradictions(input, model);
  refuse_what_cannot_break(input, joints_on(model, surfaces_to_break(input)));
  CheckReport report;
  report.text = fmt::format("{}\n", printable(input.title));
  if (!from.empty())
    report.text += fmt::format(
        "starts from {}; mesh, joints, contact and step are reported for the model at rest, before that run\n", from);
  report.text += mesh_report({model.mesh, model.mesh_report}, assess_quality(model.mesh));
  report.text += fmt::format("joints: {}\n", model.joints.size());
  report.text += joint_report(model, subject.joints()) + stiffness_report(model) +
                 separation_report(input, model.mesh.volume_groups) + overlap_report(subject) + data_report(input);
  report.step = step_report(input, model, subject.step());
  report.estimate = estimate_run(subject, report.step);
  report.text += report.step.text + run_time(model, report.step, report.estimate, input.stages.back().end) +
                 frames_line(report.estimate.frames) +
                 insitu_report(input, model.mesh, subject.begun(), report.estimate.steps);
  report.advice = advise(subject);
  return report;
}

std::string advice_list(const std::vector<Advice>& advice, std::size_t most) {
  if (advice.empty()) return "nothing to advise\n";
  std::string text = "advice\n";
  const std::size_t shown = std::min(most, advice.size());
  for (std::size_t i = 0; i < shown; ++i) text += fmt::format("- {} [{}]\n", advice[i].text, advice[i].rule->name);
  if (shown < advice.size()) text += fmt::format("{} more: check --all shows them\n", advice.size() - shown);
  return text;
}

}  // namespace breccia
