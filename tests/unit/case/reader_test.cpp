#include "case/reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_files.hpp"

namespace breccia::case_::reader_test {
namespace {

TEST(Reader, AMinimalCaseGetsTheDefaultsOfTheStructs) {
  const Case c = read_text(minimal);
  EXPECT_EQ(c.time, TimeControl{});
  EXPECT_EQ(c.detection, Detection{});
  EXPECT_EQ(c.domains, Domains{});
  EXPECT_EQ(c.output, Output{});
  EXPECT_EQ(c.contact_points, ContactPoints{});
  EXPECT_FALSE(c.sphere.has_value());
  EXPECT_TRUE(c.joints.empty());
  EXPECT_TRUE(c.contacts.empty());

  Raster raster;
  raster.cell_size = Vec3(0.01, 0.01, 0.01);
  EXPECT_EQ(c.mesh.raster, raster);
  MeshSource source;
  source.raster = raster;
  EXPECT_EQ(c.mesh, source);

  Stage stage;
  stage.end = 1e-3;
  EXPECT_EQ(c.stages, std::vector<Stage>{stage});
}

TEST(Reader, AJointOfStrengthAndEnergyGetsTheDefaultsOfTheStruct) {
  const std::string text = replaced(minimal, "joints = \"none\"\n",
                                    "[[joint]]\ngroup = \"raster\"\n"
                                    "tensile_strength = 5e6\nenergy_mode_1 = 30\n");
  Joint expected;
  expected.groups = {"raster", "raster"};
  expected.tensile_strength = expected.shear_strength = 5e6;
  expected.energy_mode_1 = expected.energy_mode_2 = 30;
  expected.penalty = 100 * 75e9;
  EXPECT_EQ(read_text(text).joints, std::vector<Joint>{expected});
}

TEST(Reader, ContactSphereAndInitialVelocityGetTheDefaultsOfTheStructs) {
  const Case c = read_text(minimal +
                           "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = 1\n[sphere]\nradius = 2\npenalty = 3\n"
                           "[[initial_velocity]]\ngroup = \"raster\"\n");
  Contact contact;
  contact.groups = {"*", "*"};
  contact.penalty = 1;
  EXPECT_EQ(c.contacts, std::vector<Contact>{contact});
  Sphere sphere;
  sphere.radius = 2;
  sphere.penalty = 3;
  EXPECT_EQ(c.sphere, sphere);
  InitialVelocity initial;
  initial.group = "raster";
  EXPECT_EQ(c.initial_velocities, std::vector<InitialVelocity>{initial});
}

TEST(Reader, MeshAndMaterialsAreRead) {
  const CaseFolder folder;
  folder.write("geometry.geo", "");
  const Case c = read_case(folder.write("case.toml", complete));
  EXPECT_EQ(c.title, "Every key");
  EXPECT_EQ(c.file, folder.path() / "case.toml");
  EXPECT_EQ(c.mesh.file, folder.path() / "geometry.geo");
  EXPECT_EQ(c.mesh.parameters, (std::map<std::string, double>{{"h", 2.5}, {"n", 3}, {"odd name", 0.1}}));
  EXPECT_EQ(c.mesh.scale, 0.001);
  EXPECT_TRUE(c.mesh.glue);
  EXPECT_FALSE(c.mesh.repair_inverted);
  EXPECT_FALSE(c.mesh.raster.has_value());

  ASSERT_EQ(c.materials.size(), 3U);
  EXPECT_EQ(c.materials[0].group, "glass");
  EXPECT_EQ(c.materials[0].law, BulkLaw::green_st_venant);
  EXPECT_EQ(c.materials[0].young, 75e9);
  EXPECT_EQ(c.materials[0].poisson, 0.2);
  EXPECT_EQ(c.materials[0].density, 2456);
  EXPECT_EQ(c.materials[0].viscosity, 3);
  EXPECT_EQ(c.materials[0].joints, JointPlacement::breakable);
  EXPECT_EQ(c.materials[1].joints, JointPlacement::none);
  EXPECT_EQ(c.materials[1].law, BulkLaw::neo_hookean);
  EXPECT_EQ(c.materials[2].joints, JointPlacement::unbreakable);
  EXPECT_EQ(c.materials[2].density, 7800);
  EXPECT_EQ(c.materials[1].plasticity, DruckerPrager{});
  EXPECT_EQ(c.materials[2].law, BulkLaw::drucker_prager);
  const DruckerPrager& p = c.materials[2].plasticity;
  EXPECT_DOUBLE_EQ(p.friction_angle, std::numbers::pi / 5);
  EXPECT_DOUBLE_EQ(p.dilation_angle, std::numbers::pi / 20);
  EXPECT_EQ(p.cohesion, 8e6);
  EXPECT_EQ(p.hardening, 200e6);
  EXPECT_EQ(p.tension_cutoff, 2e6);
  EXPECT_EQ(p.cap_pressure, 150e6);
  EXPECT_EQ(p.cap_hardening, 2e9);
}

TEST(Reader, JointLawsAreRead) {
  const Case c = read_text(complete);
  ASSERT_EQ(c.joints.size(), 3U);
  const Joint& glass = c.joints[0];
  EXPECT_EQ(glass.groups, (std::array<std::string, 2>{"glass", "glass"}));
  EXPECT_EQ(glass.law, JointLaw::independent_peaks);
  EXPECT_EQ(glass.rise, JointRise::parabolic);
  EXPECT_EQ(glass.points, JointPoints::mid_edge);
  EXPECT_EQ(glass.penalty, 26.6e9);
  EXPECT_EQ(glass.size, 0.02);
  EXPECT_EQ(glass.tensile_strength, 10e6);
  EXPECT_EQ(glass.shear_strength, 20e6);
  EXPECT_DOUBLE_EQ(glass.friction, std::tan(std::numbers::pi / 6));
  EXPECT_EQ(glass.energy_mode_1, 10);
  EXPECT_EQ(glass.energy_mode_2, 30);
  EXPECT_FALSE(glass.energy_of_whole_curve);
  EXPECT_EQ(glass.points_to_fail, 2);
  EXPECT_EQ(glass.softening, Softening::z_curve);
  EXPECT_EQ(glass.a, 0.5);
  EXPECT_EQ(glass.b, 1.9);
  EXPECT_EQ(glass.c, 5);

  EXPECT_EQ(c.joints[1].groups, (std::array<std::string, 2>{"glass", "frame"}));
  EXPECT_EQ(c.joints[1].softening, Softening::exponential);
  EXPECT_EQ(c.joints[1].exponent, 4);
  EXPECT_EQ(c.joints[1].shear_strength, 1e6);
  EXPECT_EQ(c.joints[1].friction, 0.5);
}

TEST(Reader, APenaltyFactorMultipliesTheSmallerYoungsModulusOfTwoGroups) {
  EXPECT_EQ(read_text(complete).joints[1].penalty, 50 * 75e9);
}

TEST(Reader, AnUnbreakableGroupWithoutALawGetsOneWithTheDefaultPenalty) {
  const Joint frame = read_text(complete).joints[2];
  EXPECT_EQ(frame.groups, (std::array<std::string, 2>{"frame", "frame"}));
  EXPECT_EQ(frame.penalty, 100 * 2e11);
}

TEST(Reader, ContactsAndTheSphereAreRead) {
  const Case c = read_text(complete);
  ASSERT_EQ(c.contacts.size(), 1U);
  EXPECT_EQ(c.contacts[0].penalty, 7.5e12);
  EXPECT_EQ(c.contacts[0].plateau, 60e6);
  EXPECT_EQ(c.contacts[0].unloading_exponent, 2);
  EXPECT_EQ(c.contacts[0].friction, 0.3);
  EXPECT_EQ(c.contacts[0].friction_delay, 20);
  EXPECT_EQ(c.contacts[0].tangential_ratio, 0.8);
  EXPECT_EQ(c.contacts[0].damping_ratio, 0.2);
  EXPECT_EQ(c.contacts[0].points_on, PointsOn::both);
  EXPECT_EQ(c.contacts[0].initial_overlap, InitialOverlap::relax);
  EXPECT_EQ(c.contact_points.per_face, 6);
  EXPECT_EQ(c.contact_points.field, OverlapField::tet_distance);
  EXPECT_FALSE(c.contact_points.everywhere);
  EXPECT_EQ(c.contact_points.surfaces, (std::vector<std::string>{"slit", "top"}));
  ASSERT_TRUE(c.sphere.has_value());
  EXPECT_EQ(c.sphere->centre, Vec3(0, 0, 1));
  EXPECT_EQ(c.sphere->radius, 2);
  EXPECT_EQ(c.sphere->penalty, 400e6);
  EXPECT_EQ(c.broken_surfaces, std::vector<std::string>{"slit"});
}

TEST(Reader, StagesWithTheirConstraintsAndLoadsAreRead) {
  const Case c = read_text(complete);
  ASSERT_EQ(c.initial_velocities.size(), 1U);
  EXPECT_EQ(c.initial_velocities[0].velocity, Vec3(0, -3, 0));
  EXPECT_EQ(c.initial_velocities[0].random, (std::array<double, 2>{1, 137}));
  EXPECT_EQ(c.initial_velocities[0].seed, 7U);
  EXPECT_DOUBLE_EQ(c.initial_velocities[0].angular.z(), std::numbers::pi / 2);

  ASSERT_EQ(c.stages.size(), 2U);
  const Stage& impact = c.stages[0];
  EXPECT_EQ(impact.name, "impact");
  EXPECT_EQ(impact.end, 1e-4);
  EXPECT_EQ(impact.mass_damping, 10);
  EXPECT_EQ(impact.local_damping, 0.5);
  EXPECT_EQ(impact.broken_surfaces, std::vector<std::string>{"surface"});
  ASSERT_EQ(impact.constraints.size(), 3U);
  EXPECT_EQ(impact.constraints[0].kind, ConstraintKind::fixed);
  EXPECT_EQ(impact.constraints[0].axes, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(impact.constraints[1].kind, ConstraintKind::velocity);
  EXPECT_EQ(impact.constraints[1].axes, (std::array<bool, 3>{false, true, true}));
  EXPECT_EQ(impact.constraints[1].value[1].constant, -0.001);
  EXPECT_EQ(impact.constraints[1].value[2].linear, 2);
  EXPECT_EQ(impact.constraints[2].kind, ConstraintKind::displacement);
  EXPECT_EQ(impact.constraints[2].axes, (std::array<bool, 3>{true, false, false}));
  ASSERT_EQ(impact.pressures.size(), 1U);
  EXPECT_EQ(impact.pressures[0].value.linear, 20e9);
  EXPECT_EQ(c.stages[1].end, 1e-3);
}

TEST(Reader, TimeDetectionAndOutputAreRead) {
  const Case c = read_text(complete);
  EXPECT_EQ(c.time.step, 20e-9);
  EXPECT_EQ(c.time.safety, 0.5);
  EXPECT_EQ(c.time.max_steps, 2000);
  EXPECT_EQ(c.time.residual_limit, 0.01);
  EXPECT_EQ(c.time.energy_gain_limit, 0.002);
  EXPECT_EQ(c.detection.algorithm, DetectionAlgorithm::ms_slices);
  EXPECT_EQ(c.detection.buffer, 0.5e-3);
  EXPECT_EQ(c.detection.cell, 5e-3);
  EXPECT_TRUE(c.detection.verify);
  EXPECT_EQ(c.domains.kind, DomainKind::grid);
  EXPECT_EQ(c.domains.n, (std::array{2, 0, 1}));
  EXPECT_FALSE(c.domains.rebalance);
  EXPECT_EQ(c.domains.margin, 2.5);
  EXPECT_EQ(c.output.frame_interval, 1e-6);
  EXPECT_EQ(c.output.history_interval, 1e-7);
  EXPECT_FALSE(c.output.elements || c.output.joints || c.output.contacts);
  EXPECT_EQ(c.output.gauges, std::vector<std::string>{"support"});
}

TEST(Reader, ARasterIsRead) {
  const Case c = read_text(replaced(minimal, "cell_size = \"10 mm\"", R"(cell_size = ["1 mm", "1 mm", "2 mm"]
cells = [4, 4, 1]
boxes = 2
gap = "1 mm"
origin = ["-3 mm", 0, 0]
random_orientation = true
seed = 9
slit = { lower = ["-1 mm", 0, 0], upper = ["1 mm", 0, "2 mm"] })"));
  const Raster& r = c.mesh.raster.value();
  EXPECT_EQ(r.cells, (std::array<int, 3>{4, 4, 1}));
  EXPECT_EQ(r.boxes, (std::array<int, 3>{2, 2, 2}));
  EXPECT_EQ(r.cell_size, Vec3(0.001, 0.001, 0.002));
  EXPECT_EQ(r.gap, Vec3(0.001, 0.001, 0.001));
  EXPECT_EQ(r.origin, Vec3(-0.003, 0, 0));
  EXPECT_TRUE(r.random_orientation);
  EXPECT_FALSE(r.single_tetrahedra);
  EXPECT_EQ(r.seed, 9U);
  EXPECT_EQ(r.slit.value().upper, Vec3(0.001, 0, 0.002));
}

TEST(Reader, ALiveViewIsOfferedAllThatIsDrawnUnlessToldOtherwise) {
  const Case c = read_text(minimal + "[insitu.live]\n");
  // What ParaView can show; joints not broken yet are there for those who ask.
  EXPECT_EQ(c.insitu.live.value().channels,
            (std::vector<std::string>{"surface", "fractures", "contacts", "domains", "elements", "history"}));
  EXPECT_EQ(c.insitu.live->address, "localhost:22222");
  EXPECT_FALSE(c.insitu.live->remote);
  const Case told = read_text(minimal + "[insitu.live]\nchannels = [\"history\"]\n");
  EXPECT_EQ(told.insitu.live.value().channels, std::vector<std::string>{"history"});
}

TEST(Reader, AParameterOfAPipelineIsANumberOrATextOrBothWhereATextReadsAsAQuantity) {
  const Case c = read_text(minimal +
                           "[[insitu.pipeline]]\nname = \"stress\"\n"
                           "parameters = { width = 640, upper = \"30 MPa\", title = \"half open\", none = \"\" }\n");
  const std::map<std::string, Setting>& parameters = c.insitu.pipelines.at(0).parameters;
  EXPECT_EQ(parameters,
            (std::map<std::string, Setting>{
                {"width", {640, {}}}, {"upper", {3e7, "30 MPa"}}, {"title", {{}, "half open"}}, {"none", {{}, ""}}}));
}

TEST(Reader, APipelineIsHandedTheCellsOfABoxAndSomeFieldsAndHasProbes) {
  const Case c = read_text(complete);
  const Pipeline& fractures = c.insitu.pipelines.at(0);
  EXPECT_EQ(fractures.fields, (std::vector<std::string>{"id", "opening"}));
  EXPECT_EQ(fractures.region.value().upper, Vec3(0.01, 0.5, 1));
  EXPECT_EQ(c.insitu.live.value().region.value().lower, Vec3(0, 0, -0.001));
  const std::vector<Probe>& probes = c.insitu.pipelines.at(1).probes;
  ASSERT_EQ(probes.size(), 2U);
  EXPECT_EQ(probes[0].points, 1);
  EXPECT_EQ(probes[0].at, Vec3(0, 0, 0.001));
  EXPECT_EQ(probes[1].rows, 21);
  EXPECT_EQ(probes[1].across, Vec3(0, 0.02, 0));
  EXPECT_FALSE(read_text(minimal + "[insitu.live]\n").insitu.live->region);
}

TEST(Reader, SectionsRememberTheirLine) {
  const Case c = read_text(minimal);
  EXPECT_EQ(c.materials[0].origin.line, 3);
  EXPECT_EQ(c.materials[0].origin.key, "material[0]");
  EXPECT_EQ(c.stages[0].origin.line, 9);
}

}  // namespace
}  // namespace breccia::case_::reader_test
