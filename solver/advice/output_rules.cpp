#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "advice/rule_functions.hpp"
#include "base/quantity_text.hpp"

namespace breccia {

FramesEstimate estimate_frames(const case_::Case& input, const Model& model, double begun, double steps) {
  constexpr double kElementBytes = 170, kFrameBytes = 27000;  // measured on glass_impact, block_wall and hertz_impact
  const double end = input.stages.back().end - begun, interval = input.output.frame_interval;
  FramesEstimate estimate;
  estimate.frames = interval > 0 ? std::min(std::ceil(end / interval), steps) + 1 : 1;
  estimate.disk =
      estimate.frames * (kFrameBytes + (input.output.elements ? kElementBytes * model.mesh.num_elements() : 0));
  return estimate;
}

std::string many_frames(const FramesEstimate& estimate) {
  constexpr double kManyFrames = 2000, kManyBytes = 100e9;
  if (estimate.frames <= kManyFrames && estimate.disk <= kManyBytes) return {};
  return fmt::format("{:.0f} frames are many: a larger output.frame_interval saves disk and time.", estimate.frames);
}

Sentences long_interval(const case_::Case& input) {
  const double end = input.stages.back().end;
  Sentences advice;
  for (const auto& [name, interval, what] :
       {std::tuple{"output.frame_interval", input.output.frame_interval,
                   "only the first and the last frame are written"},
        {"output.history_interval", input.output.history_interval, "the history has a first and a last line alone"},
        {"checkpoint.interval", input.checkpoint.interval, "it makes no checkpoint"}}) {
    if (interval > end)
      advice.push_back(fmt::format("{} = {} is longer than the run of {}: {}.", name, quantity_text(interval, "s"),
                                   quantity_text(end, "s"), what));
  }
  return advice;
}

}  // namespace breccia
