#pragma once

namespace breccia::case_ {

/// Steps of a stage at most: beyond them a step is lost in the digits of the time.
inline constexpr double kMostSteps = 1e15;
/// The same in a message.
inline constexpr const char* kAtMostSteps = "at most 1e15 steps";

}  // namespace breccia::case_
