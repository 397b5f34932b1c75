#pragma once

#include <string>

#include "case/case.hpp"

namespace breccia {

/// A line for each function of time and file from which it is read: its points, times and values.
[[nodiscard]] std::string data_report(const case_::Case& input);

}  // namespace breccia
