#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/time_function.hpp"
#include "base/types.hpp"
#include "case/bulk_laws.hpp"
#include "case/experiment.hpp"
#include "case/origin.hpp"

/// A checked case as plain data: the user's settings in SI units, with all defaults. Keys of the case file stand in
/// comments; case/schema.hpp is their one table (unit, default, range, help).
namespace breccia::case_ {

inline constexpr const char* every_group = "*";  ///< in [[material]], [[joint]] and [[contact]]

/// Files beside the case file from which functions of time were read.
struct DataFiles {
  struct One {
    std::filesystem::path file;
    std::string key;                  ///< whose function it is part of
    std::string unit;                 ///< SI, of the values
    TimeFunction::Point first, last;  ///< in time
    double least = 0, largest = 0;    ///< values
    std::size_t num_points = 0;
  };
  std::vector<One> files;
  /// The functions are compared themselves.
  friend bool operator==(const DataFiles&, const DataFiles&) { return true; }
};

/// Raster of boxes, each a raster of cubes of 24 tetrahedra (six faces x four, apex at the cube's centre).
/// [mesh.raster]
struct Raster {
  std::array<int, 3> cells{1, 1, 1};  ///< cubes of one box along x, y, z
  Vec3 cell_size{1, 1, 1};            ///< m, edge of a cube along x, y, z
  std::array<int, 3> boxes{1, 1, 1};  ///< boxes along x, y, z
  Vec3 gap{0, 0, 0};                  ///< m, between neighbouring boxes
  Vec3 origin{0, 0, 0};               ///< m, lowest corner of the first box
  std::string group = "raster";       ///< physical volume group of every box; surfaces: <group>.x0 .x1 .y0 .y1 .z0 .z1
  bool single_tetrahedra = false;     ///< each box is one regular tetrahedron of edge cell_size.x instead of cubes
  bool random_orientation = false;    ///< turn every box about its centre by a random rotation
  std::uint64_t seed = 1;

