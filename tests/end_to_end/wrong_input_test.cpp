#include <gtest/gtest.h>
#include <sys/stat.h>

#include "end_to_end/program.hpp"

namespace breccia::test {
namespace {

constexpr int kUsage = 1, kInput = 2;

/// One thing a user may get wrong: the case as changed, and what the program must say.
struct Wrong {
  std::string name;
  std::string from, to;                  ///< change of the small case; empty: none
  std::vector<std::string> message;      ///< fragments of stderr
  std::string arguments = "check CASE";  ///< CASE stands for the case file, DIR for a scratch folder
  int exit_code = kInput;
  std::string environment = {};
};

void PrintTo(const Wrong& wrong, std::ostream* stream) { *stream << wrong.name; }

const std::vector<Wrong>& wrongs() {
  static const std::vector<Wrong> table{
      // The command line.
      {"no_command", "", "", {"subcommand"}, "", kUsage},
      {"unknown_command", "", "", {"unknown command \"shatter\"", "run, ", "check"}, "shatter CASE", kUsage},
      {"misspelt_command", "", "", {"unknown command \"runn\"; did you mean run?"}, "runn CASE", kUsage},
      {"unknown_command_help", "", "", {"unknown command \"NOSUCH\""}, "NOSUCH --help", kUsage},
      {"empty_command", "", "", {"unknown command \"\""}, "''", kUsage},
      {"run_without_a_case", "", "", {"breccia: error: case is required", "breccia run --help"}, "run", kUsage},
      {"two_commands", "", "", {"not expected"}, "check CASE mesh CASE", kUsage},
      {"two_cases", "", "", {"breccia: error: not expected: "}, "check CASE CASE", kUsage},
      {"unexpected_in_the_order_given", "", "", {"not expected: --parts 2"}, "run CASE --parts 2", kUsage},
      {"output_without_a_folder", "", "", {"--output"}, "run CASE -o", kUsage},
      {"output_twice", "", "", {"--output"}, "run CASE -o DIR/a -o DIR/b", kUsage},
      {"set_without_text", "", "", {"breccia: error: --set: the value is missing"}, "check CASE --set", kUsage},
      {"set_an_empty_key", "", "", {"--set"}, "check CASE --set =3", kUsage},
      {"set_below_a_value", "", "", {"time.safety.x"}, "check CASE --set time.safety.x=3"},
      {"set_past_the_end", "", "", {"material[7]", "past the end", "0"}, "check CASE --set material[7].young=3"},
      {"set_a_negative_index", "", "", {"material[-1]"}, "check CASE --set material[-1].young=3"},
      {"set_no_index", "", "", {"material[]"}, "check CASE --set material[].young=3"},
      {"set_an_unknown_name", "", "", {"material.bolt", "box"}, "check CASE --set material.bolt.young=3"},
      {"set_two_values", "", "", {"time.safety"}, "check CASE --set \"time.safety=0.5\nx=1\""},
      {"set_an_open_list", "", "", {"output.gauges"}, "check CASE --set 'output.gauges=[\"a\"'"},
      {"set_a_deep_key", "", "", {"too deep"}, "check CASE --set time.safety=$(printf 'a.%.0s' $(seq 5000))a=1"},
      {"ranks_zero", "", "", {"--ranks", "0"}, "check CASE --ranks 0", kUsage},
      {"ranks_too_many", "", "", {"--ranks", "99999999"}, "check CASE --ranks 99999999", kUsage},
      {"ranks_a_word", "", "", {"--ranks", "many"}, "check CASE --ranks many", kUsage},
      {"diff_of_one", "", "", {"second"}, "diff DIR", kUsage},
      {"diff_of_no_runs", "", "", {"is no folder of a run"}, "diff DIR DIR"},
      {"mesh_into_a_file", "", "", {"case.toml"}, "mesh CASE -o CASE/x"},
      {"replay_of_no_run", "", "", {"DIR"}, "insitu replay DIR fractures"},
      {"no_case", "", "", {"case"}, "run", kUsage},
      {"unknown_option", "", "", {"--fast"}, "run CASE --fast", kUsage},
      {"unknown_progress", "", "", {"--progress", "loud"}, "run CASE --progress loud", kUsage},
      {"set_without_value",
       "",
       "",
       {"breccia: error: --set: ", "key=value", "given: \"time.safety\""},
       "check CASE --set time.safety",
       kUsage},
      {"output_to_an_empty_name", "", "", {"breccia: error: --output: is empty"}, "run CASE -o ''", kUsage},
      {"set_unknown_key", "", "", {"time.safty", "time.safety"}, "check CASE --set time.safty=0.5"},
      {"set_out_of_range", "", "", {"time.safety", "1.5"}, "check CASE --set time.safety=1.5"},
      {"explain_unknown_key", "", "", {"material.yung", "young"}, "explain material.yung"},
      {"race_without_case", "", "", {"case"}, "race", kUsage},
      {"race_of_unknown_algorithm",
       "",
       "",
       {"--algorithms", "fast", "sorted_grid"},
       "race CASE --algorithms ms,fast",
       kUsage},
      {"race_with_no_buffer", "", "", {"--buffers", "0", "100"}, "race CASE --buffers 1,0", kUsage},
      {"race_with_a_word_for_a_buffer", "", "", {"--buffers", "wide"}, "race CASE --buffers wide", kUsage},
      {"race_of_no_steps", "", "", {"--steps", "0", "1"}, "race CASE --steps 0", kUsage},
      {"race_of_half_a_step", "", "", {"--steps", "1.5"}, "race CASE --steps 1.5", kUsage},
      {"race_of_no_time", "", "", {"--time", "above 0", "0 s"}, "race CASE --time '0 s'", kUsage},
      {"race_in_metres", "", "", {"--time", "20 us", "3 m"}, "race CASE --time '3 m'", kUsage},
      {"race_by_time_and_steps", "", "", {"--time", "--steps"}, "race CASE --time '1 ms' --steps 3", kUsage},
      {"race_from_before_the_start", "", "", {"--from", "-1 ms"}, "race CASE --from '-1 ms'", kUsage},
      {"race_with_unknown_progress", "", "", {"--progress", "loud"}, "race CASE --progress loud", kUsage},
      {"race_from_after_the_end", "", "", {"--from", "4 ms", "5 ms"}, "race CASE --from '5 ms'"},
      {"race_from_the_last_step", "", "", {"--from", "4 ms"}, "race CASE --from '3.9999999 ms' --progress none"},
      {"race_without_contact",
       "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"40 MPa\"\nfriction = 0.3\n",
       "",
       {"contact", "nothing can touch"},
       "race CASE --steps 3"},
      {"race_into_a_file", "", "", {"case.toml", "folder"}, "race CASE --steps 3 -o CASE"},
      {"race_set_unknown_key", "", "", {"time.safty", "time.safety"}, "race CASE --set time.safty=0.5"},
      {"control_of_no_run", "", "", {"DIR", "no run of breccia writes here"}, "control DIR pause"},
      {"control_by_an_unknown_command", "", "", {"dance", "pause, resume, stop"}, "control DIR dance"},
      {"control_by_a_wrong_interval", "", "", {"frame_interval", "3 m"}, "control DIR frame_interval 3 m"},
      {"control_by_no_interval",
       "",
       "",
       {"frame_interval needs a simulated time", "\"frame_interval 2 us\""},
       "control DIR frame_interval"},
      {"control_without_command", "", "", {"command"}, "control DIR", kUsage},
      {"control_without_patience", "", "", {"--patience", "0"}, "control DIR pause --patience 0", kUsage},
      {"unknown_pipeline", "", "", {"insitu.run", "fractures"}, "check CASE --set 'insitu.run=[\"fracture\"]'"},
      {"insitu_unknown_pipeline", "", "", {"insitu.run", "fractures"}, "run CASE --insitu fracture"},
      {"insitu_missing_script", "", "", {"insitu.run", "nowhere.py", "does not exist"}, "run CASE --insitu nowhere.py"},
      {"live_to_another_machine",
       "",
       "",
       {"insitu.live.address", "another machine"},
       "run CASE --live far.example:22222"},
      {"live_at_no_port", "", "", {"insitu.live.address", "localhost:0"}, "run CASE --live localhost:0"},
      {"remote_without_live", "", "", {"--live-remote", "--live"}, "run CASE --live-remote", kUsage},
      {"replay_without_pipeline", "", "", {"pipelines"}, "insitu replay DIR", kUsage},
      {"insitu_without_command", "", "", {"subcommand"}, "insitu", kUsage},
      // The file.
      {"missing_file", "", "", {"nowhere.toml"}, "check DIR/nowhere.toml"},
      {"folder_for_a_file", "", "", {"DIR"}, "check DIR"},
      {"empty_file", "", "", {"mesh: is missing"}, "check DIR/empty.toml"},
      {"file_of_zeros", "", "", {"zeros.toml"}, "check DIR/zeros.toml"},
      {"file_of_wrong_letters", "", "", {"letters.toml:1"}, "check DIR/letters.toml"},
      {"deep_key", "", "", {"deep.toml:1", "too deep", "64"}, "check DIR/deep.toml"},
      {"deep_list", "", "", {"brackets.toml"}, "check DIR/brackets.toml"},
      {"fifo_for_a_case", "", "", {"pipe.toml"}, "check DIR/pipe.toml"},
      {"device_for_a_case", "", "", {"/dev/null"}, "check /dev/null"},
      {"case_twice_in_it", "title = \"two boxes\"", "title = \"a\"\ntitle = \"b\"", {"case.toml:2"}},
      {"huge_integer", "poisson = 0.3", "poisson = 99999999999999999999", {"case.toml:11"}},
      {"number_of_309_digits", "\"4 MPa\"", "\"" + std::string(309, '9') + " Pa\"", {"young", "1e308"}},
      {"number_too_small", "\"4 MPa\"", "\"1e-320 Pa\"", {"penalty too soft"}},
      {"hexadecimal_text", "\"4 MPa\"", "\"0x10 Pa\"", {"young"}},
      {"unit_GPpa", "\"4 MPa\"", "\"4 GPpa\"", {"did you mean \"GPa\""}},
      {"unit_of_a_thousand_brackets", "\"4 MPa\"", "\"4 " + std::string(1000, '(') + "\"", {"young"}},
      {"date_for_a_number", "poisson = 0.3", "poisson = 1979-05-27", {"poisson", "date"}},
      {"true_for_a_number", "poisson = 0.3", "poisson = true", {"poisson", "true or false"}},
      {"list_for_a_number", "poisson = 0.3", "poisson = [0.3]", {"poisson", "list"}},
      {"table_for_a_number", "poisson = 0.3", "poisson = {a = 1}", {"poisson", "table"}},
      {"number_for_a_text", "group = \"box\"\nyoung", "group = 3\nyoung", {"group"}},
      {"number_for_a_section", "[sphere]\ncentre", "sphere = 3\n[other]\ncentre", {"sphere"}},
      {"table_for_a_list", "[[material]]", "[material]", {"material", "one or more tables"}},
      {"list_for_a_table", "[output]", "[[output]]", {"output"}},
      {"two_for_three", "\"20 mm\", \"10 mm\", \"5 mm\"", "\"20 mm\", \"10 mm\"", {"centre", "a list of three"}},
      {"four_numbers_for_three", "\"10 mm\", \"5 mm\"", "\"10 mm\", \"5 mm\", 0", {"centre", "a list of three"}},
      {"toml_syntax", "[[stage]]", "[[stage]", {"case.toml:", "31"}},
      {"unknown_key", "young = \"4 MPa\"", "young = \"4 MPa\"\nyoungs = 3", {"youngs", "young"}},
      {"unknown_section", "[output]", "[outputs]", {"outputs", "output"}},
      // Values.
      {"wrong_unit", "\"4 MPa\"", "\"4 MPas\"", {"material", "young", "4 MPas"}},
      {"wrong_dimension", "\"4 MPa\"", "\"4 kg\"", {"young", "4 kg"}},
      {"number_without_unit", "\"4 MPa\"", "\"4\"", {"young"}},
      {"negative_density", "\"2340 kg/m3\"", "\"-2340 kg/m3\"", {"case.toml:12", "density", "-2340"}},
      {"zero_young", "\"4 MPa\"", "0", {"young"}},
      {"poisson_one_half", "poisson = 0.3", "poisson = 0.5", {"poisson", "0.5"}},
      {"poisson_minus_one", "poisson = 0.3", "poisson = -1", {"poisson", "-1"}},
      {"not_a_number", "poisson = 0.3", "poisson = nan", {"poisson"}},
      {"infinite", "\"4 MPa\"", "inf", {"young"}},
      {"wrong_type", "poisson = 0.3", "poisson = \"soft\"", {"poisson", "soft"}},
      {"unknown_choice", "\"breakable\"", "\"brittle\"", {"joints", "brittle", "breakable"}},
      {"missing_key", "density = \"2340 kg/m3\"\n", "", {"density"}},
      {"zero_radius", "\"26 mm\"", "0", {"sphere.radius"}},
      {"negative_radius", "\"26 mm\"", "\"-26 mm\"", {"sphere.radius", "-26 mm"}},
      {"radius_in_seconds", "\"26 mm\"", "\"26 s\"", {"sphere.radius", "time"}},
      {"infinite_radius", "\"26 mm\"", "inf", {"sphere.radius"}},
      {"sphere_without_penalty", "radius = \"26 mm\"\npenalty = \"40 MPa\"\n", "radius = 1\n", {"sphere.penalty"}},
      {"negative_strength", "\"20 kPa\"", "\"-20 kPa\"", {"tensile_strength"}},
      {"strength_not_a_number", "\"20 kPa\"", "nan", {"tensile_strength"}},
      {"no_strength", "tensile_strength = \"20 kPa\"\n", "", {"joint"}},
      {"negative_energy", "\"1 J/m2\"", "\"-1 J/m2\"", {"energy_mode_1"}},
      {"energy_in_joules", "\"1 J/m2\"", "\"1 J\"", {"energy_mode_1", "energy"}},
      {"zero_penalty_factor", "penalty_factor = 10", "penalty_factor = 0", {"penalty_factor"}},
      {"both_penalties", "penalty_factor = 10", "penalty_factor = 10\npenalty = 1e9", {"penalty"}},
      {"unknown_softening",
       "penalty_factor = 10",
       "penalty_factor = 10\nsoftening = \"butter\"",
       {"softening", "butter"}},
      {"points_to_fail_4", "penalty_factor = 10", "penalty_factor = 10\npoints_to_fail = 4", {"points_to_fail", "4"}},
      {"zero_contact_penalty", "penalty = \"40 MPa\"\nfriction", "penalty = 0\nfriction", {"penalty"}},
      {"contact_of_one", "[\"*\", \"*\"]", "[\"*\"]", {"between"}},
      {"contact_of_three", "[\"*\", \"*\"]", "[\"*\", \"*\", \"*\"]", {"between"}},
      {"contact_of_no_group", "[\"*\", \"*\"]", "[\"*\", \"ball\"]", {"ball"}},
      {"contact_twice",
       "[[contact]]",
       "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = 1e6\n[[contact]]",
       {"contact"}},
      {"random_of_one", "[\"1 m/s\", \"2 m/s\"]", "[\"1 m/s\"]", {"random"}},
      {"random_the_wrong_way_round", "[\"1 m/s\", \"2 m/s\"]", "[\"2 m/s\", \"1 m/s\"]", {"random"}},
      {"negative_seed", "seed = 3", "seed = -3", {"seed", "-3"}},
      {"half_a_seed", "seed = 3", "seed = 3.5", {"seed"}},
      {"negative_frame_interval", "\"1 ms\"\ngauges", "\"-1 ms\"\ngauges", {"frame_interval"}},
      {"frame_interval_in_metres", "\"1 ms\"\ngauges", "\"1 mm\"\ngauges", {"frame_interval", "length"}},
      {"zero_cell_size", "\"10 mm\"\nboxes", "0\nboxes", {"cell_size"}},
      {"negative_cell_size", "\"10 mm\"\nboxes", "\"-10 mm\"\nboxes", {"cell_size"}},
      {"half_a_cell", "[2, 2, 1]", "[2, 2.5, 1]", {"cells"}},
      {"million_cells", "[2, 2, 1]", "[1000000, 2, 1]", {"cells", "100000"}},
      {"no_boxes", "boxes = [2, 1, 1]", "boxes = [0, 1, 1]", {"boxes"}},
      {"two_meshes", "[mesh.raster]", "[mesh]\nfile = \"good.geo\"\n[mesh.raster]", {"mesh", "only one of file"}},
      {"mesh_time_limit_zero", "[mesh.raster]", "[mesh]\ntime_limit = 0\n[mesh.raster]", {"time_limit"}},
      {"mesh_memory_limit_two", "[mesh.raster]", "[mesh]\nmemory_limit = 2\n[mesh.raster]", {"memory_limit", "2"}},
      {"mesh_scale_zero", "[mesh.raster]", "[mesh]\nscale = 0\n[mesh.raster]", {"scale"}},
      {"unknown_inverted", "[mesh.raster]", "[mesh]\ninverted = \"perhaps\"\n[mesh.raster]", {"inverted", "refuse"}},
      {"velocity_and_fixed", "velocity = { z = 0 }", "velocity = { z = 0 }\nfixed = \"z\"", {"constraint"}},
      {"fixed_nowhere", "velocity = { z = 0 }", "fixed = \"\"", {"fixed"}},
      {"fixed_along_w", "velocity = { z = 0 }", "fixed = \"w\"", {"fixed", "w"}},
      {"velocity_of_nothing", "{ z = 0 }", "{}", {"velocity"}},
      {"velocity_in_metres", "{ z = 0 }", "{ z = \"1 m\" }", {"velocity"}},
      {"safety_zero", "[output]", "[time]\nsafety = 0\n[output]", {"time.safety"}},
      {"negative_step", "[output]", "[time]\nstep = -1\n[output]", {"time.step"}},
      {"step_longer_than_a_stage",
       "[output]",
       "[time]\nstep = \"1 s\"\n[output]",
       {"stage[0].end", "shorter than one time.step, 1 s", "at most 0.004 s"}},
      {"negative_max_steps", "[output]", "[time]\nmax_steps = -1\n[output]", {"max_steps"}},
      {"unknown_algorithm", "[output]", "[detection]\nalgorithm = \"magic\"\n[output]", {"algorithm", "ms"}},
      {"negative_buffer", "[output]", "[detection]\nbuffer = -1\n[output]", {"buffer"}},
      {"grid_of_too_many", "[output]", "[domains]\nkind = \"grid\"\nn = [1000, 1000, 1000]\n[output]", {"domains.n"}},
      {"grid_without_kind", "[output]", "[domains]\nn = [2, 1, 1]\n[output]", {"domains.n"}},
      {"zero_patience", "[output]", "[domains]\npatience = 0\n[output]", {"patience"}},
      {"live_at_a_name_that_begins_like_us",
       "",
       "",
       {"insitu.live.address", "another machine"},
       "run CASE --live 127.evil.example:22222"},
      {"live_at_a_port_too_large", "", "", {"insitu.live.address"}, "run CASE --live localhost:65536"},
      {"live_at_no_number", "", "", {"insitu.live.address"}, "run CASE --live localhost:port"},
      {"density_that_needs_ever_more_steps", "\"2340 kg/m3\"", "1e-300", {"density", "1e-300"}},
      {"end_that_is_never_reached", "\"4 ms\"", "1e300", {"stage[0].end"}},
      {"step_that_needs_ever_more_steps",
       "[output]",
       "[time]\nstep = 1e-300\n[output]",
       {"stage[0].end", "case.toml:", "1e15 steps", "given: time.step = 1e-300 s"}},
      {"step_that_needs_ever_more_steps_of_a_run",
       "[output]",
       "[time]\nstep = 1e-300\n[output]",
       {"stage[0].end", "given: time.step = 1e-300 s"},
       "run CASE -o DIR/run"},
      {"stiffness_that_needs_ever_more_steps",
       "\"4 MPa\"",
       "1e60",
       {"stage[0].end", "more steps than can be counted", "allows a time step"}},
      {"stiffness_that_needs_ever_more_steps_of_a_run",
       "\"4 MPa\"",
       "1e60",
       {"stage[0].end", "more steps than can be counted", "allows a time step"},
       "run CASE -o DIR/run"},
      {"young_without_digits", "\"4 MPa\"", "5e-324", {"young", "double precision", "4.94066e-324"}},
      {"pressure_beyond_sense",
       "[output]",
       "[[stage.pressure]]\nsurface = \"box.x0\"\nvalue = 1e300\n[output]",
       {"stage[0].pressure[0].value", "beyond what can be computed", "1e+300 Pa"}},
      {"raster_of_too_many", "cells = [2, 2, 1]", "cells = [100000, 100000, 1]", {"case.toml:", "mesh.raster.cells"}},
      {"raster_too_large", "cell_size = \"10 mm\"", "cell_size = 1e300", {"case.toml:", "mesh.raster", "1e50 m"}},
      {"key_that_moves_the_cursor", "[output]", "[\"ou\\u001b[31m\"]\n[output]", {"ou\\x1b[31m: unknown key"}},
      {"negative_friction", "friction = 0.3", "friction = -0.1", {"friction", "-0.1"}},
      {"stage_without_end", "end = \"4 ms\"\n", "", {"end"}},
      {"stage_of_no_length", "\"4 ms\"", "0", {"end"}},
      {"constraint_without_kind", "velocity = { z = 0 }\n", "", {"constraint"}},
      {"unknown_axis", "{ z = 0 }", "{ w = 0 }", {"w"}},
      {"zero_cells", "cells = [2, 2, 1]", "cells = [2, 0, 1]", {"cells"}},
      {"negative_gap", "gap = [\"1 mm\"", "gap = [\"-1 mm\"", {"gap"}},
      {"no_mesh",
       "[mesh.raster]\ncells = [2, 2, 1]\ncell_size = \"10 mm\"\nboxes = [2, 1, 1]\ngap = [\"1 mm\", \"0 mm\", \"0 "
       "mm\"]\ngroup = \"box\"\n",
       "",
       {"mesh"}},
      // Groups and laws.
      {"material_of_no_volume", "[[material]]\ngroup = \"box\"", "[[material]]\ngroup = \"bax\"", {"bax", "box"}},
      {"constraint_on_no_group", "group = \"box.x0\"", "group = \"box.w0\"", {"box.w0", "box.x0"}},
      {"gauge_of_no_group", "gauges = [\"box\"]", "gauges = [\"bolt\"]", {"bolt"}},
      {"velocity_of_no_group",
       "[[initial_velocity]]\ngroup = \"box\"",
       "[[initial_velocity]]\ngroup = \"ball\"",
       {"ball"}},
      {"no_joint_law",
       "[[joint]]\ngroup = \"box\"\npenalty_factor = 10\ntensile_strength = \"20 kPa\"\nenergy_mode_1 = \"1 J/m2\"\n",
       "",
       {"joint", "box"}},
      {"penalty_too_soft", "energy_mode_1 = \"1 J/m2\"", "energy_mode_1 = \"1e-3 J/m2\"", {"penalty too soft"}},
      {"two_laws_for_a_group",
       "[[contact]]",
       "[[joint]]\ngroup = \"box\"\npenalty_factor = 5\ntensile_strength = 1\nenergy_mode_1 = 1\n[[contact]]",
       {"joint", "box"}},
      {"everything_at_once",
       "poisson = 0.3\ndensity = \"2340 kg/m3\"",
       "poisson = 0.7\ndensity = \"0 kg/m3\"\nyoungs = 1",
       {"poisson", "density", "youngs"}},
      // Mesh files.
      {"mesh_file_missing", "[mesh.raster]", "[mesh]\nfile = \"gone.msh\"\n[ignored]", {"gone.msh"}},
      {"mesh_of_another_kind", "[mesh.raster]", "[mesh]\nfile = \"case.toml\"\n[ignored]", {"case.toml"}},
      {"zero_volume_element", "[mesh.raster]", "[mesh]\nfile = \"flat.msh\"\n[ignored]", {"flat.msh", "volume"}},
      {"mesh_without_tetrahedra",
       "[mesh.raster]",
       "[mesh]\nfile = \"empty.msh\"\n[ignored]",
       {"empty.msh", "tetrahedra"}},
      {"geo_with_an_error", "[mesh.raster]", "[mesh]\nfile = \"broken.geo\"\n[ignored]", {"broken.geo"}},
      {"unknown_parameter", "[mesh.raster]", "[mesh]\nfile = \"good.geo\"\nparameters = { hh = 1 }\n[ignored]", {"hh"}},
      {"mesh_is_a_folder", "[mesh.raster]", "[mesh]\nfile = \"folder.msh\"\n[ignored]", {"folder.msh", "is a folder"}},
      {"step_that_is_cut_off",
       "[mesh.raster]",
       "[mesh]\nfile = \"cut.step\"\n[ignored]",
       {"cut.step", "does not end with END-ISO-10303-21"}},
      {"stl_that_is_open",
       "[mesh.raster]",
       "[mesh]\nfile = \"open.stl\"\n[ignored]",
       {"open.stl", "the surface is open: 3 edges belong to one triangle only"}},
      {"solid_with_parameters",
       "[mesh.raster]",
       "[mesh]\nfile = \"open.stl\"\nparameters = { h = 1 }\n[ignored]",
       {"mesh.parameters", "a solid takes no parameters"}},
      {"script_with_a_size",
       "[mesh.raster]",
       "[mesh]\nfile = \"good.geo\"\nsize = 0.1\n[ignored]",
       {"mesh.size", "a .geo sets its own"}},
      {"size_that_is_negative",
       "[mesh.raster]",
       "[mesh]\nfile = \"open.stl\"\nsize = -1\n[ignored]",
       {"mesh.size", "out of range"}},
      {"mesh_is_a_pipe", "[mesh.raster]", "[mesh]\nfile = \"pipe.geo\"\n[ignored]", {"pipe.geo"}},
      {"mesh_is_empty", "[mesh.raster]", "[mesh]\nfile = \"nothing.msh\"\n[ignored]", {"nothing.msh", "empty"}},
      {"mesh_is_cut_off", "[mesh.raster]", "[mesh]\nfile = \"cut.msh\"\n[ignored]", {"cut.msh"}},
      {"mesh_of_format_9", "[mesh.raster]", "[mesh]\nfile = \"nine.msh\"\n[ignored]", {"nine.msh", "2.2 to 4.1", "9"}},
      {"mesh_with_infinite_nodes", "[mesh.raster]", "[mesh]\nfile = \"infinite.msh\"\n[ignored]", {"infinite.msh"}},
      {"mesh_of_missing_nodes", "[mesh.raster]", "[mesh]\nfile = \"holes.msh\"\n[ignored]", {"holes.msh"}},
      {"mesh_with_a_count_too_large", "[mesh.raster]", "[mesh]\nfile = \"count.msh\"\n[ignored]", {"count.msh"}},
      {"mesh_with_an_option_file", "[mesh.raster]", "[mesh]\nfile = \"opted.geo\"\n[ignored]", {"opted.geo.opt"}},
      {"geo_that_runs_a_program",
       "[mesh.raster]",
       "[mesh]\nfile = \"system.geo\"\n[ignored]",
       {"system.geo:1", "SystemCall"}},
      {"geo_that_runs_a_computed_program",
       "[mesh.raster]",
       "[mesh]\nfile = \"computed.geo\"\n[ignored]",
       {"run a program"}},
      {"geo_that_writes", "[mesh.raster]", "[mesh]\nfile = \"writes.geo\"\n[ignored]", {"open a file for writing"}},
      {"geo_that_exits", "[mesh.raster]", "[mesh]\nfile = \"exits.geo\"\n[ignored]", {"exits.geo:1", "Exit"}},
      {"geo_without_end",
       "[mesh.raster]",
       "[mesh]\nfile = \"endless.geo\"\ntime_limit = 0.3\n[ignored]",
       {"mesh.time_limit"}},
      {"parameters_of_a_mesh",
       "[mesh.raster]",
       "[mesh]\nfile = \"flat.msh\"\nparameters = {h = 1}\n[ignored]",
       {"parameters"}},
      {"parameter_not_a_number",
       "[mesh.raster]",
       "[mesh]\nfile = \"good.geo\"\nparameters = {h = nan}\n[ignored]",
       {"parameters.h"}},
      {"parameter_a_text",
       "[mesh.raster]",
       "[mesh]\nfile = \"good.geo\"\nparameters = {h = \"wide\"}\n[ignored]",
       {"parameters.h"}},
      // The environment.
      {"unknown_instruction_set", "", "", {"BRECCIA_SIMD"}, "run CASE -o DIR/run", kInput, "BRECCIA_SIMD=sse9"},
      // Results.
      {"folder_of_something_else", "", "", {"DIR"}, "run CASE -o DIR"},
      {"folder_that_cannot_be_made", "", "", {"/proc/results"}, "run CASE -o /proc/results"},
      {"folder_is_a_file", "", "", {"case.toml"}, "run CASE -o CASE"},
  };
  return table;
}

constexpr const char* kHead = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Files that the table names beside the case.
void write_wrong_files(const Scratch& scratch) {
  std::string deep = "a";
  for (int i = 0; i < 50000; ++i) deep += ".a";
  scratch.write("empty.toml", "");
  scratch.write("zeros.toml", std::string(1000, '\0'));
  scratch.write("letters.toml", "title = \"\xff\xfe\"\n");
  scratch.write("deep.toml", deep + " = 1\n");
  scratch.write("brackets.toml", "a = " + std::string(50000, '[') + "\n");
  std::filesystem::create_directory(scratch.path("folder.msh"));
  for (const char* pipe : {"pipe.toml", "pipe.geo"}) ::mkfifo(scratch.path(pipe).c_str(), 0600);
  const std::string node = "4 0 0 1\n$EndNodes\n", tetra = "1 4 2 1 1 1 2 3 4\n$EndElements\n";
  scratch.write("nothing.msh", "");
  scratch.write("cut.msh", std::string(kHead).substr(0, 60));
  scratch.write("nine.msh", "$MeshFormat\n9.0 0 8\n$EndMeshFormat\n");
  scratch.write("infinite.msh", std::string(kHead) + "4 0 0 inf\n$EndNodes\n$Elements\n1\n" + tetra);
  scratch.write("holes.msh", std::string(kHead) + node + "$Elements\n1\n1 4 2 1 1 1 2 3 9\n$EndElements\n");
  scratch.write("count.msh", std::string(kHead) + node + "$Elements\n99999999\n" + tetra);
  scratch.write("cut.step", "ISO-10303-21;\nHEADER;\n");
  scratch.write("open.stl",
                "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                "endloop\nendfacet\nendsolid one\n");
  scratch.write("opted.geo", "Point(1) = {0, 0, 0};\n");
  scratch.write("opted.geo.opt", "SystemCall \"true\";\n");
  scratch.write("system.geo", "SystemCall \"true\";\n");
  scratch.write("computed.geo", "c = \"true\";\nSystem Str(c);\nPoint(1) = {0, 0, 0};\n");
  scratch.write("writes.geo", "Printf(\"x\") > \"" + scratch.path("written").string() + "\";\n");
  scratch.write("exits.geo", "Exit;\n");
  scratch.write("endless.geo", "For i In {1:1000000000}\n  x = i;\nEndFor\n");
}

class WrongInput : public testing::TestWithParam<Wrong> {};

TEST_P(WrongInput, is_refused_with_its_message_and_exit_code) {
  const Wrong& wrong = GetParam();
  const Scratch scratch;
  // The mesh files need no raster keys: what stood in the section goes with it.
  std::string text = wrong.from.empty() ? kSmallCase : changed(wrong.from, wrong.to);
  if (const std::size_t ignored = text.find("[ignored]"); ignored != std::string::npos) {
    text.erase(ignored, text.find("[[material]]") - ignored);
  }
  const std::string file = scratch.write("case.toml", text);
  scratch.write("flat.msh", std::string(kHead) + "4 1 1 0\n$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n");
  scratch.write("empty.msh", std::string(kHead) + "4 0 0 1\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n");
  scratch.write("broken.geo", "Point(1) = {0, 0, 0;\n");
  scratch.write("good.geo",
                "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0, 1,1,1};\nPhysical Volume(\"box\") = {1};\n");
  write_wrong_files(scratch);
  const std::string folder = scratch.path("").parent_path().string();
  const std::string arguments = replaced(replaced(wrong.arguments, "CASE", file), "DIR", folder);

  const Outcome outcome = call(arguments, wrong.environment);
  EXPECT_EQ(outcome.exit_code, wrong.exit_code) << outcome.out << outcome.err;
  const std::string said = wrong.exit_code == kUsage ? outcome.out + outcome.err : outcome.err;
  for (const std::string& fragment : wrong.message) {
    EXPECT_NE(said.find(replaced(fragment, "DIR", folder)), std::string::npos)
        << "'" << fragment << "' is missing in: " << said;
  }
  EXPECT_EQ(said.find("terminate called"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(, WrongInput, testing::ValuesIn(wrongs()), [](const auto& one) { return one.param.name; });

TEST(WrongInputOfRanks, is_refused_with_one_message_by_two_of_them) {
  const Scratch scratch;
  write_wrong_files(scratch);
  const std::string mesh = changed("[mesh.raster]", "[mesh]\nfile = \"FILE\"\n[ignored]");
  const auto with_mesh = [&](const std::string& file) {
    std::string text = replaced(mesh, "FILE", file);
    const std::size_t ignored = text.find("[ignored]");
    return text.erase(ignored, text.find("[[material]]") - ignored);
  };
  for (const auto& [text, fragment] :
       std::vector<std::pair<std::string, std::string>>{{with_mesh("writes.geo"), "open a file for writing"},
                                                        {with_mesh("computed.geo"), "run a program"},
                                                        {with_mesh("cut.msh"), "cut.msh"},
                                                        {changed("poisson = 0.3", "poisson = 0.5"), "poisson"},
                                                        {changed("[output]", "[outputs]"), "outputs"}}) {
    const std::string file = scratch.write("two.toml", text);
    const Outcome outcome = call_ranks(2, "run " + file + " -o '" + scratch.path("run").string() + "'");
    EXPECT_EQ(outcome.exit_code, kInput) << outcome.err;
    const std::size_t first = outcome.err.find(fragment);
    EXPECT_NE(first, std::string::npos) << fragment << " is missing in: " << outcome.err;
    const std::string mark = "breccia: error:";
    EXPECT_EQ(outcome.err.find(mark), outcome.err.rfind(mark)) << "told by both: " << outcome.err;
  }
}

TEST(WrongInputTable, holds_at_least_150_cases) { EXPECT_GE(wrongs().size(), 150u); }

}  // namespace
}  // namespace breccia::test
