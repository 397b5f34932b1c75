#include "catalyst/plugin.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

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
}

Config& Config::add(const std::string& pipeline, std::uint32_t channels) {
  pipelines_.push_back({pipeline, channels, {}, {}, {}});
  return *this;
}

Config& Config::add(const std::string& pipeline, const std::vector<std::string>& names,
                    const std::vector<double>& values) {
  pipelines_.push_back({pipeline, 0, names, values, {}});
  return *this;
}

Config& Config::live(int port) {
  config_.live_port = port;
  return *this;
}

const BrecciaConfig& Config::get() {
  views_.clear();
  for (Pipeline& pipeline : pipelines_) {
    pipeline.pointers.clear();
    for (const std::string& name : pipeline.parameter_names) pipeline.pointers.push_back(name.c_str());
    views_.push_back({pipeline.name.c_str(), pipeline.channels, static_cast<std::int32_t>(pipeline.parameters.size()),
                      pipeline.pointers.data(), pipeline.parameters.data()});
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
