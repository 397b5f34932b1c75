#pragma once

#include <vtkLookupTable.h>

#include <algorithm>
#include <array>

namespace breccia::gui {

/// Dark blue to yellow, of even steps in lightness.
inline constexpr std::array<std::array<double, 3>, 5> kRamp{{{0.267, 0.005, 0.329},
                                                             {0.231, 0.318, 0.545},
                                                             {0.129, 0.567, 0.551},
                                                             {0.369, 0.789, 0.383},
                                                             {0.993, 0.906, 0.144}}};

inline void fill_ramp(vtkLookupTable& table) {
  constexpr int kSteps = 128;
  table.SetNumberOfTableValues(kSteps);
  for (int i = 0; i < kSteps; ++i) {
    const double x = (kRamp.size() - 1.0) * i / (kSteps - 1);
    const auto k = std::min(static_cast<std::size_t>(x), kRamp.size() - 2);
    const double w = x - static_cast<double>(k);
    std::array<double, 3> c{};
    for (std::size_t a = 0; a < 3; ++a) c[a] = (1 - w) * kRamp[k][a] + w * kRamp[k + 1][a];
    table.SetTableValue(i, c[0], c[1], c[2]);
  }
  table.SetAnnotations(nullptr, nullptr);
  table.IndexedLookupOff();
}

}  // namespace breccia::gui
