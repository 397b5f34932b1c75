#include <gtest/gtest.h>

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
};

void PrintTo(const Wrong& wrong, std::ostream* stream) { *stream << wrong.name; }

const std::vector<Wrong>& wrongs() {
  static const std::vector<Wrong> table{
      // The command line.
      {"no_command", "", "", {"subcommand"}, "", kUsage},
      {"unknown_command", "", "", {"subcommand"}, "shatter CASE", kUsage},
      {"no_case", "", "", {"case"}, "run", kUsage},
      {"unknown_option", "", "", {"--fast"}, "run CASE --fast", kUsage},
      {"unknown_progress", "", "", {"--progress", "loud"}, "run CASE --progress loud", kUsage},
      {"set_without_value", "", "", {"time.safety"}, "check CASE --set time.safety"},
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
  const std::string folder = scratch.path("").parent_path().string();
  const std::string arguments = replaced(replaced(wrong.arguments, "CASE", file), "DIR", folder);

  const Outcome outcome = call(arguments);
  EXPECT_EQ(outcome.exit_code, wrong.exit_code) << outcome.out << outcome.err;
  const std::string said = wrong.exit_code == kUsage ? outcome.out + outcome.err : outcome.err;
  for (const std::string& fragment : wrong.message) {
    EXPECT_NE(said.find(replaced(fragment, "DIR", folder)), std::string::npos)
        << "'" << fragment << "' is missing in: " << said;
  }
  EXPECT_EQ(said.find("terminate called"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(, WrongInput, testing::ValuesIn(wrongs()), [](const auto& one) { return one.param.name; });

TEST(WrongInputTable, holds_at_least_forty_cases) { EXPECT_GE(wrongs().size(), 40u); }

}  // namespace
}  // namespace breccia::test
