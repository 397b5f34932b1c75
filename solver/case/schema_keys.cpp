#include <algorithm>
#include <array>

#include "case/schema_run_keys.hpp"

namespace breccia::case_ {
namespace {

// Packed by hand: with a line a field the table could not be read.
// clang-format off
constexpr auto model_keys = std::to_array<Key>({
    {.path = "title", .level = basic, .type = text, .fallback = "\"\"",
     .help = "One line that names the case; copied to all results.", .example = "\"Glass plate hit by a projectile\""},

    {.path = "start", .type = section,
     .help = "Start from the state of another run, with other loads, constraints, stages, strengths, contact laws or "
             "output. Time, steps and the energy put in are counted from that run. `breccia explain KEY` states which "
             "keys cannot change; sections of such keys may be omitted."},
    {.path = "start.from", .level = basic, .type = path, .required = true,
     .help = "Folder of a run, or one of its checkpoints (checkpoints/step_*.h5). Relative to the case file.",
     .example = "\"../settle/run\""},
    {.path = "start.at", .type = number, .unit = "s", .fallback = "last", .range = positive, .word = "last",
     .help = "Time of the checkpoint. last: the latest of a run that has ended.", .example = "\"2.4 s\""},
    {.path = "start.step", .type = integer, .fallback = "0", .range = steps,
     .help = "Step of the checkpoint, in place of its time; 0: by its time.", .example = "120000"},

    {.path = "mesh", .type = section, .required = true,
     .help = "Source of the tetrahedra: a file or the raster generator.",
     .fixed_by_state = "elements and nodes are those of the state"},
    {.path = "mesh.file", .level = basic, .type = path,
     .help = "Geometry (.geo) or mesh (.msh) of gmsh, solids as STEP (.step, .stp), BREP or STL, or a mesh of another "
             "program (.inp, .unv, .bdf, .mesh). Relative to the case file. Each volume and face of a "
             "solid is a group, named as in the STEP file, or volume_N and surface_N.",
     .example = "\"geometry.geo\""},
    {.path = "mesh.parameters", .level = basic, .type = parameters, .fallback = "{}",
     .help = "Numbers passed to a .geo file; each replaces the DefineConstant of its name. Plain numbers are passed "
             "unchanged. With a unit, lengths, areas and volumes are converted to the unit of length of the file "
             "(mesh.scale), all others to SI.", .example = "{ h = \"2.5 mm\", n = 3 }"},
    {.path = "mesh.scale", .level = basic, .type = number, .fallback = "1", .range = positive,
     .help = "Metres a unit of length of the mesh file: 0.001 for a file in millimetres. A STEP file states its unit.",
     .example = "0.001"},
    {.path = "mesh.size", .level = basic, .type = number, .unit = "m", .fallback = "auto", .range = positive,
     .word = "auto",
     .help = "Edge of the elements that a STEP, BREP or STL file is meshed with. auto: a tenth of the cube root of the "
             "volume of its box.", .example = "\"2.5 mm\""},
    {.path = "mesh.glue", .level = basic, .type = boolean, .fallback = "false",
     .help = "true: volumes that share a conforming interface are one body with joints there. false: they only touch.",
     .example = "true"},
    {.path = "mesh.merge_nodes", .type = number, .unit = "m", .fallback = "0", .range = not_negative,
     .help = "Distance up to which duplicate nodes are merged: within a volume; with mesh.glue also across volumes.",
     .example = "\"1 um\""},
    {.path = "mesh.inverted", .type = choice, .fallback = "repair", .choices = "refuse|repair",
     .help = "Elements of negative volume: repair swaps two corners, refuse lists their ids and ends.",
     .example = "\"refuse\""},
    {.path = "mesh.time_limit", .type = number, .unit = "s", .fallback = "auto", .range = positive, .word = "auto",
     .help = "Wall time after which reading or meshing a file is aborted. auto: an hour, a minute in `check` and "
             "`mesh`.", .example = "\"2 h\"", .fixed_by_state = may_change},
    {.path = "mesh.memory_limit", .type = number, .fallback = "0.8", .range = positive_share,
     .help = "Share of the machine's memory that reading or meshing a file may use, if it is available.",
     .example = "0.5", .fixed_by_state = may_change},

    {.path = "mesh.raster", .type = section,
     .help = "Generator of boxes in a raster, each box a raster of cubes of 24 tetrahedra. Surfaces are <group>.x0, "
             ".x1, .y0, .y1, .z0, .z1 and <group>.slit."},
    {.path = "mesh.raster.kind", .type = choice, .fallback = "cubes", .choices = "cubes|tetrahedra",
     .help = "Boxes of cubes of 24 tetrahedra, or one regular tetrahedron of edge cell_size a box.",
     .example = "\"tetrahedra\""},
    {.path = "mesh.raster.cells", .level = basic, .type = integers_or_one, .fallback = "[1, 1, 1]", .range = count,
     .help = "Cubes of one box along x, y and z.", .example = "[4, 4, 1]"},
    {.path = "mesh.raster.cell_size", .level = basic, .type = vector_or_number, .unit = "m", .required = true,
     .range = positive,
     .help = "Edges of a cube along x, y and z.", .example = "\"2.5 mm\""},
    {.path = "mesh.raster.boxes", .level = basic, .type = integers_or_one, .fallback = "[1, 1, 1]", .range = count,
     .help = "Boxes along x, y and z.", .example = "[8, 8, 8]"},
    {.path = "mesh.raster.gap", .type = vector_or_number, .unit = "m", .fallback = "[0, 0, 0]", .range = not_negative,
     .help = "Free space between neighbouring boxes along x, y and z.", .example = "\"1 mm\""},
    {.path = "mesh.raster.origin", .type = vector, .unit = "m", .fallback = "[0, 0, 0]",
     .help = "Lowest corner of the first box.", .example = "[\"-30 mm\", \"-30 mm\", 0]"},
    {.path = "mesh.raster.group", .level = basic, .type = text, .fallback = "raster",
     .help = "Name of the volume group of every box.",
     .example = "\"block\""},
    {.path = "mesh.raster.random_orientation", .type = boolean, .fallback = "false",
     .help = "Turn every box about its centre by a random rotation drawn from the seed.", .example = "true"},
    {.path = "mesh.raster.seed", .type = integer, .fallback = "1", .range = seed,
     .help = "Seed of the random orientations.", .example = "7"},

    {.path = "mesh.raster.slit", .type = section,
     .help = "A planar cut along element faces: the faces inside the closed box [lower, upper], flat along one axis, "
             "form the surface <group>.slit."},
    {.path = "mesh.raster.slit.lower", .type = vector, .unit = "m", .required = true,
     .help = "Lowest corner of the box that contains the faces of the slit.", .example = "[\"-10 mm\", 0, 0]"},
    {.path = "mesh.raster.slit.upper", .type = vector, .unit = "m", .required = true,
     .help = "Highest corner of the box that contains the faces of the slit.", .example = "[\"10 mm\", 0, \"10 mm\"]"},

    {.path = "plane", .type = section,
     .help = "Plane strain or stress: the model is a slice, one flat layer of elements about as thick as an element. "
             "Masses, loads and energies are those of the slice; its two flat sides have no contact points.",
     .fixed_by_state = "which faces carry contact points is part of the state"},
    {.path = "plane.kind", .level = basic, .type = choice, .required = true, .choices = "strain|stress",
     .help = "strain: no displacement along the axis, as inside a long body. stress: no stress along it, as in a thin "
             "plate: the lower side stays in its plane, the middle plane of a plate of twice the thickness, and the "
             "upper side is free. High pressure in the plane may make joints slide across the thickness.",
     .example = "\"strain\""},
    {.path = "plane.axis", .level = basic, .type = choice, .fallback = "z", .choices = "x|y|z",
     .help = "Axis across the layer.", .example = "\"y\""},

    {.path = "material[]", .type = section_list, .required = true,
     .help = "Law and density of a volume group, or of a list of groups."},
    {.path = "material[].group", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical volume group of the mesh, or a list of groups; \"*\": all without an entry of their own.",
     .example = "\"glass\""},
    {.path = "material[].law", .level = basic, .type = choice, .fallback = "neo_hookean", 
     .choices = "neo_hookean|green_st_venant|drucker_prager",
     .help = "Law of the bulk. neo_hookean: hyperelastic, no energy lost in a closed strain loop. green_st_venant: the "
             "published elastic law. drucker_prager: elastic-plastic, with the keys from friction_angle on. Elements "
             "of constant strain overestimate collapse loads of plastic flow without volume change.",
     .example = "\"drucker_prager\"", .fixed_by_state = "the internal variables of the elements belong to this law"},
    {.path = "material[].young", .level = basic, .type = number, .unit = "Pa", .required = true, .range = stiffnesses,
     .help = "Young's modulus.", .example = "\"75 GPa\""},
    {.path = "material[].poisson", .level = basic, .type = number, .required = true,
     .range = {.lower = -1, .upper = 0.5, .lower_open = true, .upper_open = true}, .help = "Poisson's ratio.",
     .example = "0.2"},
    {.path = "material[].density", .level = basic, .type = number, .unit = "kg/m3", .required = true,
     .range = densities,
     .help = "Mass density at rest.", .example = "\"2456 kg/m3\"",
     .fixed_by_state = "the momentum of the state belongs to its masses"},
    {.path = "material[].viscosity", .type = number, .unit = "Pa s", .fallback = "0", .range = viscosities,
     .help = "Viscosity mu of the stress 2 mu D added to the elastic one, D the rate of deformation.",
     .example = "\"10 Pa s\""},
    {.path = "material[].friction_angle", .level = basic, .type = number, .unit = "rad", .fallback = "0",
     .range = angle,
     .help = "Friction angle phi of the cone. With lateral pressure s the compressive strength is s (1 + sin phi)/(1 - "
             "sin phi) + 2 cohesion cos(phi)/(1 - sin phi).", .example = "\"35 deg\""},
    {.path = "material[].dilation_angle", .type = number, .unit = "rad", .fallback = "0", .range = angle,
     .help = "Dilation angle of the plastic flow, at most the friction angle: volume increase by shear.",
     .example = "\"10 deg\""},
    {.path = "material[].cohesion", .level = basic, .type = number, .unit = "Pa", .fallback = "0",
     .range = not_negative,
     .help = "Cohesion of the cone.", .example = "\"8 MPa\""},
    {.path = "material[].hardening", .type = number, .unit = "Pa", .fallback = "0", .range = not_negative,
     .help = "Increase of the cohesion per unit of plastic shear strain (engineering). Without friction the uniaxial "
             "compressive strength grows by 2 sqrt(3) times this per unit of plastic strain.",
     .example = "\"200 MPa\""},
    {.path = "material[].tension_cutoff", .type = number, .unit = "Pa", .fallback = "apex", .range = positive,
     .word = "apex", .help = "Largest mean stress. apex: that of the cone's tip, cohesion / tan(friction_angle).",
     .example = "\"2 MPa\""},
    {.path = "material[].cap_pressure", .type = number, .unit = "Pa", .fallback = "none", .range = positive,
     .word = "none", .help = "Pressure at which compaction (plastic decrease of volume) begins. none: no cap.",
     .example = "\"150 MPa\""},
    {.path = "material[].cap_hardening", .type = number, .unit = "Pa", .fallback = "0", .range = not_negative,
     .help = "Increase of the cap pressure per unit of compaction (logarithmic strain).", .example = "\"2 GPa\""},
    {.path = "material[].joints", .level = basic, .type = choice, .fallback = "breakable",
     .choices = "breakable|unbreakable|none",
     .help = "Joints between the elements of the group: breakable, unbreakable, or none (the elements share nodes, "
             "which is the cheapest).", .example = "\"none\"",
     .fixed_by_state = "shared nodes and contact couples are part of the state; strengths may change"},

    {.path = "joint[]", .type = section_list,
     .help = "Law of the joints inside a group, or on the glued interface of two groups, which can break if a strength "
             "is given. Every breakable group needs one. A named pair has priority over \"*\"."},
    {.path = "joint[].group", .level = basic, .type = text_or_list,
     .help = "Group whose inner joints follow this law, or a list of groups; \"*\": all with joints and without an "
             "entry of their own. Give this or between.", .example = "\"glass\""},
    {.path = "joint[].between", .level = basic, .type = text_pair,
     .help = "Two groups whose glued interface follows this law, also where both have joints = \"none\" inside. "
             "Without strengths it cannot break; between two breakable groups strengths are required. \"*\": every "
             "other group. Give this or group.", .example = "[\"brick\", \"mortar\"]"},
    {.path = "joint[].law", .type = choice, .fallback = "mixed_mode", .choices = "mixed_mode|independent_peaks",
     .help = "mixed_mode: elliptic onset; failure when the dissipated energies over energy_mode_1 and energy_mode_2 "
             "add up to 1. independent_peaks: each direction reaches its own strength (the published law).",
     .example = "\"independent_peaks\"",
     .fixed_by_state = "the damage of the state is of this law"},
    {.path = "joint[].rise", .type = choice, .fallback = "linear", .choices = "linear|parabolic",
     .help = "Shape of the traction curve before the peak.", .example = "\"parabolic\"",
     .fixed_by_state = "the set of joints that are evaluated individually is part of the state"},
    {.path = "joint[].points", .type = choice, .fallback = "nodal", .choices = "nodal|mid_edge",
     .help = "Integration points of a joint: its corners or the middles of its edges.", .example = "\"mid_edge\"",
     .fixed_by_state = "the damage of the state is that of these points"},
    {.path = "joint[].penalty", .type = number, .unit = "Pa", .range = stiffnesses,
     .help = "Penalty p of the joint stiffness k = p/h before the peak. Give this or penalty_factor.",
     .example = "\"26.6 GPa\""},
    {.path = "joint[].penalty_factor", .level = basic, .type = number, .fallback = "100", .range = positive,
     .help = "Joint penalty as a multiple of Young's modulus (the smaller one of two groups). Joints soften a body by "
             "about 2.7/penalty_factor.", .example = "50"},
    {.path = "joint[].size", .type = number, .unit = "m", .fallback = "auto", .range = positive, .word = "auto",
     .help = "Length h of the joint stiffness k = p/h. auto: the mean edge of the joints of this entry.",
     .example = "\"20 mm\""},
    {.path = "joint[].tensile_strength", .level = basic, .type = number, .unit = "Pa", .range = positive,
     .help = "Largest normal traction (tensile strength of a joint). Required where joints can fail. The strength of a "
             "specimen is higher, since cracks follow the edges of the mesh.", .example = "\"10 MPa\""},
    {.path = "joint[].shear_strength", .level = basic, .type = number, .unit = "Pa", .fallback = "= tensile_strength",
     .range = positive, .help = "Largest shear traction without normal pressure (cohesion).", .example = "\"20 MPa\""},
    {.path = "joint[].friction", .level = basic, .type = number, .fallback = "0", .range = not_negative,
     .help = "Coefficient of friction: slope of the Mohr-Coulomb strength, and friction of damaged or failed joints "
             "that are still closed. Undamped sliding interfaces vibrate, which reduces the mean friction; `breccia "
             "check` recommends a viscosity.", .example = "0.6"},
    {.path = "joint[].friction_angle", .type = number, .unit = "rad", .range = angle,
     .help = "Friction as an angle; its tangent is the coefficient. Give this or friction.", .example = "\"30 deg\""},
    {.path = "joint[].energy_mode_1", .level = basic, .type = number, .unit = "J/m2", .range = positive,
     .help = "Fracture energy of opening (mode I). Required where joints can fail.", .example = "\"10 J/m2\""},
    {.path = "joint[].energy_mode_2", .level = basic, .type = number, .unit = "J/m2", .fallback = "= energy_mode_1",
     .range = positive,
     .help = "Fracture energy of sliding (mode II).", .example = "\"30 N/m\""},
    {.path = "joint[].energy_counts", .type = choice, .fallback = "whole_curve",
     .choices = "softening_branch|whole_curve",
     .help = "Area that equals the fracture energy: the whole traction curve, or the part after the peak (published).",
     .example = "\"softening_branch\""},
    {.path = "joint[].points_to_fail", .type = integer, .fallback = "3", .range = {.lower = 1, .upper = 3},
     .help = "Number of points at full damage at which a joint is broken.", .example = "2"},
    {.path = "joint[].weibull_modulus", .type = number, .fallback = "none", .range = at_least_one, .word = "none",
     .help = "Weibull modulus of the scatter of strengths from joint to joint; the given strengths are the means. Both "
             "strengths of a joint scale by one factor; energies do not scatter. The standard deviation is about "
             "1.2/modulus of the mean. none: all joints are equally strong.", .example = "10",
     .fixed_by_state = "the strength of each joint relative to the mean is part of the state; the means may change"},
    {.path = "joint[].weibull_area", .type = number, .unit = "m2", .fallback = "none", .range = areas,
     .word = "none",
     .help = "Joint area at which the given mean strengths apply; a joint of area A has "
             "(weibull_area/A)^(1/weibull_modulus) times these, so that the strength does not depend on the mesh. "
             "none: no size effect.", .example = "\"4 mm2\"",
     .fixed_by_state = "the strength of each joint relative to the mean is part of the state; the means may change"},
    {.path = "joint[].weibull_seed", .type = integer, .fallback = "1", .range = seed,
     .help = "Seed of the sample of strengths; the sample is the same on every machine.", .example = "2",
     .fixed_by_state = "the strength of each joint relative to the mean is part of the state; the means may change"},

    {.path = "joint[].softening", .type = section, .help = "Shape of the traction curve after the peak."},
    {.path = "joint[].softening.kind", .type = choice, .fallback = "z_curve", .choices = "z_curve|linear|exponential",
     .help = "z_curve: fitted to concrete by a, b, c; a straight line; an exponential.", .example = "\"linear\""},
    {.path = "joint[].softening.a", .type = number, .fallback = "0.63", .range = not_negative,
     .help = "Parameter a of the z-curve.", .example = "0.63"},
    {.path = "joint[].softening.b", .type = number, .fallback = "1.8", .range = not_negative,
     .help = "Parameter b of the z-curve; a + b must be above 1.", .example = "1.8"},
    {.path = "joint[].softening.c", .type = number, .fallback = "6", .range = positive,
     .help = "Parameter c of the z-curve.", .example = "6"},
    {.path = "joint[].softening.exponent", .type = number, .fallback = "5",
     .range = {.lower = 0, .upper = 100, .lower_open = true},
     .help = "Exponent s of exponential softening, z = (exp(-s D) - exp(-s)) / (1 - exp(-s)).", .example = "5"},

    {.path = "contact[]", .type = section_list,
     .help = "Contact of a pair of groups. A named pair has priority over \"*\". Without any entry there is no "
             "contact."},
    {.path = "contact[].between", .level = basic, .type = text_pair, .required = true,
     .help = "Two groups; \"*\": every group.", .example = "[\"*\", \"*\"]"},
    {.path = "contact[].interaction", .level = basic, .type = choice, .fallback = "contact", .choices = "contact|none",
     .help = "none: no contact between the groups, fragments included; they pass through each other. For a group with "
             "itself: between its bodies and fragments. Such an entry has no other keys.", .example = "\"none\""},
    {.path = "contact[].penalty", .type = number, .unit = "Pa", .range = stiffnesses,
     .help = "Contact stress at overlap 1. The overlap is g/H, g in m, H the mean inradius of the elements of the "
             "target body (a sixth of an edge): the stiffness is penalty/H, Pa/m, which `breccia check` prints. Flat "
             "faces that both carry contact points press with up to twice that stress. Give this or penalty_factor.",
     .example = "\"7500 GPa\""},
    {.path = "contact[].penalty_factor", .level = basic, .type = number, .fallback = "1", .range = positive,
     .help = "Contact penalty as a multiple of Young's modulus (the smaller one of two groups). Recommended: 1; a "
             "third for flat impacts of breakable bodies with unequal meshes; up to 10 for small overlaps, at a "
             "shorter time step.", .example = "0.33"},
    {.path = "contact[].plateau", .type = number, .unit = "Pa", .fallback = "0", .range = not_negative,
     .help = "Largest stress sigma of loading at the points of a face; 0: none. Flat faces of area A that both carry "
             "points press with up to 2 A sigma. The penalty is limited to 400 plateau/b, b the unloading_exponent, so "
             "that time steps resolve the rise to the plateau; `breccia check` reports where this limit acts.",
     .example = "\"60 MPa\""},
    {.path = "contact[].unloading_exponent", .level = basic, .type = number, .fallback = "1", .range = {.lower = 1,
     .upper = 100},
     .help = "Exponent b of the unloading curve: 1 is elastic, larger values dissipate. Below the plateau 2/(b + 1) of "
             "the stored energy is recovered: a restitution of sqrt(2/(b + 1)) for bodies much stiffer than the "
             "penalty.", .example = "2"},
    {.path = "contact[].friction", .level = basic, .type = number, .fallback = "0", .range = not_negative,
     .help = "Coefficient of Coulomb friction.", .example = "0.3"},
    {.path = "contact[].friction_delay", .type = number, .fallback = "6", .range = not_negative,
     .help = "Largest delay with which friction follows the normal force, in wave transit times of the smaller body. "
             "It grows with the age of a contact, so impacts follow Coulomb's law without delay. 0: no delay; sliding "
             "elastic bodies then vibrate and the mean friction is too low. Coefficients above 0.6 may also need a "
             "viscosity (check recommends one).", .example = "0"},
    {.path = "contact[].tangential_ratio", .type = number, .fallback = "1", .range = share,
     .help = "Tangential over normal contact stiffness.", .example = "0.8"},
    {.path = "contact[].damping_ratio", .type = number, .fallback = "0", .range = share,
     .help = "Damping of the normal motion of bodies in contact, as a share of the critical damping of a surface layer "
             "of thickness H; dissipated by contact. It reduces rebound, hardly vibrations inside the bodies, and "
             "shortens the time step (`breccia check` reports it).", .example = "0.2"},
    {.path = "contact[].points_on", .type = choice, .fallback = "both", .choices = "both|first",
     .help = "Contact points that act on the other group: those of both groups, or of the first one only. Name a floor "
             "or a platen second: its points would catch the edges of the bodies that slide on it.",
     .example = "\"first\""},
    {.path = "contact[].initial_overlap", .type = choice, .fallback = "refuse", .choices = "refuse|relax|accept",
     .help = "Bodies that overlap before the first step: refuse ends with an error, relax subtracts the overlap as an "
             "offset without force, accept lets contact push them apart at once.", .example = "\"relax\"",
     .fixed_by_state = "it acts before the first step of the first run"},

    {.path = "contact_points", .type = section, .help = "Points on free faces at which contact is evaluated.",
     .fixed_by_state = "the contact of the points is part of the state"},
    {.path = "contact_points.per_face", .type = integer, .fallback = "4", .choices = "1|3|4|6",
     .help = "Points of each free face: of 4, three are its corners, so that contact with an edge or corner is "
             "detected at once; 1, 3 and 6 lie inside the face. 3 costs half as much in heaps of debris.",
     .example = "3"},
    {.path = "contact_points.field", .type = choice, .fallback = "body", .choices = "body|tet_potential|tet_distance",
     .help = "Measure of the overlap: a field that is continuous over a body, or the published potential or distance "
             "of each tetrahedron.", .example = "\"tet_potential\""},
    {.path = "contact_points.surfaces", .type = text_list,
     .help = "Surfaces whose faces carry contact points; without this key all free faces do.", .example = "[\"slit\"]"},

    {.path = "sphere", .type = section, .help = "A spherical boundary that encloses the model.",
     .fixed_by_state = "points of the state press on it at this place"},
    {.path = "sphere.centre", .type = vector, .unit = "m", .fallback = "[0, 0, 0]", .help = "Its centre.",
     .example = "[0, 0, \"1 m\"]"},
    {.path = "sphere.radius", .type = number, .unit = "m", .required = true, .range = positive, .help = "Its radius.",
     .example = "\"1 m\""},
    {.path = "sphere.penalty", .type = number, .unit = "Pa", .required = true, .range = stiffnesses,
     .help = "Contact stress at overlap 1, as of a contact.", .example = "\"400 MPa\"",
     .fixed_by_state = may_change},

    {.path = "joints", .type = section, .help = "Joints that are broken from the start of the run.",
     .fixed_by_state = "they were broken before the first step of the first run; stage.broken breaks more"},
    {.path = "joints.broken", .level = basic, .type = text_list, .fallback = "[]",
     .help = "Surfaces whose joints are broken from the start.", .example = "[\"slit\"]"},

    {.path = "initial_velocity[]", .type = section_list,
     .help = "Velocity of the bodies of a group at the start; parts add up. Joined elements are one body.",
     .fixed_by_state = "it was given before the first step of the first run; the velocities are those of the state"},
    {.path = "initial_velocity[].group", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical volume group, or a list of groups.", .example = "\"projectile\""},
    {.path = "initial_velocity[].velocity", .level = basic, .type = vector, .unit = "m/s", .fallback = "[0, 0, 0]",
     .help = "Velocity of all bodies of the group.", .example = "[0, \"-3 m/s\", 0]"},
    {.path = "initial_velocity[].random", .type = number_pair, .unit = "m/s", .fallback = "[0, 0]",
     .range = not_negative, .help = "Smallest and largest speed; each body gets a random one, in a random direction.",
     .example = "[0, \"137 m/s\"]"},
    {.path = "initial_velocity[].seed", .type = integer, .fallback = "1", .range = seed,
     .help = "Seed of the random velocities.", .example = "7"},
    {.path = "initial_velocity[].angular", .level = basic, .type = vector, .unit = "rad/s", .fallback = "[0, 0, 0]",
     .help = "Rotation of each body about its centre of mass. Masses are lumped at the nodes: moments of inertia of "
             "coarse bodies are above those of the solid.", .example = "[0, 0, \"90 deg/s\"]"},
    {.path = "initial_velocity[].strain_rate", .type = vector, .unit = "1/s", .fallback = "[0, 0, 0]",
     .help = "Stretching of each body along the axes: v_i = strain_rate_i (x_i - c_i), c its centre of mass. For bars "
             "and rings under uniform extension; a ring about z has the same rate along x and y.",
     .example = "[\"1000 1/s\", \"1000 1/s\", 0]"},

    {.path = "stage[]", .type = section_list, .required = true,
     .help = "A part of the run with its own loads and constraints; it starts from the final state of the previous "
             "stage."},
    {.path = "stage[].name", .level = basic, .type = text, .fallback = "\"\"",
     .help = "Name of the stage, for messages and --set.",
     .example = "\"impact\""},
    {.path = "stage[].end", .level = basic, .type = number, .unit = "s", .required = true, .range = durations,
     .help = "Time at which the stage ends, counted from the start of the run.", .example = "\"100 us\""},
    {.path = "stage[].stop_when", .type = text, .fallback = "\"\"",
     .help = "Condition over columns of the history that ends the stage before its end; later stages begin and end "
             "earlier by the same time, functions of time included. `breccia explain trigger.when` has the notation.",
     .example = "\"kinetic < 0.01 * peak(kinetic) for 1 ms\""},
    {.path = "stage[].gravity", .level = basic, .type = function_vector, .unit = "m/s2", .fallback = "[0, 0, 0]",
     .help = "Acceleration of gravity along x, y and z, functions of time.", .example = "[0, 0, \"-9.81 m/s2\"]"},
    {.path = "stage[].mass_damping", .type = number, .unit = "1/s", .fallback = "0", .range = not_negative,
     .help = "Factor alpha of the damping force -alpha m v.", .example = "\"10 1/s\""},
    {.path = "stage[].local_damping", .level = basic, .type = number, .fallback = "0",
     .range = {.lower = 0, .upper = 1, .upper_open = true},
     .help = "Damping against the velocity, as a share beta of the unbalanced force of each node; 0.3 to 0.5 find a "
             "state of rest quickly. The time step is divided by sqrt(5 + 5 beta). Not for motion of interest: moving "
             "bodies accelerate by 1 - beta only, sliding ones creep or stop, and reactions include the damping force. "
             "Check that the reactions (output.gauges) balance the loads.", .example = "0.5"},
    {.path = "stage[].broken", .level = basic, .type = text_list, .fallback = "[]",
     .help = "Surfaces whose joints are broken when the stage starts. The energy of these joints is dissipated in the "
             "mode in which they were opened.", .example = "[\"front\"]"},
    {.path = "stage[].absorbing", .type = text_list, .fallback = "[]",
     .help = "Free surfaces with absorbing (viscous) borders: tractions rho c_p v along the normal, rho c_s v across "
             "it. The constraint forces of the previous stage on their nodes continue, so that bodies at rest stay at "
             "rest. Not with mass_damping or local_damping.", .example = "[\"far\", \"bottom\"]"},

    {.path = "stage[].constraint[]", .type = section_list,
     .help = "Imposed motion of the nodes of a group: one of fixed, velocity and displacement. Axes not named are "
             "free. A patch of several nodes is clamped and cannot rotate; a straight curve acts as a hinge. Model a "
             "roller or pin as a small body that is constrained and presses through contact."},
    {.path = "stage[].constraint[].group", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical volume, surface, curve or point of the mesh, or a list of them. A curve or point constrains its "
             "nodes; volumes and surfaces have priority over curves and points of the same name. Constraints on a "
             "curve or point depend on the mesh: local compliance grows as elements become smaller.",
     .example = "\"support\""},
    {.path = "stage[].constraint[].fixed", .level = basic, .type = axes,
     .help = "Axes along which the nodes do not move.", .example = "\"xyz\""},
    {.path = "stage[].constraint[].velocity", .level = basic, .type = axis_functions, .unit = "m/s",
     .help = "Velocity by axis, functions of time. A velocity that jumps at the start sends a stress wave rho c v into "
             "bodies at rest; a ramp over many wave transit times does not.", .example = "{ y = \"-1 mm/s\" }"},
    {.path = "stage[].constraint[].displacement", .level = basic, .type = axis_functions, .unit = "m",
     .help = "Displacement by axis from the start of the stage, functions of time.",
     .example = "{ x = { table = [[0, 0], [\"1 ms\", \"1 mm\"]] } }"},

    {.path = "stage[].pressure[]", .type = section_list,
     .help = "Pressure on a surface; follows its faces. Both sides of an inner surface are loaded."},
    {.path = "stage[].pressure[].surface", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical surface group, or a list of groups.", .example = "\"slit\""},
    {.path = "stage[].pressure[].value", .level = basic, .type = function, .unit = "Pa", .required = true,
     .help = "Function of time; positive pushes into the body.", .example = "{ linear = \"20 GPa/s\" }"},

    {.path = "stage[].traction[]", .type = section_list,
     .help = "Force per unit of initial area on a surface, in a fixed direction. Both sides of an inner surface have "
             "the same load."},
    {.path = "stage[].traction[].surface", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical surface group, or a list of groups.", .example = "\"crest\""},
    {.path = "stage[].traction[].value", .level = basic, .type = function_vector, .unit = "Pa", .required = true,
     .help = "Along x, y and z, functions of time.", .example = "[\"1 MPa\", 0, \"-2 MPa\"]"},

    {.path = "stage[].force[]", .type = section_list,
     .help = "Total force on a group, in a fixed direction, distributed over its nodes: on a surface by initial area, "
             "on a volume, curve or point by mass. At a curve or point the local compliance grows as elements become "
             "smaller, and the loaded nodes may be torn off."},
    {.path = "stage[].force[].group", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical volume, surface, curve or point; each group of a list has the whole force.",
     .example = "\"loaded line\""},
    {.path = "stage[].force[].value", .level = basic, .type = function_vector, .unit = "N", .required = true,
     .help = "Along x, y and z, functions of time.", .example = "[0, \"-500 N\", 0]"},

    {.path = "time", .type = section, .help = "Time steps and limits that end a run early."},
    {.path = "time.step", .type = number, .unit = "s", .fallback = "auto", .range = positive, .word = "auto",
     .help = "Time step. auto: safety times the stable step.", .example = "\"20 ns\""},
    {.path = "time.safety", .type = number, .fallback = "0.8", .range = {.lower = 0, .upper = 1, .lower_open = true},
     .help = "Time step as a share of the stable time step.", .example = "0.5"},
    {.path = "time.max_steps", .type = integer, .fallback = "0", .range = steps,
     .help = "Steps after which the run ends; 0: no limit.", .example = "2000"},
    {.path = "time.residual_limit", .type = number, .fallback = "0.05", .range = positive,
     .help = "Largest unaccounted energy, as a share of the largest term of the budget; the run ends beyond it.",
     .example = "\"1 %\""},
    {.path = "time.energy_gain_limit", .type = number, .fallback = "0.01", .range = positive,
     .help = "Largest energy gain, as a share of the largest term of the budget: kinetic and stored energy above the "
             "initial energy plus the external work. The run ends beyond it. Terms of the size of round-off are "
             "exempt.", .example = "\"0.1 %\""},
    {.path = "time.stop_when", .type = text, .fallback = "\"\"",
     .help = "Condition over columns of the history that ends the run, as trigger.when.",
     .example = "\"abs(platen.reaction_z) < 0.5 * peak(abs(platen.reaction_z)) and broken_joints > 100\""},
});
// clang-format on

/// One table: the model, then its run.
constexpr auto kKeys = [] {
  std::array<Key, model_keys.size() + run_keys.size()> keys{};
  std::copy(run_keys.begin(), run_keys.end(), std::copy(model_keys.begin(), model_keys.end(), keys.begin()));
  return keys;
}();

}  // namespace

std::span<const Key> schema() { return kKeys; }

}  // namespace breccia::case_