  /// A planar cut through the boxes, along element faces: the surface group `<group>.slit`. Faces whose three corners
  /// lie in the closed box [lower, upper] (m, one extent zero) belong to it.
  struct Slit {
    Vec3 lower{0, 0, 0};
    Vec3 upper{0, 0, 0};
    friend bool operator==(const Slit&, const Slit&) = default;
  };
  std::optional<Slit> slit;
  friend bool operator==(const Raster&, const Raster&) = default;
};

/// [mesh]
struct MeshSource {
  std::filesystem::path file;                ///< of base/geometry_file.hpp, absolute; empty for a raster
  std::map<std::string, double> parameters;  ///< handed to a .geo (DefineConstant) as they are
  std::optional<Raster> raster;
  double scale = 1.0;           ///< file units to m
  double size = 0;              ///< m, edge of the elements of a solid; 0: automatic
  bool glue = false;            ///< conforming interfaces between volumes are glued
  double merge_nodes = 0;       ///< m, nodes of one solid that are no further apart become one; 0: none
  bool repair_inverted = true;  ///< swap two corners of negative elements; false refuses them
  double time_limit = 0;        ///< s, wall, for reading a file; 0: the default of the command
  double memory_limit = 0.8;    ///< share of this machine's memory, for reading a file
  bool trust = false;           ///< set on the command line only: a script may run programs and write files
  Origin origin;
  friend bool operator==(const MeshSource&, const MeshSource&) = default;
};

enum class PlaneKind { strain, stress };
enum class Axis { x, y, z };

/// [plane]: the model is a slice, one flat layer of elements extruded along an axis.
struct Plane {
  PlaneKind kind = PlaneKind::strain;
  Axis axis = Axis::z;  ///< across the layer
  Origin origin;
  friend bool operator==(const Plane&, const Plane&) = default;
};

/// [start]: the run continues from the state of another one, under this case.
struct Start {
  std::filesystem::path from;  ///< folder of the run, or one of its checkpoints; absolute
  double at = 0;               ///< s, time of the state; 0: of the last one
  std::int64_t step = 0;       ///< of the state; 0: not given by its step
  Origin origin;
  friend bool operator==(const Start&, const Start&) = default;
};

enum class JointPlacement { breakable, unbreakable, none };

/// [[material]]: one physical volume group.
struct Material {
  std::string group;  ///< "*": every one without an entry of its own; groups.hpp has which holds
  BulkLaw law = BulkLaw::neo_hookean;
  double young = 0;      ///< Pa
  double poisson = 0;    ///< -
  double density = 0;    ///< kg/m3
  double viscosity = 0;  ///< Pa s, mubar of the viscous term
  DruckerPrager plasticity;
  JointPlacement joints = JointPlacement::breakable;
  Origin origin;
  friend bool operator==(const Material&, const Material&) = default;
};

enum class JointLaw { mixed_mode, independent_peaks };
enum class JointRise { linear, parabolic };
enum class Softening { z_curve, linear, exponential };
enum class JointPoints { nodal, mid_edge };

/// [[joint]]: law of the joints inside a group, or on the glued interface of two groups.
struct Joint {
  std::array<std::string, 2> groups;  ///< equal for a group's own joints; "*" beside another stands for every group
  bool inside_any = false;            ///< groups are "*" and mean the joints inside each group without its own entry
  JointLaw law = JointLaw::mixed_mode;
  JointRise rise = JointRise::linear;
  JointPoints points = JointPoints::nodal;
  double penalty = 0;                 ///< Pa, p in k = p/h; penalty_factor x Young's modulus (the smaller one)
  double penalty_factor = 0;          ///< where groups hold "*" and the penalty depends on the pair; else 0
  double size = 0;                    ///< m, h in k = p/h; 0: mean edge length of the joints this entry governs
  double tensile_strength = 0;        ///< Pa
  double shear_strength = 0;          ///< Pa, cohesion
  double friction = 0;                ///< tan(phi): Mohr-Coulomb slope and friction on closed damaged joints
  double energy_mode_1 = 0;           ///< J/m2
  double energy_mode_2 = 0;           ///< J/m2
  bool energy_of_whole_curve = true;  ///< false: energies are those of the softening branch alone
  Softening softening = Softening::z_curve;
  double a = 0.63, b = 1.8, c = 6.0;  ///< z-curve
  double exponent = 5.0;              ///< exponential softening: z = (e^(-s D) - e^(-s)) / (1 - e^(-s))
  int points_to_fail = 3;
  double weibull_modulus = 0;      ///< of strengths that scatter from joint to joint; 0: they do not
  double weibull_area = 0;         ///< m2, of a joint whose mean strength is that above; 0: of every joint
  std::uint64_t weibull_seed = 1;  ///< of the scatter
  Origin origin;
  /// Of the joints inside a group, not of an interface.
  [[nodiscard]] bool inside() const { return groups[0] == groups[1] && (groups[0] != every_group || inside_any); }
  friend bool operator==(const Joint&, const Joint&) = default;
};

enum class OverlapField { body, tet_potential, tet_distance };
enum class InitialOverlap { refuse, relax, accept };
enum class PointsOn { both, first };
enum class Interaction { contact, none };

/// [[contact]]: normal and friction law of a pair of groups ("*" stands for every group), or that they do not interact.
struct Contact {
  std::array<std::string, 2> groups;
  Interaction interaction = Interaction::contact;           ///< none: no other key has an effect
  double penalty = 0;                                       ///< Pa, sigma_p: stress at overlap d = 1
  double penalty_factor = 0;                                ///< as Joint::penalty_factor
  double plateau = 0;                                       ///< Pa, sigma_T; 0: none
  double unloading_exponent = 1;                            ///< b >= 1
  double friction = 0;                                      ///< Coulomb mu
  double tangential_ratio = 1;                              ///< tangential over normal stiffness, 0..1
  double friction_delay = 6;                                ///< longest, in crossings of the smaller body; 0: none
  double damping_ratio = 0;                                 ///< of critical damping of a surface layer, 0..1
  PointsOn points_on = PointsOn::both;                      ///< groups whose points are felt by the other
  InitialOverlap initial_overlap = InitialOverlap::refuse;  ///< bodies of the pair that overlap before the first step
  Origin origin;
  friend bool operator==(const Contact&, const Contact&) = default;
};

/// [contact_points]
struct ContactPoints {
  int per_face = 4;  ///< 1, 3, 4 or 6
  OverlapField field = OverlapField::body;
  bool everywhere = true;  ///< false: only faces of `surfaces`
  std::vector<std::string> surfaces;
  Origin origin;
  friend bool operator==(const ContactPoints&, const ContactPoints&) = default;
};

/// [sphere]: a spherical boundary that keeps everything inside.
struct Sphere {
  Vec3 centre{0, 0, 0};
  double radius = 0;   ///< m
  double penalty = 0;  ///< Pa, as a contact penalty
  Origin origin;
  friend bool operator==(const Sphere&, const Sphere&) = default;
};

/// [[initial_velocity]]
struct InitialVelocity {
  std::string group;
  Vec3 velocity{0, 0, 0};              ///< m/s
  std::array<double, 2> random{0, 0};  ///< m/s; speed drawn uniformly in this range, direction uniform, by body; added
  std::uint64_t seed = 1;
  Vec3 angular{0, 0, 0};      ///< rad/s about each body's centre of mass; added
  Vec3 strain_rate{0, 0, 0};  ///< 1/s along the axes from each body's centre of mass; added
  Origin origin;
  friend bool operator==(const InitialVelocity&, const InitialVelocity&) = default;
};

enum class ConstraintKind { fixed, velocity, displacement };

/// [[stage.constraint]]: nodes of a volume, surface, curve or point group, by axis.
struct Constraint {
  std::string group;
  ConstraintKind kind = ConstraintKind::fixed;
  std::array<bool, 3> axes{false, false, false};
  std::array<TimeFunction, 3>
      value;  ///< m/s or m from the stage's start (velocity, displacement); time counted from the run's start
  Origin origin;
  friend bool operator==(const Constraint&, const Constraint&) = default;
};

/// [[stage.pressure]]: follows its faces; positive pushes into the body. Both sides of an inner surface are loaded.
struct Pressure {
  std::string surface;
  TimeFunction value;  ///< Pa
  Origin origin;
  friend bool operator==(const Pressure&, const Pressure&) = default;
};

/// [[stage.traction]]: force an area at rest, in a direction that stays. Both sides of an inner surface are loaded.
struct Traction {
  std::string surface;
  std::array<TimeFunction, 3> value;  ///< Pa
  Origin origin;
  friend bool operator==(const Traction&, const Traction&) = default;
};

/// [[stage.force]]: in a direction that stays, shared among the nodes of a volume, surface, curve or point group.
struct Force {
  std::string group;
  std::array<TimeFunction, 3> value;  ///< N, on the whole group
  Origin origin;
  friend bool operator==(const Force&, const Force&) = default;
};

/// [[stage]]
struct Stage {
  std::string name;
  double end = 0;                       ///< s, counted from the run's start
  std::string stop_when;                ///< a condition (case/expression.hpp) that ends it earlier; empty: none
  std::array<TimeFunction, 3> gravity;  ///< m/s2
  std::vector<Constraint> constraints;
  std::vector<Pressure> pressures;
  std::vector<Traction> tractions;
  std::vector<Force> forces;
  std::vector<std::string> absorbing;        ///< absorbing (viscous) surfaces
  double mass_damping = 0;                   ///< 1/s, alpha of f = -alpha m v
  double local_damping = 0;                  ///< 0..1, share of the unbalanced force, against the velocity
  std::vector<std::string> broken_surfaces;  ///< surfaces whose joints are broken when the stage starts
  Origin origin;
  friend bool operator==(const Stage&, const Stage&) = default;
};

/// [time]
struct TimeControl {
  double step = 0;                  ///< s; 0: safety x stable step
  double safety = 0.8;              ///< share of the stable step
  std::int64_t max_steps = 0;       ///< 0: no limit
  double residual_limit = 0.05;     ///< energy residual over the largest term that stops the run
  double energy_gain_limit = 0.01;  ///< energy gain over the largest term at which the run ends
  std::string stop_when;            ///< as of a stage; ends the run
  Origin origin;
  friend bool operator==(const TimeControl&, const TimeControl&) = default;
};

enum class DetectionAlgorithm { ms, ms_slices, sorted_grid, packed_tree, brute_force };

/// [detection]
struct Detection {
  DetectionAlgorithm algorithm = DetectionAlgorithm::packed_tree;
  double buffer = 0;    ///< m; 0: a share of the mean element size
  double cell = 0;      ///< m, of ms, ms_slices and sorted_grid; 0: chosen from buffer and element size
  bool verify = false;  ///< compare every step's couples with brute force
  friend bool operator==(const Detection&, const Detection&) = default;
};

enum class DomainKind { rcb, grid };
enum class Exchange { non_blocking, pairwise };

/// [domains]: how a run on several ranks divides the model.
struct Domains {
  DomainKind kind = DomainKind::rcb;
  std::array<int, 3> n{0, 0, 0};  ///< grid: domains along x, y, z; 0: automatic
  Exchange exchange = Exchange::non_blocking;
  bool rebalance = true;  ///< divide anew when ranks wait for each other
  double margin = 1;      ///< of the proxies, in mean longest edges of the elements
  double patience = 300;  ///< s, wall, that a rank waits for others before a warning; after twice as long the run ends
  Origin origin;
  friend bool operator==(const Domains&, const Domains&) = default;
};

/// [checkpoint]: when the whole state is written so that the run can be resumed. It is also written at the end of every
/// stage and of the run, and on request.
struct Checkpointing {
  std::int64_t steps = 0;      ///< between two; 0: not by steps
  double interval = 0;         ///< s, simulated; 0: not by simulated time
  double wall_interval = 300;  ///< s, wall; 0: not by wall time
  std::int64_t keep = 2;       ///< so many of the last; 0: none are written
  friend bool operator==(const Checkpointing&, const Checkpointing&) = default;
};

/// [output]
struct Output {
  double frame_interval = 0;    ///< s; 0: no frames but the last
  double history_interval = 0;  ///< s; 0: chosen by the run
  bool elements = true, joints = true, contacts = true;
  std::vector<std::string> gauges;  ///< groups, or bodies as "body 3", whose forces and motion are recorded
  Origin origin;
  friend bool operator==(const Output&, const Output&) = default;
};

/// A value of insitu.pipeline.parameters: as it is written, number or text. A text that reads as a quantity is both.
struct Setting {
  std::optional<double> number;  ///< SI
  std::optional<std::string> text;
  friend bool operator==(const Setting&, const Setting&) = default;
};

/// The closed box in which the centres of the cells lie that are handed to a pipeline, m.
struct Region {
  Vec3 lower{0, 0, 0};
  Vec3 upper{0, 0, 0};
  Origin origin;
  friend bool operator==(const Region&, const Region&) = default;
};

/// [[insitu.pipeline.probe]]: points at + i / (points - 1) along + j / (rows - 1) across, at which fields are recorded.
struct Probe {
  std::string name;
  Vec3 at{0, 0, 0};      ///< m, and so on
  Vec3 along{0, 0, 0};   ///< of points, 0 for one point
  Vec3 across{0, 0, 0};  ///< of rows, 0 for one row
  int points = 1, rows = 1;
  Origin origin;
  friend bool operator==(const Probe&, const Probe&) = default;
};

/// [[insitu.pipeline]]: processes the state during the run, at each of its triggers.
struct Pipeline {
  std::string name;               ///< one of the adaptor's own, or a script: an absolute path
  std::int64_t every_steps = 0;   ///< 0: not by steps, and so on
  double every_time = 0;          ///< s, simulated; a pipeline without any trigger runs 50 times
  double every_wall = 0;          ///< s
  std::int64_t every_broken = 0;  ///< joints
  bool first_break = false;
  bool strict = false;     ///< regardless of the cost
  std::int64_t least = 0;  ///< executions over the whole run, regardless of the cost
  std::map<std::string, Setting> parameters;
  std::optional<Region> region;
  std::vector<std::string> fields;  ///< empty: all
  std::vector<Probe> probes;        ///< of "probes" alone
  Origin origin;
  [[nodiscard]] bool has_trigger() const {
    return every_steps > 0 || every_time > 0 || every_wall > 0 || every_broken > 0 || first_break;
  }
  friend bool operator==(const Pipeline&, const Pipeline&) = default;
};

/// True for the name of a pipeline that is a script of the user's.
[[nodiscard]] inline bool is_script(const std::string& name) { return name.ends_with(".py"); }

/// True for the adaptor's own pipelines that make pictures.
[[nodiscard]] inline bool draws_pictures(const std::string& name) {
  return name == "fracture_growth" || name == "stress" || name == "ranks" || name == "contact_forces";
}

/// [insitu.live]
struct Live {
  std::string address;  ///< host:port at which ParaView listens
  bool remote = false;  ///< the host may be another machine
  double interval = 1;  ///< s, wall
  std::vector<std::string> channels;
  double max_overhead = 0.05;  ///< of the wall time
  std::optional<Region> region;
  std::vector<std::string> fields;  ///< empty: all
  Origin origin;
  friend bool operator==(const Live&, const Live&) = default;
};

enum class OnError { warn, stop };
enum class InSituBackend { automatic, paraview, catalyst2 };

/// [insitu]
struct InSitu {
  std::vector<Pipeline> pipelines;  ///< those of insitu.run included
  std::optional<Live> live;
  double max_overhead = 0.02;       ///< of the wall time
  std::int64_t least_instants = 0;  ///< of those of insitu.run
  OnError on_error = OnError::warn;
  InSituBackend backend = InSituBackend::automatic;
  Origin origin;
  [[nodiscard]] bool asked_for() const { return !pipelines.empty() || live; }
  friend bool operator==(const InSitu&, const InSitu&) = default;
};

struct Case {
  std::string title;
  std::filesystem::path file;  ///< absolute
  std::optional<Start> start;
  MeshSource mesh;  ///< neither file nor raster: that of the state, left out in the case file
  std::optional<Plane> plane;
  std::vector<Material> materials;
  std::vector<Joint> joints;
  std::vector<Contact> contacts;
  ContactPoints contact_points;
  std::optional<Sphere> sphere;
  std::vector<InitialVelocity> initial_velocities;
  std::vector<std::string> broken_surfaces;  ///< [joints] broken: surfaces whose joints are broken from the start
  Origin broken_origin;
  std::vector<Stage> stages;
  TimeControl time;
  Detection detection;
  Domains domains;
  Checkpointing checkpoint;
  Output output;
  std::vector<Gauge> gauges;
  std::vector<Trigger> triggers;
  InSitu insitu;
  DataFiles data;
  std::string resolved;  ///< the case as TOML, SI, every default written out; copied to the run folder
  friend bool operator==(const Case&, const Case&) = default;
};

}  // namespace breccia::case_
