#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/raster_case.hpp"
#include "verification/recorder.hpp"

namespace breccia::test::plane_test {
namespace {

constexpr double kYoung = 30e9, kPoisson = 0.3, kThickness = 0.01, kHeight = 0.04, kLength = 0.08, kStrain = 1e-4;

/// A strip of 8 x 4 cubes of 10 mm, one across, drawn out along x and free to narrow along y.
std::string strip(const std::string& kind) {
  return raster_case({.group = "strip",
                      .cells = {8, 4, 1},
                      .young = kYoung,
                      .poisson = kPoisson,
                      .density = 2400,
                      .sections = "[plane]\nkind = \"" + kind + "\"\n",
                      .end = 2e-3}) +
         R"(mass_damping = "40000 1/s"
[[stage.constraint]]
group = "strip.x0"
fixed = "x"
[[stage.constraint]]
group = "strip.x1"
displacement = { x = { ramp = { to = "8 um", end = "1 ms" } } }
[output]
gauges = ["strip.x1", "strip.y0", "strip.y1", "strip.z0", "strip.z1"]
)";
}

constexpr double kTolerance = 1e-4;  // finite strain: of the order of the strain; what is left of vibrations

struct Drawn {
  double stress;    ///< Pa, along x
  double narrower;  ///< strain along y over that along x
  double thinner;   ///< the same along z
};

Drawn drawn(const std::string& kind) {
  const HistoryRow last = run_case_text(strip(kind)).rows.back();
  const auto& g = last.gauges;
  return {g[0].reaction[0] / (kHeight * kThickness), (g[2].displacement[1] - g[1].displacement[1]) / kHeight / kStrain,
          (g[4].displacement[2] - g[3].displacement[2]) / kThickness / kStrain};
}

TEST(Plane, StrainOfAStripInTensionHasTheModulusOfAPlateAndDoesNotThin) {
  const Drawn strip = drawn("strain");
  EXPECT_NEAR(strip.stress / (kStrain * kYoung / (1 - kPoisson * kPoisson)), 1.0, 3 * kTolerance);
  EXPECT_NEAR(strip.narrower / (-kPoisson / (1 - kPoisson)), 1.0, 3 * kTolerance);
  EXPECT_EQ(strip.thinner, 0.0);
}

TEST(Plane, StressOfAStripInTensionHasYoungsModulusAndThinsAsItNarrows) {
  const Drawn strip = drawn("stress");
  EXPECT_NEAR(strip.stress / (kStrain * kYoung), 1.0, 3 * kTolerance);
  EXPECT_NEAR(strip.narrower / -kPoisson, 1.0, 3 * kTolerance);
  EXPECT_NEAR(strip.thinner / -kPoisson, 1.0, 3 * kTolerance);
}

}  // namespace
}  // namespace breccia::test::plane_test
