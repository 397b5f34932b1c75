#pragma once

#include <cstdint>
#include <string>

namespace breccia::case_ {

/// The number of a gauge "body N", as frames count bodies; -1 for other names.
[[nodiscard]] std::int64_t numbered_body(const std::string& name);

}  // namespace breccia::case_
