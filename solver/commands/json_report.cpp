#include "commands/json_report.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/extent.hpp"
#include "base/geometry_file.hpp"
#include "case/schema.hpp"
#include "commands/check_report.hpp"
#include "commands/joint_curves.hpp"
#include "mesh/geo_scan.hpp"

namespace breccia {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json groups(const MeshReport& report) {
  const auto list = [](const std::vector<MeshReport::Group>& from) {
    Json out = Json::array();
    for (const MeshReport::Group& group : from) out.push_back({{"name", group.name}, {"count", group.count}});
    return out;
  };
  return {{"volumes", list(report.volume_groups)},
          {"surfaces", list(report.surface_groups)},
          {"curves_and_points", list(report.node_groups)},
          {"sets", list(report.element_sets)}};
}

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

const char* name_of(case_::ValueType type) {
  using enum case_::ValueType;
  switch (type) {
    case section:
      return "section";
    case section_list:
      return "section_list";
    case notation:
      return "notation";
    case number:
      return "number";
    case integer:
      return "integer";
    case boolean:
      return "boolean";
    case text:
      return "text";
    case text_or_list:
      return "text_or_list";
    case choice:
      return "choice";
    case path:
      return "path";
    case column:
      return "column";
    case axes:
      return "axes";
    case text_list:
      return "text_list";
    case text_pair:
      return "text_pair";
    case number_pair:
      return "number_pair";
    case vector:
      return "vector";
    case vector_or_number:
      return "vector_or_number";
    case integers_or_one:
      return "integers_or_one";
    case function:
      return "function";
    case function_vector:
      return "function_vector";
    case axis_functions:
      return "axis_functions";
    case parameters:
      return "parameters";
    case settings:
      return "settings";
    case points:
      break;
  }
  return "points";
}

}  // namespace

std::string check_json(const Subject& subject, const CheckReport& report) {
  const case_::Case& input = subject.input();
  const Model& model = subject.model();
  Json advice = Json::array();
  for (const Advice& one : report.advice)
    advice.push_back(
        {{"rule", one.rule->name}, {"level", name_of(one.rule->level)}, {"key", one.rule->key}, {"text", one.text}});
  Json json{{"title", input.title},
            {"elements", model.mesh.num_elements()},
            {"nodes", model.mesh_report.nodes},
            {"bodies", model.mesh_report.bodies},
            {"joints", model.joints.size()},
            {"groups", groups(model.mesh_report)},
            {"end", input.stages.back().end},
            {"stable_step", number_or_null(report.step.limit)},
            {"step", number_or_null(report.step.dt)},
            {"steps", number_or_null(report.estimate.steps)},
            {"seconds", number_or_null(report.estimate.seconds)},
            {"likely_seconds", number_or_null(report.estimate.likely_seconds)},
            {"most_seconds", number_or_null(report.estimate.most_seconds)},
            {"memory", report.estimate.memory},
            {"frames", report.estimate.frames.frames},
            {"disk", report.estimate.frames.disk},
            {"advice", std::move(advice)},
            {"report", report.text}};
  return text_of(json);
}

std::string domains_json(const case_::Case& input, const Model& model, int parts) {
  const Division division = divide_model(input, model, parts);
  Json domains = Json::array();
  for (const DomainLoad& load : division.report.domains) {
    domains.push_back({{"elements", load.elements},
                       {"joints", load.joints},
                       {"shared", load.shared},
                       {"cut_faces", load.cut_faces},
                       {"proxies", load.held},
                       {"gathered", load.gathered},
                       {"neighbours", load.neighbours},
                       {"bytes", load.bytes()},
                       {"seconds_a_step", load.step}});
  }
  return text_of({{"title", input.title},
                  {"elements", model.mesh.num_elements()},
                  {"how", division.how},
                  {"imbalance", division.report.imbalance},
                  {"efficiency", division.report.efficiency},
                  {"domains", domains},
                  {"owner", division.owner}});
}

std::string joints_json(const Model& model) {
  const auto curve = [](const JointCurve& c) {
    return Json{{"opening", c.opening}, {"traction", c.traction}, {"peak", c.peak}, {"energy", c.energy}};
  };
  Json laws = Json::array();
  for (const JointLawCurves& law : joint_curves(model)) {
    laws.push_back({{"name", law.name},
                    {"key", law.key},
                    {"size", law.size},
                    {"stiffness", law.stiffness},
                    {"normal", curve(law.normal)},
                    {"shear", curve(law.shear)},
                    {"unloading", curve(law.unloading)},
                    {"envelope", {{"normal", law.envelope_normal}, {"shear", law.envelope_shear}}}});
  }
  return text_of({{"laws", laws}});
}

