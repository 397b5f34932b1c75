#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "state/energy_budget.hpp"

namespace breccia {

/// One complete picture of the model at an instant: what every sink (files, in-situ adaptor) sees. Plain arrays, SI,
/// entries in order of global id, vectors and tensors interleaved (x y z; xx yy zz xy yz xz).
struct Frame {
  std::int64_t step = 0;
  double time = 0;
  std::int64_t number = 0;  ///< 0, 1, 2, ... over the run

  /// What elements remember that is shown as it is (MemoryField in physics/material/bulk_law.hpp).
  struct StateField {
    const char* name = "";
    int components = 1;
    std::vector<double> values{};  ///< (num_elements, components)
  };

  /// Values at the corners, in the order of the points, if requested: displacement (m) and velocity (m/s) of the
  /// element's own nodes; stress (Pa), what follows from it, and memory as means over the elements around the corner
  /// that are still connected there, weighted by their mass.
  struct AtPoints {
    std::vector<double> displacement, velocity;  ///< (num_points, 3)
    std::vector<double> stress;                  ///< (num_points, 6)
    std::vector<double> von_mises;               ///< (num_points) of that stress
    std::vector<double> principal;               ///< (num_points, 3) of that stress, descending
    std::vector<StateField> state;
  };

  struct Elements {
    std::vector<double> points;    ///< (4 num_elements, 3) corners: every element has its own
    std::vector<std::int64_t> id;  ///< (num_elements)
    std::vector<std::int32_t> body, material, rank;
    std::vector<std::int64_t> fragment;  ///< smallest element id of the fragment
    std::vector<double> stress;          ///< (num_elements, 6) Cauchy, Pa
    std::vector<double> von_mises;       ///< Pa
    std::vector<double> principal;       ///< (num_elements, 3) descending, Pa
    std::vector<double> velocity;        ///< (num_elements, 3) of the centroid, m/s
    std::vector<double> displacement;    ///< (num_elements, 3) of the centroid, m
    std::vector<double> cost;  ///< relative to an element that has its own nodes and neither active joint nor couple
    std::vector<double> mass;  ///< kg; not of surfaces, as the next
    std::vector<std::int64_t> neighbour;  ///< (num_elements, 4) element that is or was connected across the face
                                          ///< opposite to each corner, by a joint or shared nodes; -1: none
    std::vector<StateField> state;
    AtPoints at_points;
  } elements;

  /// Triangles on the mid-surface of the joints that carry damage or have failed.
  struct Joints {
    enum State : std::int32_t {
      elastic = 0,    ///< without damage: such joints are in no frame
      softening = 1,  ///< damaged, and holds
      failed = 2,     ///< closed somewhere: a frictional interface
      apart = 3       ///< failed, and has been open everywhere: its faces belong to contact
    };
    std::vector<double> points;           ///< (3 num_joints, 3)
    std::vector<std::int64_t> id;         ///< 4 a + face: across that face of element a lies the other, of higher id
    std::vector<double> damage;           ///< largest of the points, 0..1
    std::vector<std::int32_t> mode;       ///< 0 undamaged, 1 mostly mode I, 2 mostly mode II, 3 mixed
    std::vector<double> opening, slip;    ///< mean over the points, m; of those apart: as they were released
    std::vector<std::int32_t> broken;     ///< 0 or 1: its state is failed or apart
    std::vector<double> time_of_failure;  ///< s, start of the step in which it failed; -1: it holds
    std::vector<std::int32_t> state;      ///< State
    std::vector<double> energy;           ///< J dissipated in modes I and II so far, without friction
  } joints;

  /// Contact points that carry a force.
  struct Contacts {
    std::vector<std::int64_t> id;     ///< (num_contacts) of the couple: point * elements of the model + other_element
    std::vector<std::int64_t> point;  ///< (num_contacts) the contact point: 24 element + 6 face + number; it may touch
                                      ///< several elements
    std::vector<double> points;       ///< (num_contacts, 3)
    std::vector<double> force;        ///< (num_contacts, 3) on the point's body, N
    std::vector<double> normal_force, tangential_force;  ///< (num_contacts, 3) its parts, N
    std::vector<double> slip_velocity;                   ///< (num_contacts, 3) of the point over the other body, m/s
    std::vector<std::int32_t> body, other_body;
    std::vector<std::int64_t> other_element;  ///< (num_contacts) the one that the point is in
  } contacts;

  /// Free faces: of the bodies' surfaces, and both sides of every failed joint.
  struct Surface {
    Elements cells;                   ///< of the elements behind the faces; points are (3 num_faces, 3), outward sense
    std::vector<std::int32_t> face;   ///< (num_faces) 0..3, opposite to that corner
    std::vector<std::int32_t> crack;  ///< (num_faces) 1: laid bare by a joint that failed, 0: of the body's surface
  } surface;

