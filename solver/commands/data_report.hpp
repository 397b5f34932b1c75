#pragma once

#include <string>

#include "case/case.hpp"
#include "commands/advice.hpp"

/// What `check` reports of the files from which functions of time are read.
namespace breccia {

/// A line for each function and file: its points, times and values.
[[nodiscard]] std::string data_report(const case_::Case& input);

/// Files that end before the stage that uses them, or of which the run uses next to nothing.
[[nodiscard]] Advice data_advice(const case_::Case& input);

}  // namespace breccia
