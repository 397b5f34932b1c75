#include "output/folder/race_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/quantity_text.hpp"

namespace breccia {
namespace {

constexpr int kShareWidth = 24;

double seconds_to_go(const RaceStatus& status) {
  return status.share > 0 ? status.wall_s * (1.0 - status.share) / status.share : -1.0;
}

std::string log_text(const RaceStatus& status) {
  return fmt::format("{:5.1f} %  {}  {} to go", 100 * status.share, status.doing, duration_text(seconds_to_go(status)));
}

std::string json_text(const RaceStatus& status) {
  nlohmann::ordered_json json;
  json["state"] = "running";
  json["doing"] = status.doing;
  json["share"] = status.share;
  json["wall_s"] = status.wall_s;
  json["eta_s"] = nullptr;
  if (status.share > 0) json["eta_s"] = seconds_to_go(status);
  return json.dump();
}

}  // namespace

RaceProgress::RaceProgress(ProgressMode mode, std::ostream& stream, int columns)
    : mode_(mode), stream_(stream), columns_(columns), pace_(interval_of(mode)) {}

void RaceProgress::show(const RaceStatus& status) {
  pace_.done();
  switch (mode_) {
    case ProgressMode::none:
      return;
    case ProgressMode::bar: {
      const int filled = static_cast<int>(std::clamp(status.share, 0.0, 1.0) * kShareWidth);
      std::string text = fmt::format("[{:#<{}}{:.<{}}] {}", "", filled, "", kShareWidth - filled, log_text(status));
      // A line as long as the terminal would wrap, and a wrapped line cannot be redrawn.
      text.resize(std::min(text.size(), static_cast<std::size_t>(std::max(columns_ - 1, 1))));
      stream_ << "\r\033[K" << text << std::flush;
      on_line_ = true;
      return;
    }
    case ProgressMode::log:
      stream_ << log_text(status) << '\n' << std::flush;
      return;
    case ProgressMode::json:
      stream_ << json_text(status) << '\n' << std::flush;
      return;
  }
}

void RaceProgress::finish() {
  if (on_line_) stream_ << "\r\033[K" << std::flush;
  on_line_ = false;
}

}  // namespace breccia
