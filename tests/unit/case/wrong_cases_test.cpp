#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case_files.hpp"

namespace breccia::case_ {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A change that makes the complete case wrong, and what the message must say.
struct Wrong {
  const char* name;
  const char* from;
  const char* to;
  std::vector<const char*> says;
};

class WrongCase : public testing::TestWithParam<Wrong> {};

// One change is one fault: a second message would lead the user astray.
TEST_P(WrongCase, IsRefusedWithOneMessageThatSaysWhy) {
  const std::string message = message_of(replaced(complete, GetParam().from, GetParam().to));
  for (const char* part : GetParam().says) EXPECT_THAT(message, HasSubstr(part));
  EXPECT_THAT(message, HasSubstr("case.toml:"));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Toml, WrongCase,
    testing::Values(Wrong{"syntax", "scale = 0.001", "scale = ", {"case.toml:5: not TOML"}},
                    Wrong{"unclosed_text", "\"Every key\"", "\"Every key", {"case.toml:1: not TOML"}},
                    Wrong{"key_twice", "scale = 0.001", "scale = 1\nscale = 2", {"case.toml:6: not TOML"}},
                    Wrong{"bare_quantity", "\"75 GPa\"", "75 GPa", {"case.toml:11: not TOML"}}),
    [](const auto& param_info) { return param_info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Keys, WrongCase,
    testing::Values(
        Wrong{"unknown_key", "scale = 0.001", "scael = 0.001", {"case.toml:5: mesh.scael: unknown key; did you mean \"scale\"?", "file, parameters"}},
        Wrong{"unknown_key_far", "scale = 0.001", "colour = 1", {"mesh.colour: unknown key; allowed: file"}},
        Wrong{"key_of_another_section", "scale = 0.001", "friction_angle = 1", {"did you mean \"joint[].friction_angle\"?"}},
        Wrong{"unknown_section", "[detection]\n", "[detecton]\n", {"detecton: unknown key; did you mean \"detection\"?"}},
        Wrong{"unknown_list", "[[initial_velocity]]", "[[initial_velocities]]", {"did you mean \"initial_velocity\"?"}},
        Wrong{"notation_as_section", "[time]\n", "[\"<function>\"]\nconstant = 1\n[time]\n", {"<function>: unknown key"}},
        Wrong{"section_not_repeated", "[[contact]]", "[contact]", {"contact: is a table; allowed: one or more tables, [[contact]]"}},
        Wrong{"section_repeated", "[sphere]", "[[sphere]]", {"sphere: is a list; allowed: a table, [sphere]"}},
        Wrong{"section_is_value", "[joints]\nbroken = [\"slit\"]", "[joints]\n[output.gauges]\nx = 1", {"not TOML"}},
        Wrong{"missing_key", "density = \"2456 kg/m3\"\n", "", {"case.toml:8: material[0].density: is missing; allowed: a number in kg/m3"}},
        Wrong{"missing_group", "group = \"projectile\"\nvel", "vel", {"initial_velocity[0].group: is missing; allowed: text"}},
        Wrong{"grid_of_bisection",
              "kind = \"grid\"\nn =",
              "kind = \"rcb\"\nn =",
              {"domains.n: belongs to a grid; allowed: domains.kind = \"grid\", or no n; given: [2, 0, 1]"}},
        Wrong{"grid_without_end", "n = [2, 0, 1]", "n = 100000", {"domains.n: is a grid of too many domains"}},
        Wrong{"grid_negative", "n = [2, 0, 1]", "n = [2, -1, 1]", {"domains.n", "is out of range"}},
        Wrong{"grid_of_two_axes", "n = [2, 0, 1]", "n = [2, 1]", {"domains.n"}},
        Wrong{"domains_of_no_kind", "kind = \"grid\"\nn = [2, 0, 1]", "kind = \"gird\"", {"domains.kind: ", "did you mean \"grid\"?"}},
        Wrong{"margin_too_small", "margin = 2.5", "margin = 0.01", {"domains.margin: is out of range"}},
        Wrong{"missing_end", "end = \"1 ms\"\n", "", {"stage[1].end: is missing"}},
        Wrong{"missing_radius", "radius = \"2 m\"\n", "", {"sphere.radius: is missing"}}),
    [](const auto& param_info) { return param_info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    InSitu, WrongCase,
    testing::Values(
        Wrong{"no_such_pipeline", "name = \"fractures\"", "name = \"fracture\"",
              {"insitu.pipeline[0].name: no pipeline has this name; allowed: fractures", "ends with .py"}},
        Wrong{"no_such_pipeline_in_the_list", "run = [\"stress\"]", "run = [\"stres\"]", {"insitu.run: no pipeline has this name; allowed: stress"}},
        Wrong{"missing_script", "name = \"fractures\"", "name = \"mine.py\"", {"insitu.pipeline[0].name: the script does not exist", "mine.py"}},
        Wrong{"negative_steps", "every_steps = 100", "every_steps = -1", {"insitu.pipeline[0].every_steps: is out of range"}},
        Wrong{"no_overhead", "max_overhead = 0.1", "max_overhead = 0", {"insitu.max_overhead: is out of range"}},
        Wrong{"unknown_way_with_errors", "on_error = \"stop\"", "on_error = \"stopp\"", {"insitu.on_error: ", "did you mean \"stop\"?"}},
        Wrong{"no_such_channel", "channels = [\"surface\"]", "channels = [\"skin\"]", {"insitu.live.channels: there is no such channel"}},
        Wrong{"no_channel", "channels = [\"surface\"]", "channels = []", {"insitu.live.channels: names no channel; allowed: "}},
        Wrong{"address_without_port", "10.0.0.7:22333", "10.0.0.7:", {"insitu.live.address: is no address; allowed: host:port"}},
        Wrong{"port_too_large", "10.0.0.7:22333", "10.0.0.7:70000", {"insitu.live.address: is no address"}},
        Wrong{"another_machine_by_accident", "remote = true", "remote = false",
              {"insitu.live.address: is on another machine; allowed: localhost, 127.0.0.1 or ::1, or insitu.live.remote = true"}},
        Wrong{"unknown_trigger", "every_steps = 100", "every_step = 100", {"insitu.pipeline[0].every_step: unknown key; did you mean \"every_steps\"?"}}),
    [](const auto& param_info) { return param_info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Types, WrongCase,
    testing::Values(
        Wrong{"number_is_boolean", "poisson = 0.2\n", "poisson = true\n", {"material[0].poisson: is true or false; allowed: a number"}},
        Wrong{"number_is_list", "poisson = 0.2\n", "poisson = [0.2]\n", {"is a list", "given: [0.2]"}},
        Wrong{"number_is_date", "poisson = 0.2\n", "poisson = 2020-01-01\n", {"is a date or time"}},
        Wrong{"number_is_nan", "poisson = 0.2\n", "poisson = nan\n", {"is not finite"}},
        Wrong{"number_is_word", "step = \"20 ns\"", "step = \"automatic\"", {"does not begin with a number", "or \"auto\""}},
        Wrong{"integer_is_number", "max_steps = 2000", "max_steps = 2000.5", {"time.max_steps: is a number; allowed: an integer"}},
        Wrong{"boolean_is_text", "verify = true", "verify = \"yes\"", {"detection.verify: is text; allowed: true or false"}},
        Wrong{"text_is_integer", "name = \"rest\"", "name = 2", {"stage[1].name: is an integer; allowed: text"}},
        Wrong{"text_is_empty", "surface = \"slit\"", "surface = \"\"", {"stage[0].pressure[0].surface: is empty"}},
        Wrong{"file_is_integer", "file = \"geometry.geo\"", "file = 3", {"mesh.file: is an integer; allowed: a file name"}},
        Wrong{"list_is_text", "gauges = [\"support\"]", "gauges = \"support\"", {"output.gauges: is text; allowed: a list of texts"}},
        Wrong{"list_of_integers", "gauges = [\"support\"]", "gauges = [3]", {"output.gauges[0]: is an integer"}},
        Wrong{"vector_of_two", "centre = [0, 0, \"1 m\"]", "centre = [0, 0]", {"sphere.centre: is a list of 2; allowed: a list of three"}},
        Wrong{"vector_is_number", "centre = [0, 0, \"1 m\"]", "centre = 1", {"sphere.centre: is an integer; allowed: a list of three"}},
        Wrong{"vector_of_texts", "centre = [0, 0, \"1 m\"]", "centre = [0, 0, \"up\"]", {"sphere.centre[2]: does not begin"}},
        Wrong{"pair_of_three", "between = [\"*\", \"*\"]", "between = [\"*\", \"*\", \"*\"]", {"contact[0].between", "a list of two texts"}},
        Wrong{"parameters_is_list", "parameters = { h = \"2.5 mm\", n = 3, \"odd name\" = 0.1 }", "parameters = [1]", {"mesh.parameters: is a list"}},
        Wrong{"parameter_is_boolean", "n = 3", "n = true", {"mesh.parameters.n: is true or false"}},
        Wrong{"parameter_of_unknown_unit", "n = 3", "n = \"3 foo\"", {"mesh.parameters.n: unknown unit \"foo\""}}),
    [](const auto& param_info) { return param_info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Units, WrongCase,
    testing::Values(Wrong{"wrong_dimension",
                          "\"2456 kg/m3\"",
                          "\"2456 kg\"",
                          {"is of dimension mass, not density", "g/cm3", "given: \"2456 kg\""}},
                    Wrong{"unknown_unit", "\"75 GPa\"", "\"75 Gpa\"", {"unknown unit \"Gpa\"; did you mean \"GPa\"?"}},
                    Wrong{"no_unit", "\"75 GPa\"", "\"75\"", {"material[0].young: the unit is missing"}},
                    Wrong{"angle_without_dimension", "friction_angle = \"30 deg\"", "friction_angle = \"30 m\"", {"length, not angle", "deg"}},
                    Wrong{"unit_of_linear",
                          "linear = \"20 GPa/s\"",
                          "linear = \"20 GPa\"",
                          {"stage[0].pressure[0].value.linear: is of dimension pressure, not pressure rate"}},
                    Wrong{"unit_in_vector",
                          "velocity = [0, \"-3 m/s\", 0]",
                          "velocity = [0, \"-3 m\", 0]",
                          {"initial_velocity[0].velocity[1]: is of dimension length, not velocity"}}),
    [](const auto& param_info) { return param_info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Ranges, WrongCase,
    testing::Values(
        Wrong{"negative_density", "\"2456 kg/m3\"", "-2456", {"material[0].density: is out of range", "> 0", "given: -2456"}},
        Wrong{"poisson_one_half", "poisson = 0.2\n", "poisson = 0.5\n", {"material[0].poisson: is out of range", "> -1 and < 0.5"}},
        Wrong{"poisson_minus_one", "poisson = 0.2\n", "poisson = -1\n", {"> -1 and < 0.5; given: -1"}},
        Wrong{"zero_young", "\"75 GPa\"", "0", {"material[0].young: is out of range"}},
        Wrong{"negative_viscosity", "\"3 Pa s\"", "\"-3 Pa s\"", {"material[0].viscosity: is out of range"}},
        Wrong{"exponent_below_one", "unloading_exponent = 2", "unloading_exponent = 0.5", {"contact[0].unloading_exponent", ">= 1"}},
        Wrong{"ratio_above_one", "tangential_ratio = 0.8", "tangential_ratio = 1.5", {">= 0 and <= 1"}},
        Wrong{"points_to_fail", "points_to_fail = 2", "points_to_fail = 4", {"joint[0].points_to_fail", ">= 1 and <= 3"}},
        Wrong{"per_face", "per_face = 6", "per_face = 2", {"contact_points.per_face", "one of 1, 3, 6", "given: 2"}},
        Wrong{"safety", "safety = 0.5", "safety = 1.5", {"time.safety", "> 0 and <= 1"}},
        Wrong{"local_damping", "local_damping = 0.5", "local_damping = 1", {"stage[0].local_damping", "< 1"}},
        Wrong{"max_steps", "max_steps = 2000", "max_steps = -1", {"time.max_steps: is out of range"}},
        Wrong{"friction_angle", "\"30 deg\"", "\"90 deg\"", {"joint[0].friction_angle: is out of range"}},
        Wrong{"friction_angle_in_degrees", "\"30 deg\"", "30", {"joint[0].friction_angle: is out of range; allowed: a number in rad"}},
        Wrong{"zero_step", "step = \"20 ns\"", "step = 0", {"time.step: is out of range", "or \"auto\""}},
        Wrong{"choice",
              "field = \"tet_distance\"",
              "field = \"tet_distanze\"",
              {"is none of the choices; did you mean \"tet_distance\"?", "body, tet_potential, tet_distance"}},
        Wrong{"choice_is_integer", "field = \"tet_distance\"", "field = 3", {"contact_points.field: is an integer; allowed: one of body"}},
        Wrong{"random_component",
              "random = [\"1 m/s\", \"137 m/s\"]",
              "random = [\"-1 m/s\", \"137 m/s\"]",
              {"initial_velocity[0].random[0]: is out of range"}}),
    [](const auto& param_info) { return param_info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Functions, WrongCase,
    testing::Values(Wrong{"unknown_part",
                          "constant = \"1 kPa\", ",
                          "offset = 1, ",
                          {"stage[0].pressure[0].value.offset: unknown key", "constant, linear, table"}},
                    Wrong{"part_misspelled", "linear = \"20 GPa/s\"", "liner = 3", {"value.liner: unknown key; did you mean \"linear\"?"}},
                    Wrong{"is_list",
                          "value = {constant = \"1 kPa\", linear = \"20 GPa/s\", sine = {amplitude = \"1 MPa\", "
                          "frequency = \"10 Hz\", phase = \"90 deg\"}}",
                          "value = [1]",
                          {"stage[0].pressure[0].value: is a list; allowed: a function of time"}},
                    Wrong{"sine_without_frequency", "frequency = \"10 Hz\", ", "", {"value.sine.frequency: is missing; allowed: a number in 1/s"}},
                    Wrong{"sine_of_unknown_key", "phase = \"90 deg\"", "shift = 1", {"value.sine.shift: unknown key"}},
                    Wrong{"sine_is_number",
                          "sine = {amplitude = \"1 MPa\", frequency = \"10 Hz\", phase = \"90 deg\"}",
                          "sine = 3",
                          {"value.sine: is an integer; allowed: a table of amplitude, frequency, phase"}},
                    Wrong{"ramp_backwards",
                          "start = \"1 us\", end = \"2 us\"",
                          "start = \"2 us\", end = \"1 us\"",
                          {"stage[0].gravity[2].ramp: does not end after its start"}},
                    Wrong{"ramp_without_end", ", end = \"2 us\"", "", {"stage[0].gravity[2].ramp.end: is missing"}},
                    Wrong{"table_times",
                          "[[0, 0], [\"1 ms\", \"1 mm\"]]",
                          "[[\"1 ms\", 0], [0, \"1 mm\"]]",
                          {"displacement.x.table[1]: its time is not later", "times increasing"}},
                    Wrong{"table_time_twice", "[[0, 0], [\"1 ms\", \"1 mm\"]]", "[[0, 0], [0, \"1 mm\"]]", {"its time is not later"}},
                    Wrong{"table_point", "[\"1 ms\", \"1 mm\"]", "[\"1 ms\"]", {"displacement.x.table[1]: is no point; allowed: [time, value]"}},
                    Wrong{"table_unit", "\"1 mm\"]]", "\"1 Pa\"]]", {"displacement.x.table[1][1]: is of dimension pressure, not length"}},
                    Wrong{"table_empty", "table = [[0, 0], [\"1 ms\", \"1 mm\"]]", "table = []", {"displacement.x.table: has no points"}},
                    Wrong{"empty_table", "x = { table = [[0, 0], [\"1 ms\", \"1 mm\"]] }", "x = {}", {"displacement.x: is an empty table"}}),
    [](const auto& param_info) { return param_info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Constraints, WrongCase,
    testing::Values(
        Wrong{"no_axis", "fixed = \"xz\"", "fixed = \"\"", {"stage[0].constraint[0].fixed: names no axis"}},
        Wrong{"unknown_axis", "fixed = \"xz\"", "fixed = \"xw\"", {"names no axis, or one twice", "given: \"xw\""}},
        Wrong{"axis_twice", "fixed = \"xz\"", "fixed = \"xx\"", {"names no axis, or one twice"}},
        Wrong{"no_kind", "fixed = \"xz\"\n", "", {"stage[0].constraint[0]: lacks a key; allowed: exactly one of fixed, velocity, displacement"}},
        Wrong{"two_kinds", "fixed = \"xz\"\n", "fixed = \"y\"\nvelocity = { x = 1 }\n", {"excludes another key", "given: fixed and velocity"}},
        Wrong{"velocity_without_axis",
              "velocity = { y = \"-1 mm/s\", z = { linear = \"2 m/s2\" } }",
              "velocity = {}",
              {"constraint[1].velocity: names no axis"}},
        Wrong{"velocity_of_wrong_axis", "z = { linear", "w = { linear", {"constraint[1].velocity.w: is no axis"}},
        Wrong{"velocity_is_number",
              "velocity = { y = \"-1 mm/s\", z = { linear = \"2 m/s2\" } }",
              "velocity = 3",
              {"constraint[1].velocity: is an integer; allowed: a table"}},
        Wrong{"group_twice", "group = \"grip\"", "group = \"support\"", {"constraint[1].group: the group is constrained already along z"}}),
    [](const auto& param_info) { return param_info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    AcrossKeys, WrongCase,
    testing::Values(
        Wrong{"mesh_file_absent", "geometry.geo", "geometri.geo", {"case.toml:3: mesh.file: the file does not exist", "geometri.geo"}},
        Wrong{"mesh_of_other_kind", "geometry.geo", "case.toml", {"mesh.file: is no file of gmsh"}},
        Wrong{"mesh_with_parameters", "geometry.geo", "mesh.msh", {"mesh.parameters: a finished mesh takes no parameters"}},
        Wrong{"mesh_twice", "[[material]]", "[mesh.raster]\ncell_size = 1\n[[material]]", {"mesh.raster: excludes another key"}},
        Wrong{"no_mesh", "file = \"geometry.geo\"\n", "", {"mesh: lacks a key; allowed: exactly one of file, raster"}},
        Wrong{"material_twice",
              "[[joint]]\n",
              "[[material]]\ngroup = \"glass\"\nyoung = 1\npoisson = 0\ndensity = 1\n[[joint]]\n",
              {"case.toml:28: material[3].group: the group has a material already"}},
        Wrong{"joint_without_material",
              "[[contact]]",
              "[[joint]]\ngroup = \"glas\"\n[[contact]]",
              {"joint[2].group: no [[material]] has the group \"glas\"; allowed: glass, "}},
        Wrong{"joint_without_group",
              "[[contact]]",
              "[[joint]]\nfriction = 1\n[[contact]]",
              {"joint[2]: lacks a key; allowed: exactly one of group, between"}},
        Wrong{"joint_of_two_penalties", "penalty = \"26.6 GPa\"", "penalty = 1\npenalty_factor = 1", {"given: penalty and penalty_factor"}},
        Wrong{"joint_of_two_frictions", "friction_angle = \"30 deg\"", "friction_angle = 0\nfriction = 1", {"given: friction and friction_angle"}},
        Wrong{"joint_without_strength",
              "tensile_strength = \"10 MPa\"\n",
              "",
              {"joint[0].tensile_strength: is missing: joints of \"glass\" can fail"}},
        Wrong{"joint_without_energy", "energy_mode_1 = \"10 J/m2\"\n", "", {"joint[0].energy_mode_1: is missing"}},
        Wrong{"joint_twice", "between = [\"glass\", \"frame\"]", "group = \"glass\"", {"joint[1].group: the joints have a law already"}},
        Wrong{"joint_of_group_without_joints",
              "[[contact]]",
              "[[joint]]\ngroup = \"projectile\"\n[[contact]]",
              {"joint[2].group: the group has no joints"}},
        Wrong{"interface_not_glued", "glue = true", "glue = false", {"joint[1].between: interfaces are not glued"}},
        Wrong{"z_curve", "kind = \"exponential\", a = 0.5, b = 1.9", "a = 0.5, b = 0.5", {"joint[0].softening: a + b of the z-curve is not above 1"}},
        Wrong{"contact_of_unknown_group",
              "between = [\"*\", \"*\"]",
              "between = [\"*\", \"*\"]\npenalty = 1\n[[contact]]\nbetween = [\"glass\", \"glue\"]",
              {"contact[1].between: no [[material]] has the group \"glue\""}},
        Wrong{"contact_twice",
              "between = [\"*\", \"*\"]",
              "between = [\"*\", \"*\"]\npenalty = 1\n[[contact]]\nbetween = [\"*\", \"*\"]",
              {"contact[1].between: the pair has a contact law already"}},
        Wrong{"contact_missing_for_fragments",
              "between = [\"*\", \"*\"]",
              "between = [\"projectile\", \"*\"]\npenalty = 1\n[[contact]]\nbetween = [\"frame\", \"*\"]",
              {"contact: no contact law covers \"glass\""}},
        Wrong{"initial_velocity_of_unknown_group",
              "group = \"projectile\"\nvelocity",
              "group = \"projectil\"\nvelocity",
              {"initial_velocity[0].group: no [[material]] has the group \"projectil\"; allowed: projectile, "}},
        Wrong{"random_backwards", "\"1 m/s\", \"137 m/s\"", "\"137 m/s\", \"1 m/s\"", {"initial_velocity[0].random: the greatest speed is below"}},
        Wrong{"stages_backwards", "end = \"1 ms\"", "end = \"1 us\"", {"stage[1].end: the stage does not end after the one before"}},
        Wrong{"stage_name_twice", "name = \"rest\"", "name = \"impact\"", {"stage[1].name: another stage has this name"}},
        Wrong{"gauge_twice", "gauges = [\"support\"]", "gauges = [\"support\", \"support\"]", {"output.gauges[1]: the gauge stands twice"}}),
    [](const auto& param_info) { return param_info.param.name; });

TEST(WrongCases, ABreakableGroupNeedsAJointLaw) {
  EXPECT_THAT(message_of(replaced(minimal, "joints = \"none\"\n", "")),
              AllOf(HasSubstr("case.toml:3: material[0].joints: the group is breakable but has no joint law"),
                    HasSubstr("[[joint]] with group = \"raster\"")));
}

TEST(WrongCases, ACaseNeedsMeshMaterialAndStage) {
  EXPECT_THAT(message_of(""),
              AllOf(HasSubstr("mesh: is missing"), HasSubstr("material: is missing"), HasSubstr("stage: is missing")));
}

TEST(WrongCases, AnEmptyListOfMaterialsIsMissing) {
  EXPECT_THAT(message_of("material = []\n[mesh.raster]\ncell_size = 1\n[[stage]]\nend = 1\n"),
              HasSubstr("material: is missing"));
}

TEST(WrongCases, ARasterHasItsOwnChecks) {
  const auto raster = [](const std::string& keys) {
    return message_of(replaced(minimal, "cell_size = \"10 mm\"", keys));
  };
  EXPECT_THAT(raster("cells = 1"), HasSubstr("mesh.raster.cell_size: is missing"));
  EXPECT_THAT(raster("cell_size = 0"), HasSubstr("mesh.raster.cell_size: is out of range"));
  EXPECT_THAT(raster("cell_size = 1\ncells = [1, 0, 1]"), HasSubstr("mesh.raster.cells[1]: is out of range"));
  EXPECT_THAT(raster("cell_size = 1\ncells = [1, 2.5, 1]"), HasSubstr("mesh.raster.cells[1]: is a number"));
  EXPECT_THAT(raster("cell_size = 1\nkind = \"tetrahedra\"\ncells = 2"), HasSubstr("single tetrahedra have no cells"));
  EXPECT_THAT(raster("cell_size = 1\nslit = {lower = [0, 0, 0], upper = [1, 1, 1]}"),
              HasSubstr("mesh.raster.slit: is not plane"));
  EXPECT_THAT(raster("cell_size = 1\nslit = {lower = [0, 0, 0], upper = [1, 0, 0]}"),
              HasSubstr("mesh.raster.slit: is not plane"));
  EXPECT_THAT(raster("cell_size = 1\nslit = {lower = [0, 0, 0]}"), HasSubstr("mesh.raster.slit.upper: is missing"));
  EXPECT_THAT(raster("cell_size = 1\nslit = 3"), HasSubstr("mesh.raster.slit: is an integer; allowed: a table"));
}

TEST(WrongCases, AllProblemsComeAtOnceEachWithItsLine) {
  std::string text = replaced(minimal, "young = \"75 GPa\"", "young = \"75 m\"");
  text = replaced(text, "poisson = 0.2", "poison = 0.2");
  text = replaced(text, "density = 2456", "density = -1");
  const std::string message = message_of(text);
  EXPECT_THAT(message, AllOf(HasSubstr("case.toml:5: material[0].young: is of dimension length"),
                             HasSubstr("case.toml:6: material[0].poison: unknown key; did you mean \"poisson\"?"),
                             HasSubstr("case.toml:7: material[0].density: is out of range"),
                             HasSubstr("case.toml:3: material[0].poisson: is missing")));
}

TEST(WrongCases, AnAbsentFileIsNamed) {
  const std::filesystem::path absent = "/nowhere/case.toml";
  try {
    (void)read_case(absent);
    FAIL() << "an absent file was read";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "/nowhere/case.toml: the case file does not exist");
  }
}

TEST(WrongCases, ANestedSectionIsNamedAsItIsWritten) {
  EXPECT_THAT(message_of(minimal + "pressure = 3\n"),
              HasSubstr("stage[0].pressure: is an integer; allowed: one or more tables, [[stage.pressure]]"));
}

TEST(WrongCases, AFolderIsNoCase) {
  const CaseFolder folder;
  EXPECT_THROW((void)read_case(folder.path()), InputError);
}

TEST(WrongCases, BinaryRubbishIsRefused) {
  EXPECT_THAT(message_of(std::string("\x00\xff\xfe garbage", 11)), HasSubstr("not TOML"));
}

TEST(WrongCases, DeepNestingIsRefused) {
  EXPECT_THAT(message_of("title = " + std::string(100000, '[')), HasSubstr("not TOML"));
}

}  // namespace
}  // namespace breccia::case_
