// One run of a case with some of the rules of contact switched off, for the table of ablation.py.
//
//   bench_contact --rules                        the names of the rules, one a line
//   bench_contact CASE [--without NAME[,NAME]]   one line of JSON: status, steps, energies, seconds, history
//
// Writes no files. A run that fails is a result: its error is the status, and the exit code is 0.

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <exception>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "case/reader.hpp"
#include "model/model.hpp"
#include "simulation/run.hpp"

namespace {

using namespace breccia;
using nlohmann::json;

struct Rule {
  std::string_view name;
  void (*switch_off)(ContactParams& params);
};

/// What can be switched off.
constexpr auto kRules = std::to_array<Rule>({
    {"correction", [](ContactParams& params) { params.rules.correction = false; }},
    {"steep_correction", [](ContactParams& params) { params.rules.steep_correction = false; }},
    {"closing_pull", [](ContactParams& params) { params.rules.closing_pull = false; }},
    {"remembered_gain", [](ContactParams& params) { params.rules.remembered_gain = false; }},
    {"gradient_switch", [](ContactParams& params) { params.rules.gradient_switch = false; }},
    {"friction_lag", [](ContactParams& params) { params.rules.friction_lag_stages = 0; }},
    {"second_lag_stage", [](ContactParams& params) { params.rules.friction_lag_stages = 1; }},
    {"friction_age", [](ContactParams& params) { params.rules.friction_age = false; }},
    {"spring_turns", [](ContactParams& params) { params.rules.spring_turns = false; }},
    {"shares", [](ContactParams& params) { params.rules.shares = false; }},
    {"corner_normals", [](ContactParams& params) { params.rules.corner_normals = false; }},
    {"opening_push", [](ContactParams& params) { params.rules.opening_push = false; }},
    {"facing_sides", [](ContactParams& params) { params.rules.facing_sides = false; }},
    {"facing_face", [](ContactParams& params) { params.rules.facing_face = false; }},
    {"bridge_gaps", [](ContactParams& params) { params.rules.bridge_gaps = false; }},
    {"one_of_neighbours", [](ContactParams& params) { params.rules.one_of_neighbours = false; }},
    {"first_offset", [](ContactParams& params) { params.rules.first_offset = false; }},
});

/// CPU time of this process, s.
double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Keeps the history by columns.
class Record final : public Sink {
 public:
  void start(const RunStart& start) override {
    gauges_ = start.gauges;
    elements_ = start.elements;
  }
  void history(const HistoryRow& row) override {
    const EnergyBudget& e = row.energy;
    add("step", static_cast<double>(row.step));
    add("time", row.time);
    add("kinetic", e.kinetic);
    add("stored", e.elastic + e.joint_elastic + e.contact_stored);
    add("friction", e.contact_friction);
    add("dissipated", e.contact_dissipated);
    add("work", e.external_work);
    add("residual", e.residual);
    add("touching", static_cast<double>(row.contacts));
    add("couples", static_cast<double>(row.couples));
    for (std::size_t i = 0; i < row.gauges.size(); ++i) {
      const GaugeReading& gauge = row.gauges[i];
      add(gauges_[i], "force", gauge.contact_force);
      add(gauges_[i], "displacement", gauge.displacement);
      add(gauges_[i], "velocity", gauge.velocity);
      add(gauges_[i], "centre", gauge.centre);
      add(gauges_[i], "spin", gauge.spin);
    }
  }
  void finish(const Summary& summary) override { summary_ = summary; }

  [[nodiscard]] json text() const {
    json phases = json::object();
    for (const auto& [name, seconds] : summary_.phases) phases[name] = seconds;
    return {{"steps", summary_.steps},         {"elements", elements_}, {"broken", summary_.broken_joints},
            {"fragments", summary_.fragments}, {"phases", phases},      {"history", columns_}};
  }

 private:
  void add(const std::string& name, double value) { columns_[name].push_back(value); }
  void add(const std::string& gauge, const char* what, const Vec3& value) {
    for (int axis = 0; axis < 3; ++axis) add(gauge + ' ' + what + ' ' + "xyz"[axis], value[axis]);
  }

  std::vector<std::string> gauges_;
  std::map<std::string, std::vector<double>> columns_;
  std::int64_t elements_ = 0;
  Summary summary_;
};

/// Throws std::invalid_argument for a name that is none.
void switch_off(const std::string& names, ContactParams& params) {
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    const auto* rule = std::find_if(kRules.begin(), kRules.end(), [&](const Rule& r) { return r.name == name; });
    if (rule == kRules.end()) throw std::invalid_argument("no rule '" + name + "'");
    rule->switch_off(params);
  }
}

json run(const std::string& file, const std::string& without) {
  std::vector<std::unique_ptr<Sink>> sinks;
  sinks.push_back(std::make_unique<Record>());
  std::string status = "complete";
  double start = cpu_seconds();
  try {
    const case_::Case input = case_::read_case(file);
    auto model = std::make_unique<Model>(build_model(input));
    switch_off(without, model->contact);
    start = cpu_seconds();
    run_case(input, std::move(model), sinks);
  } catch (const std::exception& error) {
    status = error.what();
  }
  json result = static_cast<const Record&>(*sinks.front()).text();
  result["status"] = status;
  result["cpu"] = cpu_seconds() - start;
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 1 && words[0] == "--rules") {
    for (const Rule& rule : kRules) std::printf("%s\n", std::string(rule.name).c_str());
    return 0;
  }
  if (words.size() != 1 && (words.size() != 3 || words[1] != "--without")) {
    std::fprintf(stderr, "usage: bench_contact --rules | CASE [--without NAME[,NAME]]\n");
    return 1;
  }
  std::printf("%s\n", run(words[0], words.size() == 3 ? words[2] : "").dump().c_str());
  return 0;
}
