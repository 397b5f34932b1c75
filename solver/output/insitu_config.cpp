#include "output/insitu_config.hpp"

#include <algorithm>
#include <sstream>

#include "base/interruption.hpp"
#include "case/live_address.hpp"
#include "output/channels.hpp"
#include "output/control.hpp"
#include "output/run_folder.hpp"

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
    : insitu_(input.insitu), title_(input.title), folder_(folder.string()) {
  parameters_.reserve(insitu_.pipelines.size());
  for (const case_::Pipeline& pipeline : insitu_.pipelines) add(pipeline);
  if (insitu_.live) {
    const auto address = case_::host_and_port(insitu_.live->address);
    DEMAND(address.has_value(), insitu_.live->address);
    live_host_ = address->first;
    config_.live_port = address->second;
    pipelines_.push_back({"live", channel_mask(insitu_.live->channels), 0, nullptr, nullptr});
  }
  config_.abi_version = BRECCIA_INSITU_ABI_VERSION;
  config_.communicator = communicator.fortran_handle();
  config_.rank = communicator.rank();
  config_.size = communicator.size();
  config_.patience = 2 * input.domains.patience;
  config_.title = title_.c_str();
  config_.end = input.stages.empty() ? 0 : input.stages.back().end;
  config_.strength = strength_of(input);
  config_.folder = folder_.c_str();
  config_.live_host = live_host_.c_str();
  control_file = RunFolder{folder.parent_path()}.control();
  config_.run_ends = [] { return std::int32_t{interruption != 0 || stop_waits(control_file)}; };
  config_.num_pipelines = static_cast<std::int32_t>(pipelines_.size());
  config_.pipelines = pipelines_.data();
}

void InSituConfig::add(const case_::Pipeline& pipeline) {
  Parameters& p = parameters_.emplace_back();
  for (const auto& [name, value] : pipeline.parameters) {
    p.names.push_back(name.c_str());
    p.values.push_back(value);
  }
  pipelines_.push_back(
      {pipeline.name.c_str(), 0, static_cast<std::int32_t>(p.names.size()), p.names.data(), p.values.data()});
}

std::vector<Problem> insitu_problems(const std::filesystem::path& case_file, const std::string& lines) {
  std::vector<Problem> problems;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);)
    problems.push_back({case_file.string(), 0, "insitu", line, "", ""});
  return problems;
}

}  // namespace breccia
