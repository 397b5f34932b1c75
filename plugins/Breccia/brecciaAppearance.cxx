#include "brecciaAppearance.h"

#include <string>

#include "vtkSMSettings.h"

namespace {

constexpr double kPriority = 0.5;  // below that of a site's settings (1.5) and the user's

/// How an array is shown; a null preset is ParaView's own.
struct Appearance {
  const char *array, *title, *preset;
};

constexpr const char kStress[] = "Viridis (matplotlib)";
constexpr const char kTime[] = "Plasma (matplotlib)";
constexpr const char kSize[] = "Viridis (matplotlib)";
constexpr const char kForce[] = "Inferno (matplotlib)";

constexpr Appearance kAppearances[] = {
    // elements
    {"von_mises", "von Mises stress [Pa]", kStress},
    {"stress", "stress [Pa]", kStress},
    {"principal", "principal stress [Pa]", kStress},
    {"velocity", "velocity [m/s]", kStress},
    {"displacement", "displacement [m]", kStress},
    {"mass", "mass [kg]", kSize},
    {"cost", "cost over that of a plain element", nullptr},
    {"fragment_mass", "fragment mass [kg]", kSize},
    {"fragment_diameter", "fragment diameter [m]", kSize},
    {"fragment_speed", "fragment speed [m/s]", kSize},
    // joints
    {"damage", "damage", kTime},
    {"opening", "opening [m]", kSize},
    {"time_of_failure", "time of failure [s]", kTime},
    {"slip", "slip [m]", kSize},
    {"area", "area [m2]", kSize},
    {"strike", "strike [degrees]", nullptr},
    {"dip", "dip [degrees]", nullptr},
    {"dip_direction", "dip direction [degrees]", nullptr},
    // events
    {"scalar_moment", "scalar moment [N m]", kSize},
    {"energy_magnitude", "magnitude of the energy", kSize},
    {"isotropic_part", "isotropic part", nullptr},
    {"double_couple_part", "double-couple part", nullptr},
    {"clvd_part", "vector-dipole part", nullptr},
    {"time", "time [s]", kTime},
    {"energy", "energy [J]", kTime},
    // contacts
    {"force", "contact force [N]", kForce},
    {"normal_force", "normal force [N]", kForce},
    {"tangential_force", "tangential force [N]", kForce},
    {"slip_velocity", "slip velocity [m/s]", kForce},
    // ranks
    {"load", "cost over the mean", nullptr},
};

/// Ranges grow with the values of later frames (vtkSMTransferFunctionManager: GROW_ON_APPLY_AND_TIMESTEP).
constexpr const char kGrowing[] = R"("PVLookupTable": {"AutomaticRescaleRangeMode": 1})";

/// Arrays of kinds: what each value means and its colour.
constexpr const char kKinds[] = R"(
  "mode": {"Title": "mode of failure", "PVLookupTable": {"IndexedLookup": 1,
    "Annotations": ["0", "none", "1", "mode I", "2", "mode II", "3", "mixed"],
    "IndexedColors": [0.75, 0.75, 0.75, 0.12, 0.47, 0.71, 0.84, 0.15, 0.16, 0.58, 0.40, 0.74]}},
  "state": {"Title": "state of the joint", "PVLookupTable": {"IndexedLookup": 1,
    "Annotations": ["0", "elastic", "1", "softening", "2", "failed, closed", "3", "apart"],
    "IndexedColors": [0.75, 0.75, 0.75, 1.0, 0.73, 0.47, 0.84, 0.15, 0.16, 0.35, 0.05, 0.05]}})";

}  // namespace

void brecciaSetAppearance() {
  std::string tables, presets;
  for (const Appearance& one : kAppearances) {
    tables += "\"" + std::string(one.array) + "\": {\"Title\": \"" + one.title + "\", " + kGrowing + "},\n";
    if (one.preset)
      presets += (presets.empty() ? "\"" : ",\n\"") + std::string(one.array) + "\": \"" + one.preset + "\"";
  }
  vtkSMSettings::GetInstance()->AddCollectionFromString(
      "{\"array_lookup_tables\": {" + tables + kKinds + "}, \"standard_presets\": {" + presets + "}}", kPriority);
}
