#pragma once

#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"

namespace breccia::case_ {

/// What is wrong with [insitu]: names of pipelines, channels, fields and probes, boxes, the address of a live view.
[[nodiscard]] std::vector<Problem> validate_insitu(const Case& c);

}  // namespace breccia::case_
