#include "verification/recorder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

#include "case/reader.hpp"
#include "simulation/run.hpp"

namespace breccia::test {
namespace {

class Recorder final : public Sink {
 public:
  explicit Recorder(Recording& recording) : recording_(recording) {}
  void frame(const Frame& frame) override { recording_.frames.push_back(frame); }
  void history(const HistoryRow& row) override { recording_.rows.push_back(row); }
  void finish(const Summary& summary) override { recording_.summary = summary; }

 private:
  Recording& recording_;
};

Recording run(const case_::Case& input) {
  Recording recording;
  std::vector<std::unique_ptr<Sink>> sinks;
  sinks.push_back(std::make_unique<Recorder>(recording));
  run_case(input, std::make_unique<Model>(build_model(input)), sinks);
  return recording;
}

}  // namespace

double Recording::worst_residual() const {
  double worst = 0;
  for (const HistoryRow& row : rows) {
    if (std::isnan(row.energy.residual_relative)) return row.energy.residual_relative;
    worst = std::max(worst, row.energy.residual_relative);
  }
  return worst;
}

Recording run_case_file(const std::string& file, const std::vector<std::string>& overrides) {
  return run(case_::read_case(std::filesystem::path(BRECCIA_MESHES) / file, overrides));
}

Recording run_case_text(const std::string& text) {
  const auto file =
      std::filesystem::temp_directory_path() / ("breccia_verification_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << text;
  const case_::Case input = case_::read_case(file);
  std::filesystem::remove(file);
  return run(input);
}

}  // namespace breccia::test
