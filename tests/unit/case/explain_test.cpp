#include "case/explain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "case/schema.hpp"
#include "case/topics.hpp"

namespace breccia::case_::explain_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string message_of_key(const std::string& key) {
  try {
    return "no error but: " + explain(key);
  } catch (const InputError& e) {
    return e.what();
  }
}

/// Of "a|b|c".
std::vector<std::string> parts(std::string_view list) {
  std::vector<std::string> out;
  std::istringstream in{std::string(list)};
  for (std::string part; std::getline(in, part, '|');) out.push_back(part);
  return out;
}

TEST(Explain, TheOverviewHasALineForEveryKeyAndSection) {
  const std::string text = explain_all(true);
  for (const Key& key : schema()) {
    if (key.is_section()) continue;
    EXPECT_THAT(text, HasSubstr("\n  " + std::string(key.name()) + " ")) << key.path;
  }
  for (const char* header :
       {"\n[mesh]\n", "\n[[material]]\n", "\n[[stage.constraint]]\n", "\nfunction\n", "\nfunction.ramp\n"})
    EXPECT_THAT(text, HasSubstr(header));
}

TEST(Explain, KeysForExpertsComeByNameUnlessAllAreWanted) {
  const std::string basic = explain_all(false), mesh = explain("mesh");
  EXPECT_THAT(basic, AllOf(HasSubstr("\n  young "), Not(HasSubstr("\n  viscosity ")), Not(HasSubstr("\n[detection]")),
                           HasSubstr("expert (--all): viscosity, "), HasSubstr("Sections for experts: "),
                           HasSubstr("[contact_points], ")));
  EXPECT_THAT(mesh, AllOf(HasSubstr("\n  file "), Not(HasSubstr("\n  time_limit ")), HasSubstr("time_limit")));
  EXPECT_THAT(explain("mesh", true), AllOf(HasSubstr("\n  time_limit "), Not(HasSubstr("expert (--all)"))));
  EXPECT_THAT(explain("detection"), HasSubstr("\n  buffer ")) << "a section for experts shows its keys";
  EXPECT_THAT(explain("mesh.time_limit"), testing::ContainsRegex("\n  level +expert\n"));
  EXPECT_THAT(explain("mesh.file"), Not(HasSubstr("level")));
}

TEST(Explain, MostCasesNeedAThirdOfTheKeys) {
  const auto keys = std::count_if(schema().begin(), schema().end(), [](const Key& key) { return !key.is_section(); });
  const auto basic =
      std::count_if(schema().begin(), schema().end(), [](const Key& key) { return key.level == Level::basic; });
  EXPECT_LE(3 * basic, keys + 30) << basic << " of " << keys;
  for (const Key& key : schema())
    EXPECT_FALSE(key.is_section() && key.level == Level::basic) << key.path << ": a section has the level of its keys";
}

TEST(Explain, AKeyIsFoundByThePathThatSetTakes) {
  EXPECT_EQ(explain("material.glass.joints"), explain("material[].joints"));
  EXPECT_EQ(explain("material[2].joints"), explain("material[].joints"));
}

TEST(Explain, AKeyIsExplainedWithUnitDefaultRangeAndExample) {
  EXPECT_THAT(explain("material[].density"), AllOf(HasSubstr("required"), HasSubstr("kg/m3"), HasSubstr(">= 1e-06"),
                                                   HasSubstr("density = \"2456 kg/m3\"")));
  EXPECT_THAT(explain("time.safety"), AllOf(HasSubstr("0.8"), HasSubstr("> 0 and <= 1"), HasSubstr("safety = 0.5")));
  EXPECT_THAT(explain("joint[].shear_strength"), HasSubstr("as tensile_strength"));
}

TEST(Explain, AChoiceListsItsWords) {
  EXPECT_THAT(explain("detection.algorithm"), HasSubstr("ms, ms_slices, sorted_grid, packed_tree, brute_force"));
}

