#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// Numbers as people read them. Throw nothing but std::bad_alloc.
namespace breccia {

/// Three significant digits and a metric prefix: (1.2345e-5, "s") is "12.3 us", (0, "J") "0 J", (1.6e7,
/// "element-steps/s") "16 M element-steps/s" (a space before a unit that is a word). Values without a prefix, tiny or
/// huge, in exponent form.
[[nodiscard]] std::string quantity_text(double value, std::string_view unit);

/// "0.42 s", "37 s", "12 min 5 s", "3 h 4 min", "2 d 5 h"; "unknown" when negative or not finite.
[[nodiscard]] std::string duration_text(double seconds);

/// "1,234,567"
[[nodiscard]] std::string count_text(std::int64_t count);

}  // namespace breccia