  /// What this rank has to do; a rank without elements has no box.
  struct Domain {
    std::vector<double> points;      ///< (8, 3) box around its elements, corners in the order of VTK's hexahedron
    std::vector<std::int32_t> rank;  ///< (1), as the following
    std::vector<std::int64_t> elements, joints, couples;  ///< own elements; active joints and couples worked on
    std::vector<double> load;                             ///< working time over that of the mean rank, at the last
                                                          ///< evaluation
  } domain;
};

/// Requested parts of a frame; the others stay empty.
struct FrameParts {
  bool elements = true, joints = true, contacts = true, surface = false, domain = false;
  bool at_points = false;  ///< values at the corners of elements and surface too
};

/// What a gauge reads of a group or a body. Forces and places are of t_n, velocities and momentum of t_n + dt/2. Means
/// are weighted by mass; of a surface the mass is that of the nodes on it.
struct GaugeReading {
  Vec3 reaction{0, 0, 0};          ///< N, of constraints
  Vec3 contact_force{0, 0, 0};     ///< N
  Vec3 displacement{0, 0, 0};      ///< m, mean: of the centre of mass
  Vec3 max_displacement{0, 0, 0};  ///< m, component-wise signed value of largest magnitude
  Vec3 velocity{0, 0, 0};          ///< m/s, mean: of the centre of mass
  Vec3 centre{0, 0, 0};            ///< m, centre of mass
  Vec3 momentum{0, 0, 0};          ///< kg m/s
  Vec3 spin{0, 0, 0};              ///< rad/s, of the rigid body with the same angular momentum about the centre
  Vec3 force{0, 0, 0};             ///< N, resultant of all forces on it: what changes its momentum
  Vec3 torque{0, 0, 0};            ///< N m, of all forces on it about the centre: what changes its angular momentum
};

/// One line of the history file.
struct HistoryRow {
  std::int64_t step = 0;  ///< steps done before this instant, as in frames
  double time = 0;
  double time_step = 0;
  EnergyBudget energy;
  std::int64_t damaged_joints = 0, broken_joints = 0, broken_mode_1 = 0, broken_mode_2 = 0, fragments = 0, couples = 0,
               contacts = 0;
  double broken_area = 0, broken_area_mode_1 = 0, broken_area_mode_2 = 0;  ///< m2, reference, of failed joints
  Vec3 momentum{0, 0, 0}, angular_momentum{0, 0, 0};
  double max_speed = 0;
  double stress_yy_sum = 0;  ///< sum |sigma_yy| over the elements, Pa
  std::vector<GaugeReading> gauges;
  std::vector<double> at_points;       ///< of [[gauge]], in the order of their columns (case/history_columns.hpp)
  std::optional<double> insitu_share;  ///< of the wall time, that pipelines have taken on the first rank
};

/// Executions of a pipeline since the run began or was last resumed.
struct PipelineReport {
  std::string name;
  std::int64_t executed = 0, passed_over = 0, failed = 0;
  double start_s = 0;      ///< s, that the first execution took beyond a usual one: it starts what stays
  double seconds = 0;      ///< s, of all executions without that, on the slowest rank
  std::int64_t bytes = 0;  ///< written by all ranks
};

/// A condition of the case that became true.
struct ConditionReport {
  std::string key, when, action;  ///< "time.stop_when", the condition, "stop"
  std::int64_t times = 0, first_step = 0, last_step = 0;
  double first_time = 0, last_time = 0;                  ///< s
  std::vector<std::pair<std::string, double>> values{};  ///< that it read the last time, by their names
};

/// Extremes of a column of a gauge.
struct PeakReport {
  std::string gauge, quantity, unit;
  double largest = 0, largest_at = 0, smallest = 0, smallest_at = 0;  ///< and their times, s
  std::optional<double> first_peak{};                                 ///< output/peaks.hpp
  double first_peak_at = 0;                                           ///< s
};

/// Cost of the checkpoints since the run began or was last resumed.
struct CheckpointReport {
  std::int64_t written = 0, failed = 0;
  double pause_s = 0, longest_pause_s = 0;  ///< s, that steps waited for them: in all, at most
  std::uint64_t bytes = 0;                  ///< of the last one
};

/// Written to summary.json at the end of a run.
struct Summary {
  std::string title, version, host, status;  ///< status: "complete", "stopped: ..." or the error
  int ranks = 1;
  std::int64_t decompositions = 1;               ///< divisions of the model among the ranks
  double imbalance = 1;                          ///< largest over mean working time of the ranks, at the last
                                                 ///< evaluation
  std::int64_t messages = 0, message_bytes = 0;  ///< that gathered proxies, of all ranks, in span_s
  std::int64_t steps = 0;
  double simulated_time = 0, time_step = 0;
  std::int64_t elements = 0, joints = 0, broken_joints = 0, fragments = 0, searches = 0, inverted_elements = 0;
  double wall_s = 0, element_steps_per_s = 0;          ///< of the whole run, also of what other processes did of it
  double span_s = 0;                                   ///< s, of wall_s, that this process has worked on it
  std::int64_t resumed_at = -1;                        ///< step from which this process resumed; -1: from its start
  std::vector<std::pair<std::string, double>> phases;  ///< s, in span_s
  std::vector<PipelineReport> insitu;
  CheckpointReport checkpoints;
  std::vector<ConditionReport> conditions;  ///< of the whole run
  std::vector<PeakReport> peaks;            ///< likewise
  EnergyBudget energy;
  std::uint64_t max_rss_bytes = 0;
  std::string simd;        ///< "sse2", "avx2", "avx512"
  std::string state_hash;  ///< 16 hexadecimal digits
};

}  // namespace breccia
