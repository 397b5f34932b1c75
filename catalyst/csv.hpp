#pragma once

#include <cstdint>
#include <string>

namespace breccia::insitu {

/// A field of a line of CSV, in quotes where it needs them.
[[nodiscard]] std::string quoted(const std::string& field);

/// What of an earlier recording stays when one begins at `step`: nothing when its header differs; rows start with their
/// step. A last line that is not whole goes.
[[nodiscard]] std::string rows_before(const std::string& content, const std::string& header, std::int64_t step);

}  // namespace breccia::insitu
