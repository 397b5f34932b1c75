#include "output/insitu/insitu_config.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include "case/live_address.hpp"
#include "output/folder/control.hpp"
#include "output/folder/run_folder.hpp"
#include "output/insitu/channels.hpp"
#include "system/interruption.hpp"

namespace breccia {

namespace {

/// The run's file for commands; nothing reads it while a live view holds the run.
std::filesystem::path control_file;

/// Of the stress at which something breaks where nothing does: of Young's modulus.
constexpr double kPartOfYoung = 1e-4;

double strength_of(const case_::Case& input) {
  double strength = 0, young = 0;
  for (const case_::Joint& joint : input.joints) strength = std::max(strength, joint.tensile_strength);
  for (const case_::Material& material : input.materials) young = std::max(young, material.young);
  return strength > 0 ? strength : kPartOfYoung * young;
}

}  // namespace

InSituConfig::InSituConfig(const case_::Case& input, const std::filesystem::path& folder,
                           const Communicator& communicator)
    : insitu_(input.insitu), title_(input.title), folder_(folder.string()), run_(folder.parent_path().string()) {
  owned_.reserve(insitu_.pipelines.size() + 1);  // pointed into
  for (const case_::Pipeline& pipeline : insitu_.pipelines) add(pipeline);
  if (insitu_.live) add_live(*insitu_.live);
  config_.abi_version = BRECCIA_INSITU_ABI_VERSION;
  config_.communicator = communicator.fortran_handle();
  config_.rank = communicator.rank();
  config_.size = communicator.size();
  config_.patience = 2 * input.domains.patience;
  config_.title = title_.c_str();
  config_.end = input.stages.empty() ? 0 : input.stages.back().end;
  config_.strength = strength_of(input);
  config_.folder = folder_.c_str();
  config_.run = run_.c_str();
  config_.live_host = live_host_.c_str();
  control_file = RunFolder{folder.parent_path()}.control();
  config_.run_ends = [] { return std::int32_t{interruption != 0 || stop_waits(control_file)}; };
  config_.num_pipelines = static_cast<std::int32_t>(pipelines_.size());
  config_.pipelines = pipelines_.data();
}

void InSituConfig::add(const case_::Pipeline& pipeline) {
  Owned& own = owned_.emplace_back();
  for (const auto& [name, value] : pipeline.parameters) {
    own.parameters.push_back({name.c_str(), value.text ? value.text->c_str() : nullptr,
                              value.number.value_or(std::numeric_limits<double>::quiet_NaN())});
  }
  for (const case_::Probe& probe : pipeline.probes) {
    BrecciaProbe& made = own.probes.emplace_back(
        BrecciaProbe{probe.name.c_str(), {}, {}, {}, std::int32_t{probe.points}, std::int32_t{probe.rows}});
    Vec3::Map(made.at) = probe.at;
    Vec3::Map(made.along) = probe.along;
    Vec3::Map(made.across) = probe.across;
  }
  BrecciaPipeline made{};
  made.name = pipeline.name.c_str();
  made.num_parameters = static_cast<std::int32_t>(own.parameters.size());
  made.parameters = own.parameters.data();
  made.num_probes = static_cast<std::int32_t>(own.probes.size());
  made.probes = own.probes.data();
  select(made, own, pipeline.region, pipeline.fields);
  pipelines_.push_back(made);
}

void InSituConfig::add_live(const case_::Live& live) {
  const auto address = case_::host_and_port(live.address);
  DEMAND(address.has_value(), live.address);
  live_host_ = address->first;
  config_.live_port = address->second;
  BrecciaPipeline made{};
  made.name = "live";
  made.channels = channel_mask(live.channels);
  select(made, owned_.emplace_back(), live.region, live.fields);
  pipelines_.push_back(made);
}

void InSituConfig::select(BrecciaPipeline& made, Owned& owned, const std::optional<case_::Region>& region,
                          const std::vector<std::string>& fields) {
  if (region) {
    Vec3::Map(owned.region.data()) = region->lower;
    Vec3::Map(owned.region.data() + 3) = region->upper;
    made.region = owned.region.data();
  }
  for (const std::string& field : fields) owned.fields.push_back(field.c_str());
  made.num_fields = static_cast<std::int32_t>(owned.fields.size());
  made.fields = owned.fields.data();
}

std::vector<Problem> insitu_problems(const std::filesystem::path& case_file, const std::string& lines) {
  std::vector<Problem> problems;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);)
    problems.push_back({case_file.string(), 0, "insitu", line, "", ""});
  return problems;
}

}  // namespace breccia
