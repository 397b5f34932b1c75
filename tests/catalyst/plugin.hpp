#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "catalyst/insitu_abi.h"

namespace breccia::test {

/// The plug-in, opened as the solver opens it: Python's library first, for all to see, then the plug-in for us alone.
const BrecciaInsituApi& plugin();

/// A configuration and what it points to.
class Config {
 public:
  /// @param communicator of Fortran, -1: without MPI
  Config(std::string folder, int communicator, int rank, int size);
  Config& add(const std::string& pipeline, std::uint32_t channels = 0);
  Config& add(const std::string& pipeline, const std::vector<std::string>& names, const std::vector<double>& values);
  /// A text that reads as no quantity, of the last pipeline.
  Config& text(const std::string& name, const std::string& text);
  /// Of the last pipeline.
  Config& region(const std::array<double, 6>& corners);
  Config& fields(const std::vector<std::string>& fields);
  Config& probe(const BrecciaProbe& probe);
  Config& live(int port);
  /// Valid until the next call of a member.
  const BrecciaConfig& get();

 private:
  struct Pipeline {
    std::string name;
    std::uint32_t channels = 0;
    std::vector<std::string> parameter_names;
    std::vector<double> parameters;
    std::vector<std::string> texts;  ///< empty: it is a number
    std::vector<double> region;
    std::vector<std::string> fields;
    std::vector<BrecciaProbe> probes;
    std::vector<BrecciaParameter> parameter_views;
    std::vector<const char*> field_views;
  };
  std::string folder_;
  std::vector<Pipeline> pipelines_;
  std::vector<BrecciaPipeline> views_;
  BrecciaConfig config_{};
};

/// What a function of the plug-in wrote.
struct Text {
  char text[4096] = "not written";
  [[nodiscard]] std::string string() const { return text; }
};

/// An open adaptor.
class Adaptor {
 public:
  /// Fails the test when it does not open; then is_open() is false.
  explicit Adaptor(const BrecciaConfig& config);
  Adaptor(const Adaptor&) = delete;
  Adaptor& operator=(const Adaptor&) = delete;
  ~Adaptor();
  [[nodiscard]] bool is_open() const { return adaptor_ != nullptr; }
  std::uint32_t channels(int pipeline, std::int64_t step, double time) const {
    return plugin().channels(adaptor_, pipeline, step, time);
  }
  /// Executes and keeps text and requests.
  std::int64_t execute(std::uint32_t pipelines, const BrecciaInstant& instant);
  [[nodiscard]] std::string notices() const {
    Text lines;
    plugin().notices(adaptor_, lines.text, sizeof lines.text);
    return lines.string();
  }
  [[nodiscard]] std::int64_t bytes(int pipeline) const { return plugin().bytes_written(adaptor_, pipeline); }

  std::string text;
  BrecciaRequests requests{};

 private:
  void* adaptor_ = nullptr;
};

}  // namespace breccia::test