TEST(Explain, IndicesAndBracketsMayBeLeftOutOrGiven) {
  const std::string text = explain("material[].young");
  EXPECT_EQ(explain("material.young"), text);
  EXPECT_EQ(explain("material[0].young"), text);
  EXPECT_EQ(explain("young"), text);
  EXPECT_EQ(explain("function.ramp.to"), explain("<function>.ramp[].to"));
}

TEST(Explain, ANameOfSeveralKeysExplainsAllOfThem) {
  EXPECT_THAT(explain("penalty"), AllOf(HasSubstr("joint.penalty"), HasSubstr("contact.penalty"),
                                        HasSubstr("sphere.penalty"), Not(HasSubstr("penalty_factor\n"))));
}

TEST(Explain, ASectionListsItsKeys) {
  EXPECT_THAT(explain("sphere"), AllOf(HasSubstr("[sphere]"), HasSubstr("radius"), Not(HasSubstr("young"))));
}

TEST(Explain, AWordOfTheFieldIsAnsweredWithTheKeysThatItStandsFor) {
  for (const auto& [word, key] :
       {std::pair{"process zone", "joint.tensile_strength"}, std::pair{"notch", "joints.broken"},
        std::pair{"symmetry", "stage.constraint.fixed"}, std::pair{"reaction", "output.gauges"},
        std::pair{"cohesive", "joint.softening"}, std::pair{"crack", "joints.broken"},
        std::pair{"fracture energy", "joint.energy_mode_1"}, std::pair{"time step", "time.safety"},
        std::pair{"mass scaling", "material.density"}, std::pair{"rebound", "contact.unloading_exponent"},
        std::pair{"roller", "stage.constraint"}, std::pair{"clamp", "stage.constraint"},
        std::pair{"prescribed velocity", "stage.constraint.velocity"}})
    EXPECT_THAT(message_of_key(word), AllOf(HasSubstr("no error but: " + std::string(word) + "\n"),
                                            testing::ContainsRegex("\n  keys +[^\n]*" + std::string(key))))
        << word;
  const auto answer = [](const std::string& word) { return explain(word).substr(word.size()); };
  EXPECT_EQ(answer("Process_Zones"), answer("process zone"));
  EXPECT_EQ(answer("NOTCHES"), answer("notch"));
  EXPECT_EQ(explain("pressure"), explain("stage.pressure")) << "what is a key is explained as one";
}

/// Words that users of other programs type first, in both spellings and as they are abbreviated.
constexpr const char* kWordsOfTheField =
    "temperature|thermal|heat|water|fluid|pore pressure|hydraulic fracturing|fracking|periodic|PBC|RVE|"
    "axisymmetric|symmetry|modal|eigenvalue|natural frequencies|buckling|implicit|explicit|static|quasi-static|"
    "dynamic relaxation|2d|plane strain|shell|plate|beam|truss|hexahedron|brick|quad|tetrahedron|tet4|Voronoi|"
    "grains|adaptive|remeshing|refinement|import|CAD|STEP|STL|IGES|gmsh|SolidWorks|elastic|hyperelastic|isotropic|"
    "stiffness|anisotropy|composite|fibre|fiber|delamination|plasticity|yield|Mohr-Coulomb|rate|strain rate|"
    "Johnson-Cook|viscoelastic|creep|ageing|aging|fatigue|equation of state|EOS|shock|JWL|explosive|blast|TNT|"
    "concrete|rock|glass|steel|aluminium|aluminum|soil|sand|rebar|reinforcement|adhesion|glue|Weibull|random field|"
    "Monte Carlo|impact|drop|projectile|wave|spalling|acoustic emission|earthquake|gravity|weight|slope|tunnel|dam|"
    "mining|three-point bending|Brazilian|triaxial|Hopkinson|crushing|contact|Hertz|friction|penalty|erosion|notch|"
    "crack|toughness|energy|momentum|strain|stress|von Mises|J-integral|damage|mode I|results|csv|HDF5|MATLAB|"
    "Excel|ParaView|animation|picture|colour|color|damping|Rayleigh|restart|checkpoint|GPU|CUDA|OpenCL|MPI|OpenMP|"
    "threads|parallelisation|parallelization|cluster|HPC|SLURM|PBS|batch|memory|disk|run time|Windows|macOS|Docker|"
    "conda|pip|installation|Python|API|UMAT|subroutine|optimisation|optimization|calibration|parameter study|GUI|"
    "help|tutorial|examples|version|license|licence|citation|stop|pause|Ctrl-C|reproducibility|sandbox|Abaqus|"
    "LS-DYNA|Ansys|Nastran|COMSOL|inp|3DEC|UDEC|PFC|LAMMPS|YADE|MFEM|FDEM|SPH|DEM|peridynamics|XFEM|phase-field|"
    "cohesive zone|CZM|submodel|multiscale|co-simulation|units|load step|amplitude|boundary condition|"
    "center of mass|centre of mass|coordinates|mass scaling|hourglass|time step|NaN|exit code|TOML|tension|torsion|"
    "centrifuge|user-subroutine";