std::string mesh_json(const FinishedMesh& made, const std::vector<std::vector<Topology::Face>>* faces) {
  const MeshReport& r = made.report;
  const auto [lower, upper] = extent_of(made.mesh.nodes);
  const QualityReport quality = assess_quality(made.mesh);
  Json json{{"source", made.mesh.source},
            {"elements", r.elements},
            {"nodes", r.nodes},
            {"bodies", r.bodies},
            {"box",
             {{"lower", Json(std::array{lower.x(), lower.y(), lower.z()})},
              {"upper", Json(std::array{upper.x(), upper.y(), upper.z()})}}},
            {"groups", groups(r)},
            {"inverted_repaired", r.inverted_repaired},
            {"duplicate_nodes", r.duplicate_nodes},
            {"merged_nodes", r.merged_nodes},
            {"quality", quality.ratio_bins},
            {"report", mesh_report(made, quality)}};
  if (faces == nullptr) return text_of(json);
  json["faces"] = Json::array();  // in the order of groups.surfaces
  for (const std::vector<Topology::Face>& group : *faces) {
    Json numbers = Json::array();
    for (const Topology::Face& face : group) numbers.push_back(4 * std::int64_t{face.element} + face.face);
    json["faces"].push_back(std::move(numbers));
  }
  json["places"] = Json::array();  // in the order of groups.curves_and_points
  for (std::size_t g = 0; g < r.node_groups.size(); ++g) json["places"].push_back(Json::array());
  for (const Mesh::GroupNode& one : made.mesh.group_nodes) {
    const Vec3& x = made.mesh.nodes[static_cast<std::size_t>(one.node)];
    json["places"][static_cast<std::size_t>(one.group)].push_back(std::array{x.x(), x.y(), x.z()});
  }
  return text_of(json);
}

std::string parameters_json(const std::filesystem::path& geometry) {
  Json rows = Json::array();
  if (geometry_file(geometry) == GeometryFile::script) {
    for (const GeoParameter& parameter : scan_geo(geometry).parameters) {
      Json names = Json::array();
      for (const std::string& name : {parameter.name, parameter.label})
        if (!name.empty()) names.push_back(name);
      rows.push_back({{"names", std::move(names)}, {"default", parameter.value}, {"words", parameter.words}});
    }
  }
  return text_of(Json{{"parameters", std::move(rows)}});
}

std::string schema_json() {
  Json keys = Json::array();
  for (const case_::Key& key : case_::schema()) {
    Json row{{"path", key.path}, {"type", name_of(key.type)}};
    row["level"] = case_::level_of(key) == case_::Level::basic ? "basic" : "expert";
    if (!key.is_section()) row["unit"] = key.unit;
    if (!key.fallback.empty()) row["default"] = key.fallback;
    row["required"] = key.required;
    if (key.range.limited()) {
      row["lower"] = number_or_null(key.range.lower);
      row["upper"] = number_or_null(key.range.upper);
      row["lower_open"] = key.range.lower_open;
      row["upper_open"] = key.range.upper_open;
    }
    if (!key.choices.empty()) row["choices"] = key.choice_list();
    if (!key.word.empty()) row["word"] = key.word;
    row["help"] = key.help;
    if (std::string rule = case_::start_rule(key); !rule.empty()) row["start"] = std::move(rule);
    if (!key.example.empty()) row["example"] = key.example;
    row["allowed"] = case_::allowed_text(key);
    keys.push_back(std::move(row));
  }
  return text_of({{"keys", keys}});
}

int or_problems(const std::function<int()>& work) {
  try {
    return work();
  } catch (const InputError& error) {
    Json problems = Json::array();
    for (const Problem& p : error.problems()) {
      problems.push_back({{"file", p.file},
                          {"line", p.line},
                          {"key", p.key},
                          {"what", p.what},
                          {"allowed", p.allowed},
                          {"given", p.given},
                          {"text", p.text()}});
    }
    fmt::print("{}", text_of({{"problems", problems}}));
    return static_cast<int>(ExitCode::input);
  }
}

}  // namespace breccia
