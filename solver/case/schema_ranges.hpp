#pragma once

#include <numbers>

#include "case/schema.hpp"

/// Ranges that several keys of the case have.
namespace breccia::case_::ranges {

inline constexpr Range positive{.lower = 0, .lower_open = true};
// Far beyond what any solid has, so that the time step neither vanishes nor loses its digits.
inline constexpr Range densities{.lower = 1e-6, .upper = 1e12};
inline constexpr Range stiffnesses{.lower = 0, .upper = 1e20, .lower_open = true};
inline constexpr Range viscosities{.lower = 0, .upper = 1e20};
inline constexpr Range areas{.lower = 0, .upper = 1e6, .lower_open = true};
inline constexpr Range durations{.lower = 0, .upper = 1e10, .lower_open = true};
inline constexpr Range not_negative{.lower = 0};
inline constexpr Range at_least_one{.lower = 1};
inline constexpr Range share{.lower = 0, .upper = 1};
inline constexpr Range positive_share{.lower = 0, .upper = 1, .lower_open = true};
inline constexpr Range angle{.lower = 0, .upper = std::numbers::pi / 2, .upper_open = true};
inline constexpr Range count{.lower = 1, .upper = 100000};
inline constexpr Range at_most_10000_points{.lower = 1, .upper = 10000};
inline constexpr Range points_of_line{.lower = 2, .upper = 1000};
inline constexpr Range at_most_100000{.lower = 0, .upper = 100000};
inline constexpr Range seed{.lower = 0, .upper = 9.2e18};
inline constexpr Range steps{.lower = 0, .upper = 9.2e18};

}  // namespace breccia::case_::ranges
