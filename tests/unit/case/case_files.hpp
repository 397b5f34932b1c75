#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/reader.hpp"
#include "support/replaced.hpp"

namespace breccia::case_ {

using test::replaced;

/// A folder for one test, removed with all it holds.
class CaseFolder {
 public:
  CaseFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name() + "." + std::to_string(getpid());
    for (char& c : name)
      if (c == '/') c = '_';
    path_ = std::filesystem::temp_directory_path() / ("breccia_" + name);
    std::filesystem::create_directories(path_);
  }
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;
  ~CaseFolder() { std::filesystem::remove_all(path_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline Case read_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const CaseFolder folder;
  folder.write("geometry.geo", "// empty\n");
  folder.write("mesh.msh", "");
  return read_case(folder.write("case.toml", text), overrides);
}

/// The message of the InputError that the text gives; empty if it reads well.
inline std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_text(text, overrides);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

/// The shortest case there is.
inline const std::string minimal = R"([mesh.raster]
cell_size = "10 mm"
[[material]]
group = "raster"
young = "75 GPa"
poisson = 0.2
density = 2456
joints = "none"
[[stage]]
end = "1 ms"
)";

/// A case that gives every key a value other than its default.
inline const std::string complete = R"(title = "Every key"
[mesh]
file = "geometry.geo"
parameters = { h = "2.5 mm", n = 3, "odd name" = 0.1 }
scale = 0.001
glue = true
inverted = "refuse"
[[material]]
group = "glass"
law = "green_st_venant"
young = "75 GPa"
poisson = 0.2
density = "2456 kg/m3"
viscosity = "3 Pa s"
[[material]]
group = "projectile"
young = "750 GPa"
poisson = 0.25
density = "7.8 g/cm3"
joints = "none"
[[material]]
group = "frame"
young = 2e11
poisson = 0.3
density = "7.8 t/m3"
joints = "unbreakable"
law = "drucker_prager"
friction_angle = "36 deg"
dilation_angle = "9 deg"
cohesion = "8 MPa"
hardening = "200 MPa"
tension_cutoff = "2 MPa"
cap_pressure = "150 MPa"
cap_hardening = "2 GPa"
[[joint]]
group = "glass"
law = "independent_peaks"
rise = "parabolic"
points = "mid_edge"
penalty = "26.6 GPa"
size = "20 mm"
tensile_strength = "10 MPa"
shear_strength = "20 MPa"
friction_angle = "30 deg"
energy_mode_1 = "10 J/m2"
energy_mode_2 = "30 N/m"
energy_counts = "softening_branch"
points_to_fail = 2
softening = { kind = "z_curve", a = 0.5, b = 1.9, c = 5 }
[[joint]]
between = ["glass", "frame"]
penalty_factor = 50
tensile_strength = "1 MPa"
energy_mode_1 = "1 J/m2"
friction = 0.5
softening = { kind = "exponential", exponent = 4 }
[[contact]]
between = ["*", "*"]
penalty = "7500 GPa"
plateau = "60 MPa"
unloading_exponent = 2
friction = 0.3
friction_delay = 20
tangential_ratio = 0.8
damping_ratio = 0.2
points_on = "both"
initial_overlap = "relax"
[contact_points]
per_face = 6
field = "tet_distance"
surfaces = ["slit", "top"]
[sphere]
centre = [0, 0, "1 m"]
radius = "2 m"
penalty = "400 MPa"
[joints]
broken = ["slit"]
[[initial_velocity]]
group = "projectile"
velocity = [0, "-3 m/s", 0]
random = ["1 m/s", "137 m/s"]
seed = 7
angular = [0, 0, "90 deg/s"]
[[stage]]
name = "impact"
end = "100 us"
gravity = [0, 0, { ramp = { from = 0, to = "-9.81 m/s2", start = "1 us", end = "2 us" } }]
mass_damping = "10 1/s"
local_damping = 0.5
broken = ["surface"]
[[stage.constraint]]
group = "support"
fixed = "xz"
[[stage.constraint]]
group = "grip"
velocity = { y = "-1 mm/s", z = { linear = "2 m/s2" } }
[[stage.constraint]]
group = "other"
displacement = { x = { table = [[0, 0], ["1 ms", "1 mm"]] } }
[[stage.pressure]]
surface = "slit"
value = {constant = "1 kPa", linear = "20 GPa/s", sine = {amplitude = "1 MPa", frequency = "10 Hz", phase = "90 deg"}}
[[stage]]
name = "rest"
end = "1 ms"
[time]
step = "20 ns"
safety = 0.5
max_steps = 2000
residual_limit = "1 %"
energy_gain_limit = "0.2 %"
[detection]
algorithm = "ms_slices"
buffer = "0.5 mm"
cell = "5 mm"
verify = true
[domains]
kind = "grid"
n = [2, 0, 1]
rebalance = false
margin = 2.5
[output]
frame_interval = "1 us"
history_interval = "100 ns"
elements = false
joints = false
contacts = false
gauges = ["support"]
[insitu]
run = ["stress"]
max_overhead = 0.1
on_error = "stop"
backend = "catalyst2"
[insitu.live]
address = "10.0.0.7:22333"
remote = true
interval = "500 ms"
channels = ["surface"]
max_overhead = 0.25
fields = ["von_mises", "rank"]
[insitu.live.region]
lower = [0, 0, "-1 mm"]
upper = ["10 mm", 0.5, 0]
[[insitu.pipeline]]
name = "fractures"
every_steps = 100
every_time = "2 us"
every_wall = "30 s"
every_broken = 50
first_break = true
strict = true
parameters = { width = 640, zoom = 1.5, upper = "30 MPa", title = "half open" }
fields = ["id", "opening"]
region = { lower = [0, 0, 0], upper = ["10 mm", 0.5, 1] }
[[insitu.pipeline]]
name = "probes"
[[insitu.pipeline.probe]]
name = "tip"
at = [0, 0, "1 mm"]
[[insitu.pipeline.probe]]
name = "across"
at = [0, 0, 0]
along = ["10 mm", 0, 0]
points = 11
across = [0, "20 mm", 0]
rows = 21
)";

}  // namespace breccia::case_
