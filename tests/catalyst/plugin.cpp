#include "catalyst/plugin.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace breccia::test {

const BrecciaInsituApi& plugin() {
  static const BrecciaInsituApi* api = [] {
    void* library = dlopen(BRECCIA_PLUGIN, RTLD_NOW | RTLD_GLOBAL);
    if (library == nullptr) throw std::runtime_error(dlerror());
    const auto function = reinterpret_cast<decltype(&breccia_insitu_api)>(dlsym(library, "breccia_insitu_api"));
    if (function == nullptr) throw std::runtime_error(dlerror());
    return function();
  }();
  return *api;
}

Config::Config(std::string folder, int communicator, int rank, int size) : folder_(std::move(folder)) {
  config_.abi_version = BRECCIA_INSITU_ABI_VERSION;
  config_.communicator = communicator;
  config_.rank = rank;
  config_.size = size;
  config_.title = "synthetic";
  config_.end = 1e-3;
  config_.strength = 1e6;
  config_.live_host = "localhost";
  config_.run = "";
}

Config& Config::add(const std::string& pipeline, std::uint32_t channels) {
  pipelines_.emplace_back().name = pipeline;
  pipelines_.back().channels = channels;
  return *this;
}

Config& Config::add(const std::string& pipeline, const std::vector<std::string>& names,
                    const std::vector<double>& values) {
  add(pipeline);
  pipelines_.back().parameter_names = names;
  pipelines_.back().parameters = values;
  pipelines_.back().texts.resize(names.size());
  return *this;
}

Config& Config::text(const std::string& name, const std::string& text) {
  pipelines_.back().parameter_names.push_back(name);
  pipelines_.back().parameters.push_back(std::numeric_limits<double>::quiet_NaN());
  pipelines_.back().texts.push_back(text);
  return *this;
}

Config& Config::region(const std::array<double, 6>& corners) {
  pipelines_.back().region.assign(corners.begin(), corners.end());
  return *this;
}

Config& Config::fields(const std::vector<std::string>& fields) {
  pipelines_.back().fields = fields;
  return *this;
}

Config& Config::probe(const BrecciaProbe& probe) {
  pipelines_.back().probes.push_back(probe);
  return *this;
}

Config& Config::live(int port) {
  config_.live_port = port;
  return *this;
}

const BrecciaConfig& Config::get() {
  views_.clear();
  for (Pipeline& pipeline : pipelines_) {
    pipeline.parameter_views.clear();
    for (std::size_t i = 0; i < pipeline.parameters.size(); ++i) {
      const std::string& text = pipeline.texts[i];
      pipeline.parameter_views.push_back(
          {pipeline.parameter_names[i].c_str(), text.empty() ? nullptr : text.c_str(), pipeline.parameters[i]});
    }
    pipeline.field_views.clear();
    for (const std::string& field : pipeline.fields) pipeline.field_views.push_back(field.c_str());
    BrecciaPipeline view{};
    view.name = pipeline.name.c_str();
    view.channels = pipeline.channels;
    view.num_parameters = static_cast<std::int32_t>(pipeline.parameter_views.size());
    view.parameters = pipeline.parameter_views.data();
    view.region = pipeline.region.empty() ? nullptr : pipeline.region.data();
    view.num_fields = static_cast<std::int32_t>(pipeline.field_views.size());
    view.fields = pipeline.field_views.data();
    view.num_probes = static_cast<std::int32_t>(pipeline.probes.size());
    view.probes = pipeline.probes.data();
    views_.push_back(view);
  }
  config_.folder = folder_.c_str();
  config_.num_pipelines = static_cast<std::int32_t>(views_.size());
  config_.pipelines = views_.data();
  return config_;
}

Adaptor::Adaptor(const BrecciaConfig& config) {
  Text message;
  adaptor_ = plugin().open(&config, message.text, sizeof message.text);
  text = message.string();
  EXPECT_NE(adaptor_, nullptr) << text;
}

Adaptor::~Adaptor() {
  if (adaptor_ != nullptr) plugin().close(adaptor_, nullptr, 0);
}

std::int64_t Adaptor::execute(std::uint32_t pipelines, const BrecciaInstant& instant) {
  Text message;
  const std::int64_t failed =
      plugin().execute(adaptor_, pipelines, &instant, &requests, message.text, sizeof message.text);
  text = message.string();
  return failed;
}

}  // namespace breccia::test
