#pragma once

#include <string>
#include <vector>

#include "advice/joint_measures.hpp"
#include "advice/overlaps.hpp"
#include "advice/sentences.hpp"
#include "advice/step_at_start.hpp"
#include "case/case.hpp"
#include "model/constraint_conflicts.hpp"
#include "model/model.hpp"

/// The rules of `check`, one function each; advice/rules.cpp is the table of them. Each returns its sentences, or none.
/// Models are of the whole mesh; a bare one is sufficient unless stated otherwise.
namespace breccia {

// overlaps.cpp
/// Where a run ends with an error. @param overlaps  of overlaps_by_groups
[[nodiscard]] Sentences overlapping_bodies(const case_::Case& input, const Model& model,
                                           const std::vector<GroupOverlap>& overlaps);

// unjoined_rules.cpp
/// Volumes of one group, or of any where mesh.glue is true, and bodies of one volume, that lie face to face and are not
/// joined there: the faces coincide within 1e-9 of the mesh's size, but have nodes of their own. Surfaces that the case
/// breaks and the boxes of a raster are meant to be apart. O(elements)
[[nodiscard]] Sentences unjoined_volumes(const case_::Case& input, const Mesh& mesh, const Topology& topology);
/// Initial velocities that turn, stretch or draw for one part of a body and not for the rest of it, which is joined to
/// that part. O(elements x entries)
[[nodiscard]] Sentences part_in_motion(const case_::Case& input, const Model& model);

// model_rules.cpp
/// Bodies without contact; those that a constraint holds in every stage cannot move into others.
[[nodiscard]] std::string bodies_without_contact(const case_::Case& input, const Model& model);
/// Joints that can break where there is no contact; nothing where bodies have none.
[[nodiscard]] std::string fragments_without_contact(const case_::Case& input, const Model& model);
/// A sphere that does not hold all of the model.
[[nodiscard]] std::string small_sphere(const Model& model);
/// A file without a unit whose numbers appear to be millimetres.
[[nodiscard]] std::string unit_of_lengths(const case_::Case& input, const Model& model);
/// A slice without [plane], thin beside what it measures along both other axes.
[[nodiscard]] std::string slice_without_plane(const case_::Case& input, const Model& model);
/// A layer of a plane model that is much thicker or thinner than its elements are wide.
[[nodiscard]] std::string slender_layer(const Model& model);
/// Joints all through a raster: that they lie in few planes decides at which load it breaks.
[[nodiscard]] std::string raster_planes(const case_::Case& input, const Model& model);

// entry_rules.cpp: entries of the case that do nothing
/// Tetrahedra in no physical volume.
[[nodiscard]] std::string elements_left_out(const Model& model);
/// A sphere around nothing.
[[nodiscard]] std::string empty_sphere(const Model& model);
/// Laws of interfaces that are nowhere.
[[nodiscard]] Sentences unused_joint_law(const case_::Case& input, const Model& model);
/// Initial velocities along constrained axes.
[[nodiscard]] Sentences lost_velocity(const case_::Case& input);
/// Loads and absorbing boundaries on surfaces whose motion is prescribed.
[[nodiscard]] Sentences load_on_held_nodes(const case_::Case& input, const Model& model);

// surface_rules.cpp
/// Surfaces within the model on which a pressure or an absorbing boundary does not act.
[[nodiscard]] Sentences load_within_the_model(const case_::Case& input, const Model& model);

// contact_rules.cpp
[[nodiscard]] std::string no_contact_points(const case_::Case& input, const Model& model);
/// A mass rho L on a spring penalty/H, both a unit of area, is stopped after v sqrt(rho L H / penalty): penalties too
/// soft to stop what comes.
[[nodiscard]] Sentences soft_penalty(const case_::Case& input, const Model& model);
/// Penalties too steep for their plateau.
[[nodiscard]] Sentences lowered_penalty(const case_::Case& input);
/// What is pressed between flat bodies without friction is in neutral equilibrium sideways.
[[nodiscard]] Sentences pressed_without_friction(const case_::Case& input, const Model& model);
/// Two entries of [[contact]] that fit a pair of groups and name as many of its groups: reported once, with the first.
[[nodiscard]] Sentences tied_contacts(const case_::Case& input, const Model& model);

// contact_point_rules.cpp
/// Groups with curved surfaces whose contact points, inside the faces, lie so far behind the corners that bodies come
/// noticeably nearer before they feel each other. Edges and corners proper, flat surfaces: nothing. O(elements)
[[nodiscard]] Sentences late_contact(const Model& model);
/// Pairs that both press with their points where those of one lie far apart beside the faces of the other, inside the
/// faces. O(elements + groups^2)
[[nodiscard]] Sentences coarse_contact_points(const Model& model);

// plausibility_rules.cpp: of the case alone
[[nodiscard]] Sentences implausible_material(const case_::Case& input);
[[nodiscard]] Sentences implausible_strength(const case_::Case& input);
[[nodiscard]] Sentences implausible_friction(const case_::Case& input);
/// Functions of time that have hardly begun when their stage ends.
[[nodiscard]] Sentences function_cut_off(const case_::Case& input);
/// Constraints or gravity that the stage before had.
[[nodiscard]] Sentences not_repeated_in_stage(const case_::Case& input);
/// Gravity, nothing that holds against it, and a base that absorbs from the start.
[[nodiscard]] std::string absorbing_under_gravity(const case_::Case& input);

// data_rules.cpp
/// Each function of time and the file it is read from, once: entries of several groups are read several times.
[[nodiscard]] std::vector<case_::DataFiles::One> data_files(const case_::Case& input);
/// Files that end before the stage that uses them, or of which the run uses next to nothing.
[[nodiscard]] Sentences data_file_times(const case_::Case& input);

// stage_rules.cpp
/// Loads that act at full size from the first step on bodies that rest and that nothing damps. One that lasts for few
/// crossings of a wave is meant to be a pulse.
[[nodiscard]] Sentences sudden_load(const case_::Case& input, const Model& model);
/// What slides without damping, or with too little.
[[nodiscard]] Sentences undamped_friction(const case_::Case& input, const Model& model);
/// Local damping in the last stage, where bodies should continue to slide; in earlier stages it finds a state of rest.
[[nodiscard]] std::string damped_sliding(const case_::Case& input, const Model& model);
/// Reactions of a stage that damps what its constraints drive.
[[nodiscard]] std::string damped_reactions(const case_::Case& input);
/// Constraints that overrule others on some of their nodes.
[[nodiscard]] Sentences overruled_constraint(const case_::Case& input, const Model& model);
/// Likewise of what has been found. @param conflicts  of the case
[[nodiscard]] Sentences overruled_constraints(const std::vector<ConstraintConflict>& conflicts);

// motion_rules.cpp
/// Of the prescribed motions that begin with a jump in speed, the one whose wave, rho c v in one dimension, is the
/// largest share of the tensile strength of joints that it comes to: in the driven solid, or in one that lies on it.
/// Empty: none comes to a tenth, or the stage is over within few crossings of a wave, so that a pulse is meant, or the
/// velocity before is unknown. O(elements x entries)
[[nodiscard]] std::string sudden_motion(const case_::Case& input, const Model& model);

// bending_rules.cpp
/// Slender solids that are few elements thick: linear tetrahedra are too stiff in bending, whose strain varies across
/// an element. Measured on cantilevers: deflection over that of theory = 1 / (1 + c (e/t)^2), e the edge of the regular
/// tetrahedron of the mean volume, t the thickness, c = 2.2 to 2.6 in unstructured meshes (e/t of 0.3 to 0.74) and 1.0
/// to 1.8 in rasters. O(elements)
[[nodiscard]] Sentences stiff_bending(const case_::Case& input, const Model& model);

// joint_rules.cpp
/// Joints whose stiffness makes a body noticeably softer.
[[nodiscard]] Sentences soft_joints(const Model& model, const AllJointMeasures& joints);
/// Elements larger than a third of the fracture process zone.
[[nodiscard]] Sentences coarse_for_process_zone(const Model& model, const AllJointMeasures& joints);
/// Joints that open fully within few steps: once one has begun to soften both sides of the crack leave with f_t/(rho c)
/// each, so that it takes D_n rho c / (2 f_t). Not where no step resolves it, which the previous rule reports.
/// @param dt  the step, s
[[nodiscard]] Sentences sudden_softening(const Model& model, const AllJointMeasures& joints, double dt);

// step_rules.cpp: models are not bare
/// What contact costs: its damping, its penalty, or, if neither, what it will cost once bodies meet.
[[nodiscard]] std::string step_of_contact(const case_::Case& input, const Model& model, const StepAtStart& start);
/// A viscosity that costs much of the step.
[[nodiscard]] std::string step_of_viscosity(const Model& model, const StepAtStart& start);
/// time.step above what is stable.
[[nodiscard]] std::string step_too_long(const case_::Case& input, const StepAtStart& start);
[[nodiscard]] std::string one_bad_element(const StepAtStart& start);
/// Slivers, where all other elements are known to allow a longer step.
[[nodiscard]] std::string slivers(const Model& model, const StepAtStart& start);

// output_rules.cpp
/// Frames of a run and the room they take.
struct FramesEstimate {
  double frames = 0;  ///< number
  double disk = 0;    ///< bytes, compressed, as long as few joints break
};
/// @param begun  s, time of the state that the run starts from;  @param steps  of the run
[[nodiscard]] FramesEstimate estimate_frames(const case_::Case& input, const Model& model, double begun, double steps);
[[nodiscard]] std::string many_frames(const FramesEstimate& estimate);
/// Intervals at which nothing happens before the run is over.
[[nodiscard]] Sentences long_interval(const case_::Case& input);

}  // namespace breccia
