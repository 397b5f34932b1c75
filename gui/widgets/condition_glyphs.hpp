#pragma once

#include <array>
#include <vector>

#include "core/conditions.hpp"
#include "render/load_glyphs.hpp"

namespace breccia::gui {

/// Glyphs of a condition with their labels: each part of an initial velocity separately.
[[nodiscard]] std::vector<Load> glyphs_of(const Condition& row);

/// The direction that a case has upwards: against its gravity; without any, against what flies along -z; else y, as
/// plane models always have it.
[[nodiscard]] std::array<double, 3> up_of(const Document& document, const std::vector<Condition>& conditions);

}  // namespace breccia::gui