TEST(Explain, EveryWordOfTheFieldIsAnswered) {
  const std::vector<std::string> words = parts(kWordsOfTheField);
  EXPECT_GT(words.size(), 120u);
  for (const std::string& word : words)
    EXPECT_THAT(message_of_key(word), testing::StartsWith("no error but: ")) << word;
}

TEST(Explain, BothSpellingsOfAWordHaveOneAnswer) {
  for (const auto& [british, american] :
       {std::pair{"colour", "color"}, std::pair{"fibre", "fiber"}, std::pair{"ageing", "aging"},
        std::pair{"licence", "license"}, std::pair{"aluminium", "aluminum"}, std::pair{"optimisation", "optimization"},
        std::pair{"parallelisation", "parallelization"}, std::pair{"homogenisation", "homogenization"},
        std::pair{"centre of mass", "center of mass"}, std::pair{"visualisation", "visualization"}})
    EXPECT_EQ(topic_of(british), topic_of(american)) << british;
}

TEST(Topics, HaveASentenceAndKeysThatThereAreAndWordsThatAreNoKeys) {
  const auto is_path = [](const std::string& path) {
    return std::any_of(schema().begin(), schema().end(), [&](const Key& row) { return plain_path(row.path) == path; });
  };
  for (const Topic& topic : topics()) {
    EXPECT_TRUE(topic.answer.ends_with('.')) << topic.words;
    for (const std::string& key : parts(topic.keys)) EXPECT_TRUE(is_path(key)) << key;
    for (const std::string& word : parts(topic.words)) {
      EXPECT_EQ(topic_of(word), &topic) << word << " is of two";
      EXPECT_TRUE(std::none_of(schema().begin(), schema().end(), [&](const Key& row) { return row.name() == word; }))
          << word;
    }
  }
}

TEST(Explain, AnUnknownKeyNamesTheNearest) {
  EXPECT_THAT(message_of_key("material.yung"), HasSubstr("did you mean material.young"));
  EXPECT_THAT(message_of_key("densty"), HasSubstr("did you mean material.density"));
  EXPECT_THAT(message_of_key("cutoff"), HasSubstr("the word stands in material.tension_cutoff"));
  EXPECT_THAT(message_of_key("faces"),
              testing::ContainsRegex("stands in contact_points.surfaces, .*, and [0-9]+ more"));
  EXPECT_THAT(message_of_key("xyzzy"), AllOf(HasSubstr("unknown key"), HasSubstr("mesh, plane, material, joint")));
  EXPECT_THAT(message_of_key(""), HasSubstr("unknown key"));
}

}  // namespace
}  // namespace breccia::case_::explain_test
