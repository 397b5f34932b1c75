#include <algorithm>
#include <array>

#include "case/schema_run_keys.hpp"

namespace breccia::case_ {
namespace {

// Packed by hand: with a line a field the table could not be read.
// clang-format off
constexpr auto model_keys = std::to_array<Key>({
    {.path = "title", .level = basic, .type = text, .fallback = "\"\"",
     .help = "What the case shows, in a line; copied to every result.",
     .example = "\"Glass plate hit by a projectile\""},

    {.path = "start", .type = section,
     .help = "The run goes on from the state of another run, with other loads, constraints, stages, strengths, contact "
             "laws or output. Time and steps go on counting there, and so does the energy put in. `breccia explain "
             "KEY` says what cannot change; sections that cannot may be left out."},
    {.path = "start.from", .level = basic, .type = path, .required = true,
     .help = "Folder of a run, or one of its checkpoints (checkpoints/step_*.h5). Relative to the case file.",
     .example = "\"../settle/run\""},
    {.path = "start.at", .type = number, .unit = "s", .fallback = "last", .range = positive, .word = "last",
     .help = "Time of the checkpoint. last: the latest of a run that has ended.", .example = "\"2.4 s\""},
    {.path = "start.step", .type = integer, .fallback = "0", .range = steps,
     .help = "Step of the checkpoint, in place of its time; 0: by its time.", .example = "120000"},

    {.path = "mesh", .type = section, .required = true,
     .help = "Where the tetrahedra come from: a file or the raster generator.",
     .fixed_by_state = "elements and nodes are those of the state"},
    {.path = "mesh.file", .level = basic, .type = path,
     .help = "Geometry (.geo) or mesh (.msh) of gmsh, solids as STEP (.step, .stp), BREP or STL, or a mesh of another "
             "program (.inp, .unv, .bdf, .mesh). Relative to the case file. Each volume and face of a "
             "solid is a group, named as in the STEP file, or volume_N and surface_N.",
     .example = "\"geometry.geo\""},
    {.path = "mesh.parameters", .level = basic, .type = parameters, .fallback = "{}",
     .help = "Numbers handed to a .geo file, each in place of the DefineConstant of its name. Plain "
             "numbers are passed unchanged. With a unit, lengths, areas and volumes are converted to the unit of "
             "length of the file (mesh.scale), all else to SI.",
     .example = "{ h = \"2.5 mm\", n = 3 }"},
    {.path = "mesh.scale", .level = basic, .type = number, .fallback = "1", .range = positive,
     .help = "Metres a unit of length of the mesh file: 0.001 for a file in millimetres. A STEP file states its unit.",
     .example = "0.001"},
    {.path = "mesh.size", .level = basic, .type = number, .unit = "m", .fallback = "auto", .range = positive,
     .word = "auto",
     .help = "Edge of the elements that a STEP, BREP or STL file is meshed with. auto: a tenth of the cube root of the "
             "volume of its box.", .example = "\"2.5 mm\""},
    {.path = "mesh.glue", .level = basic, .type = boolean, .fallback = "false",
     .help = "Whether volumes that share a conforming interface are one body with joints there, or only touch.",
     .example = "true"},
    {.path = "mesh.merge_nodes", .type = number, .unit = "m", .fallback = "0", .range = not_negative,
     .help = "Distance up to which nodes that a mesh has twice become one: in a volume, with mesh.glue between any.",
     .example = "\"1 um\""},
    {.path = "mesh.inverted", .type = choice, .fallback = "repair", .choices = "refuse|repair",
     .help = "What happens to elements of negative volume: two corners are swapped, or the mesh is refused with their "
             "ids.", .example = "\"refuse\""},
    {.path = "mesh.time_limit", .type = number, .unit = "s", .fallback = "auto", .range = positive, .word = "auto",
     .help = "Wall time after which reading or meshing a file is given up. auto: an hour, a minute in `check` and "
             "`mesh`.", .example = "\"2 h\"", .fixed_by_state = may_change},
    {.path = "mesh.memory_limit", .type = number, .fallback = "0.8", .range = positive_share,
     .help = "Share of the machine's memory that reading or meshing a file may take, if it is available.",
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
    {.path = "mesh.raster.origin", .level = basic, .type = vector, .unit = "m", .fallback = "[0, 0, 0]",
     .help = "Lowest corner of the first box.", .example = "[\"-30 mm\", \"-30 mm\", 0]"},
    {.path = "mesh.raster.group", .level = basic, .type = text, .fallback = "raster",
     .help = "Name of the volume group of every box.",
     .example = "\"block\""},
    {.path = "mesh.raster.random_orientation", .type = boolean, .fallback = "false",
     .help = "Turn every box about its centre by a random rotation drawn from the seed.", .example = "true"},
    {.path = "mesh.raster.seed", .type = integer, .fallback = "1", .range = seed,
     .help = "Seed of the random orientations.", .example = "7"},

    {.path = "mesh.raster.slit", .type = section,
     .help = "A planar cut along element faces: faces inside the closed box [lower, upper], one extent of which is "
             "zero, are the surface <group>.slit."},
    {.path = "mesh.raster.slit.lower", .type = vector, .unit = "m", .required = true,
     .help = "Lowest corner of the box that holds the faces of the slit.", .example = "[\"-10 mm\", 0, 0]"},
    {.path = "mesh.raster.slit.upper", .type = vector, .unit = "m", .required = true,
     .help = "Highest corner of the box that holds the faces of the slit.", .example = "[\"10 mm\", 0, \"10 mm\"]"},

    {.path = "plane", .type = section,
     .help = "Plane strain or stress: the model is a slice, one flat layer of elements of the thickness of about one "
             "element. Masses, loads and energies are those of the slice; its two flat sides carry no contact points.",
     .fixed_by_state = "which faces carry contact points is part of the state"},
    {.path = "plane.kind", .level = basic, .type = choice, .required = true, .choices = "strain|stress",
     .help = "strain: nothing moves along the axis, as inside a long body. stress: nothing acts along it, as in a thin "
             "plate: the lower side stays in its plane, which is the middle one of a plate of twice the thickness, and "
             "the upper side is free. Strong pressure in the plane may make joints slide across the "
             "thickness.", .example = "\"strain\""},
    {.path = "plane.axis", .level = basic, .type = choice, .fallback = "z", .choices = "x|y|z",
     .help = "Axis across the layer.", .example = "\"y\""},

    {.path = "material[]", .type = section_list, .required = true,
     .help = "Law and density of a volume group, or of several that are alike."},
    {.path = "material[].group", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical volume group of the mesh, or a list of groups; \"*\": all without an entry of their own.",
     .example = "\"glass\""},
    {.path = "material[].law", .level = basic, .type = choice, .fallback = "neo_hookean", 
     .choices = "neo_hookean|green_st_venant|drucker_prager",
     .help = "Law of the bulk. neo_hookean, elastic, gives back all energy of a closed strain loop; green_st_venant is "
             "the published elastic law; drucker_prager yields and flows: the keys from friction_angle on are "
             "its. Elements of constant strain are too stiff where it flows without change of volume: a strip footing "
             "carries 45 % too much on five elements under half of it, 28 % on ten.",
     .example = "\"drucker_prager\"", .fixed_by_state = "what the elements remember is of this law"},
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
     .help = "Friction angle phi of the cone. A sample under lateral pressure s yields in compression at "
             "s (1 + sin phi)/(1 - sin phi) + 2 cohesion cos(phi)/(1 - sin phi).", .example = "\"35 deg\""},
    {.path = "material[].dilation_angle", .type = number, .unit = "rad", .fallback = "0", .range = angle,
     .help = "Dilation angle of the flow, at most the friction angle: how much volume shearing adds.",
     .example = "\"10 deg\""},
    {.path = "material[].cohesion", .level = basic, .type = number, .unit = "Pa", .fallback = "0",
     .range = not_negative,
     .help = "Cohesion of the cone.", .example = "\"8 MPa\""},
    {.path = "material[].hardening", .type = number, .unit = "Pa", .fallback = "0", .range = not_negative,
     .help = "Cohesion gained a unit of plastic shear strain (engineering). The strength of a sample in uniaxial "
             "compression grows by 2 sqrt(3) times this a unit of plastic strain, without friction.",
     .example = "\"200 MPa\""},
    {.path = "material[].tension_cutoff", .type = number, .unit = "Pa", .fallback = "apex", .range = positive,
     .word = "apex", .help = "Largest mean stress. apex: that of the cone's tip, cohesion / tan(friction_angle).",
     .example = "\"2 MPa\""},
    {.path = "material[].cap_pressure", .type = number, .unit = "Pa", .fallback = "none", .range = positive,
     .word = "none", .help = "Pressure at which the volume begins to be crushed. none: there is no cap.",
     .example = "\"150 MPa\""},
    {.path = "material[].cap_hardening", .type = number, .unit = "Pa", .fallback = "0", .range = not_negative,
     .help = "Cap pressure gained a unit of crushed volume (logarithmic strain).", .example = "\"2 GPa\""},
    {.path = "material[].joints", .level = basic, .type = choice, .fallback = "breakable",
     .choices = "breakable|unbreakable|none",
     .help = "Joints between the elements of the group: ones that can fail, ones that cannot, or none: then the "
             "elements share nodes.", .example = "\"none\"",
     .fixed_by_state = "who shares nodes and who may touch whom is part of the state; strengths may change"},

    {.path = "joint[]", .type = section_list,
     .help = "Law of the joints inside a group, or on the glued interface of two, which breaks where it has a "
             "strength. Every breakable group needs one. A pair by name goes before one with \"*\"."},
    {.path = "joint[].group", .level = basic, .type = text_or_list,
     .help = "Group whose inner joints follow this law, or a list of groups; \"*\": all with joints and without an "
             "entry of their own. Give this or between.", .example = "\"glass\""},
    {.path = "joint[].between", .level = basic, .type = text_pair,
     .help = "Two groups whose glued interface follows this law, also where both have joints = \"none\" inside. "
             "Without strengths it holds for good; between two breakable groups it needs them. \"*\" stands for every "
             "other group. Give this or group.", .example = "[\"brick\", \"mortar\"]"},
    {.path = "joint[].law", .type = choice, .fallback = "mixed_mode", .choices = "mixed_mode|independent_peaks",
     .help = "mixed_mode: elliptic onset; a joint has failed when what it took in mode I over energy_mode_1 and in "
             "mode II over energy_mode_2 add up to 1 (to about 1 % where a third of it is elastic). "
             "independent_peaks: each direction reaches its own strength (the published law).",
     .example = "\"independent_peaks\"",
     .fixed_by_state = "the damage of the state is of this law"},
    {.path = "joint[].rise", .type = choice, .fallback = "linear", .choices = "linear|parabolic",
     .help = "Shape of the traction before the peak.", .example = "\"parabolic\"",
     .fixed_by_state = "which joints are evaluated one by one is part of the state"},
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
     .help = "Length h of the joint stiffness k = p/h. auto: the mean edge of the joints that this entry governs.",
     .example = "\"20 mm\""},
    {.path = "joint[].tensile_strength", .level = basic, .type = number, .unit = "Pa", .range = positive,
     .help = "Greatest normal traction. Needed where joints can fail. A crack of an unstructured mesh follows edges: "
             "bars in tension broke at 11 to 20 % more than this, by mesh, at 7 to 11 % with a shear strength no "
             "larger; a cylinder in compression at 34 % above Mohr-Coulomb, also by the friction of its ends "
             "(meshes/cylinder); a Brazilian disc of a few process zones at 91 % more (meshes/disc).",
     .example = "\"10 MPa\""},
    {.path = "joint[].shear_strength", .level = basic, .type = number, .unit = "Pa", .fallback = "= tensile_strength",
     .range = positive, .help = "Greatest shear traction without normal pressure (cohesion).", .example = "\"20 MPa\""},
    {.path = "joint[].friction", .level = basic, .type = number, .fallback = "0", .range = not_negative,
     .help = "Coefficient of friction: slope of the Mohr-Coulomb strength, and friction of closed joints, damaged "
             "or failed, until they have opened. It follows the normal traction at once: interfaces that slide "
             "undamped vibrate and rub with 0.29 for 0.3, 0.55 to 0.57 for 0.6. The viscosity that check names cures "
             "that.", .example = "0.6"},
    {.path = "joint[].friction_angle", .type = number, .unit = "rad", .range = angle,
     .help = "Friction as an angle, whose tangent is the coefficient. Give this or friction.", .example = "\"30 deg\""},
    {.path = "joint[].energy_mode_1", .level = basic, .type = number, .unit = "J/m2", .range = positive,
     .help = "Fracture energy of opening. Needed where joints can fail.", .example = "\"10 J/m2\""},
    {.path = "joint[].energy_mode_2", .level = basic, .type = number, .unit = "J/m2", .fallback = "= energy_mode_1",
     .range = positive,
     .help = "Fracture energy of sliding.", .example = "\"30 N/m\""},
    {.path = "joint[].energy_counts", .type = choice, .fallback = "whole_curve",
     .choices = "softening_branch|whole_curve",
     .help = "What the fracture energies are the area of: the whole traction curve, or the part after the peak "
             "(published).", .example = "\"softening_branch\""},
    {.path = "joint[].points_to_fail", .type = integer, .fallback = "3", .range = {.lower = 1, .upper = 3},
     .help = "Points of full damage that make a joint broken.", .example = "2"},
    {.path = "joint[].weibull_modulus", .type = number, .fallback = "none", .range = at_least_one, .word = "none",
     .help = "Strengths scatter from joint to joint after Weibull, with this modulus, about the given ones as means; "
             "both of a joint by one factor, energies not. The standard deviation is about 1.2/modulus of the mean. "
             "none: all joints are equally strong, and an evenly loaded body of regular elements breaks everywhere at "
             "once.", .example = "10",
     .fixed_by_state = "how strong each joint is against the mean is part of the state; the means may change"},
    {.path = "joint[].weibull_area", .type = number, .unit = "m2", .fallback = "none", .range = areas,
     .word = "none",
     .help = "Area of the joints that have the given mean strengths; those of area A have (weibull_area/A)^(1/"
             "weibull_modulus) times these, so that a finer mesh does not find weaker spots. none: the size of a joint "
             "does not matter.", .example = "\"4 mm2\"",
     .fixed_by_state = "how strong each joint is against the mean is part of the state; the means may change"},
    {.path = "joint[].weibull_seed", .type = integer, .fallback = "1", .range = seed,
     .help = "Another seed gives another sample of strengths; the same gives the same on every machine.",
     .example = "2",
     .fixed_by_state = "how strong each joint is against the mean is part of the state; the means may change"},

    {.path = "joint[].softening", .type = section, .help = "Shape of the traction after the peak."},
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
     .help = "Contact of a pair of groups. A pair by name goes before one with \"*\". A case without any has none."},
    {.path = "contact[].between", .level = basic, .type = text_pair, .required = true,
     .help = "Two groups; \"*\": every group.", .example = "[\"*\", \"*\"]"},
    {.path = "contact[].interaction", .level = basic, .type = choice, .fallback = "contact", .choices = "contact|none",
     .help = "none: the groups do not meet: each passes through the other, also what fractures free later; of a group "
             "with itself, its bodies and fragments. Such an entry has no other keys.", .example = "\"none\""},
    {.path = "contact[].penalty", .type = number, .unit = "Pa", .range = stiffnesses,
     .help = "Contact stress at overlap 1. The overlap is g/H, g in m, H the mean inradius of the elements of the body "
             "that is entered (a fifth of an edge), so the stiffness is penalty/H, Pa/m; `breccia check` prints both "
             "for every pair. Where flat faces meet and both carry points, both press: up to twice that stress. Give "
             "this or penalty_factor.", .example = "\"7500 GPa\""},
    {.path = "contact[].penalty_factor", .level = basic, .type = number, .fallback = "1", .range = positive,
     .help = "Contact penalty as a multiple of Young's modulus (the smaller one of two groups). A third where "
             "breakable bodies with unequal meshes strike each other flat (points that hit first damage joints); up to 10 where "
             "overlaps must be small, for a time step up to three times shorter; of bodies that slide see friction.",
     .example = "0.33"},
    {.path = "contact[].plateau", .type = number, .unit = "Pa", .fallback = "0", .range = not_negative,
     .help = "Stress sigma that loading of the points of a face does not pass; 0: none. Flat faces of area A that both "
             "carry points press with up to 2 A sigma. Measured on two cubes: 1.9 A sigma, and 0.94 with points_on = "
             "\"first\", as points near edges lie less deep. It begins at an overlap of b/400 at least, b the "
             "unloading_exponent, about b/2000 of an edge: a penalty above 400 plateau/b acts as that (check says so). "
             "Steps that do not resolve the way to the plateau would let bodies sink and gain energy.",
     .example = "\"60 MPa\""},
    {.path = "contact[].unloading_exponent", .level = basic, .type = number, .fallback = "1", .range = {.lower = 1,
     .upper = 100},
     .help = "Exponent b of the unloading curve: 1 gives all energy back, more dissipates. Below the plateau 2/(b + 1) "
             "of what contact stores comes back, a restitution of sqrt(2/(b + 1)) for bodies far stiffer than the "
             "penalty: 0.82 for 2, 0.71 for 3, 0.47 for 8.", .example = "2"},
    {.path = "contact[].friction", .level = basic, .type = number, .fallback = "0", .range = not_negative,
     .help = "Coefficient of Coulomb friction.", .example = "0.3"},
    {.path = "contact[].friction_delay", .type = number, .fallback = "6", .range = not_negative,
     .help = "Longest delay with which friction follows the normal force, in crossings of the smaller body by a wave "
             "(Young's modulus or the penalty, whichever is smaller). It grows with the age of a contact: impacts rub "
             "by Coulomb's law at once. 0: no delay; elastic bodies that slide then vibrate, lift off and rub too "
             "little: driven plates with 0.19 to 0.27 for 0.3 and 0.28 to 0.43 for 0.6, with the delay 0.300 and "
             "0.600. Beyond 0.6 they may also need a viscosity (check names one).", .example = "0"},
    {.path = "contact[].tangential_ratio", .type = number, .fallback = "1", .range = share,
     .help = "Tangential over normal contact stiffness.", .example = "0.8"},
    {.path = "contact[].damping_ratio", .type = number, .fallback = "0", .range = share,
     .help = "Damping of approach and retreat while bodies press on each other, as a share of the critical damping of "
             "a surface layer as thick as H. Accounted as dissipated by contact. It shortens the time step, the more "
             "the smaller the elements are beside H: 0.1 by a fifth to two thirds, 1 to a fifth or a tenth (check "
             "tells). It damps bodies that bounce, hardly vibrations inside of them: a cube that falls flat on a floor "
             "comes back with 1.000, 0.919, 0.781 and 0.480 of its speed for 0, 0.1, 0.3 and 1.", .example = "0.2"},
    {.path = "contact[].points_on", .type = choice, .fallback = "both", .choices = "both|first",
     .help = "Whose contact points are felt by the other group: those of both, or of the group named first alone. A "
             "floor is best named second: its points would catch the edges of what slides on it, and those of platens "
             "drive a narrower body between them out sideways where there is no friction.", .example = "\"first\""},
    {.path = "contact[].initial_overlap", .type = choice, .fallback = "refuse", .choices = "refuse|relax|accept",
     .help = "What to do with bodies that overlap before the first step: end with an error, take the overlap out as an "
             "offset without force, or let contact push them apart at once.", .example = "\"relax\"",
     .fixed_by_state = "it acts before the first step of the first run"},

    {.path = "contact_points", .type = section, .help = "Points on free faces at which contact is felt.",
     .fixed_by_state = "what the points touch is part of the state"},
    {.path = "contact_points.per_face", .type = integer, .fallback = "3", .choices = "1|3|4|6",
     .help = "Points a free face: 1, 3 and 6 lie inside of it; of 4 points three are its corners, so that what "
             "touches a face with an edge or corner is felt at once; edges that cross between nodes sink in by a fifth "
             "of an element's edge first. With 3 a base is narrower by a sixth of an edge on "
             "each side: a block of four elements that should topple at 18.4 degrees stands at 16.5 and topples at "
             "17, with 4 points it stands at 18 and topples at 18.3.",
     .example = "4"},
    {.path = "contact_points.field", .type = choice, .fallback = "body", .choices = "body|tet_potential|tet_distance",
     .help = "How overlap is measured: by a field continuous over a body, or by the published potential or distance of "
             "each tetrahedron.", .example = "\"tet_potential\""},
    {.path = "contact_points.surfaces", .type = text_list,
     .help = "Only the faces of these surfaces carry points; without this key all free faces do.",
     .example = "[\"slit\"]"},
    {.path = "contact_points.field_ramp_steps", .type = integer, .fallback = "50", .range = count,
     .help = "Steps over which the overlap field follows a surface that a fracture has freed.", .example = "100",
     .fixed_by_state = may_change},

    {.path = "sphere", .type = section, .help = "A spherical boundary that keeps everything inside.",
     .fixed_by_state = "points of the state press on it where it is"},
    {.path = "sphere.centre", .type = vector, .unit = "m", .fallback = "[0, 0, 0]", .help = "Its centre.",
     .example = "[0, 0, \"1 m\"]"},
    {.path = "sphere.radius", .type = number, .unit = "m", .required = true, .range = positive, .help = "Its radius.",
     .example = "\"1 m\""},
    {.path = "sphere.penalty", .type = number, .unit = "Pa", .required = true, .range = stiffnesses,
     .help = "Contact stress at overlap 1, as of a contact.", .example = "\"400 MPa\"",
     .fixed_by_state = may_change},

    {.path = "joints", .type = section, .help = "Joints that are special from the start of the run.",
     .fixed_by_state = "they were broken before the first step of the first run; stage.broken breaks more"},
    {.path = "joints.broken", .level = basic, .type = text_list, .fallback = "[]",
     .help = "Surfaces whose joints are broken from the start.", .example = "[\"slit\"]"},

    {.path = "initial_velocity[]", .type = section_list,
     .help = "Velocity of the bodies of a group at the start; its parts add up. What is joined is one body.",
     .fixed_by_state = "it was given before the first step of the first run; the velocities are those of the state"},
    {.path = "initial_velocity[].group", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical volume group, or a list of groups.", .example = "\"projectile\""},
    {.path = "initial_velocity[].velocity", .level = basic, .type = vector, .unit = "m/s", .fallback = "[0, 0, 0]",
     .help = "Of all bodies alike.", .example = "[0, \"-3 m/s\", 0]"},
    {.path = "initial_velocity[].random", .type = number_pair, .unit = "m/s", .fallback = "[0, 0]",
     .range = not_negative, .help = "Smallest and greatest speed; one is drawn for every body, in a random direction.",
     .example = "[0, \"137 m/s\"]"},
    {.path = "initial_velocity[].seed", .type = integer, .fallback = "1", .range = seed,
     .help = "Seed of the random velocities.", .example = "7"},
    {.path = "initial_velocity[].angular", .level = basic, .type = vector, .unit = "rad/s", .fallback = "[0, 0, 0]",
     .help = "Rotation of each body about its centre of mass. Masses are lumped at the nodes: moments of inertia of a "
             "coarse body are above those of the solid, 12 to 30 % for a box of 1 x 2 x 3 cells.",
     .example = "[0, 0, \"90 deg/s\"]"},
    {.path = "initial_velocity[].strain_rate", .type = vector, .unit = "1/s", .fallback = "[0, 0, 0]",
     .help = "Stretching of each body along the axes: v_i = strain_rate_i (x_i - c_i), c its centre of mass. For bars "
             "and rings that are torn at once along their length; a ring about z has the same rate along x and y.",
     .example = "[\"1000 1/s\", \"1000 1/s\", 0]"},

    {.path = "stage[]", .type = section_list, .required = true,
     .help = "A part of the run with its own loads and constraints; it starts from the state in which the previous one "
             "ended."},
    {.path = "stage[].name", .level = basic, .type = text, .fallback = "\"\"",
     .help = "Name of the stage, for messages and --set.",
     .example = "\"impact\""},
    {.path = "stage[].end", .level = basic, .type = number, .unit = "s", .required = true, .range = durations,
     .help = "Time at which the stage ends, counted from the start of the run.", .example = "\"100 us\""},
    {.path = "stage[].gravity", .level = basic, .type = function_vector, .unit = "m/s2", .fallback = "[0, 0, 0]",
     .help = "Acceleration of gravity along x, y and z, as functions of time.", .example = "[0, 0, \"-9.81 m/s2\"]"},
    {.path = "stage[].mass_damping", .type = number, .unit = "1/s", .fallback = "0", .range = not_negative,
     .help = "Factor alpha of the damping force -alpha m v.", .example = "\"10 1/s\""},
    {.path = "stage[].local_damping", .level = basic, .type = number, .fallback = "0",
     .range = {.lower = 0, .upper = 1, .upper_open = true},
     .help = "Damping against the velocity, as a share beta of the unbalanced force on each node: 0.3 to 0.5 find a "
             "state of rest quickly. The step is shorter by sqrt(5 + 5 beta). What has come to rest is in equilibrium "
             "only where the reactions (output.gauges) carry the loads: vibrations of stiff joints hold back what "
             "bends slowly (after three periods a beam carried 90 % of a sudden load with 0.8, all of it with 0.5, and "
             "all of a load that grew over one period with 0.8). Not where something is to move: a body "
             "falls with 1 - beta of its acceleration, and one that slides on a joint or a rough surface creeps or "
             "stops, since its vibrations are damped at the cost of what drives it. Nor where reactions are recorded "
             "(output.gauges) while anything accelerates or breaks: they include what the damping takes, 1/(1 - beta) "
             "times the force where a body is accelerated.",
     .example = "0.5"},
    {.path = "stage[].broken", .level = basic, .type = text_list, .fallback = "[]",
     .help = "Surfaces whose joints are broken when the stage starts. What they hold by then counts as dissipated in "
             "the mode in which they were opened.", .example = "[\"front\"]"},
    {.path = "stage[].absorbing", .type = text_list, .fallback = "[]",
     .help = "Free surfaces behind which the material goes on: waves leave through them (tractions rho c_p v along the "
             "normal, rho c_s v across it). The forces with which constraints of the stage before held their nodes go "
             "on, so what was at rest stays there. Not with mass_damping or local_damping.",
     .example = "[\"far\", \"bottom\"]"},

    {.path = "stage[].constraint[]", .type = section_list,
     .help = "Imposed motion of the nodes of a group: one of fixed, velocity and displacement. Axes not named stay "
             "free. A patch of several nodes is clamped: it cannot turn; what is held along a straight curve turns "
             "about it as on a hinge. A roller or a pin is a small body of its own that is held or driven and presses "
             "through contact."},
    {.path = "stage[].constraint[].group", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical volume, surface, curve or point of the mesh, or a list of them. A curve or point means its "
             "nodes, and is meant only where no volume or surface has its name. What is held there alone yields the "
             "more, the finer the elements around it are.", .example = "\"support\""},
    {.path = "stage[].constraint[].fixed", .level = basic, .type = axes,
     .help = "Axes along which the nodes stay where they are.",
     .example = "\"xyz\""},
    {.path = "stage[].constraint[].velocity", .level = basic, .type = axis_functions, .unit = "m/s",
     .help = "Velocity by axis, functions of time. One that is not 0 at the start strikes what rests with a wave of "
             "stress rho c v; a ramp over many crossings of a wave does not.", .example = "{ y = \"-1 mm/s\" }"},
    {.path = "stage[].constraint[].displacement", .level = basic, .type = axis_functions, .unit = "m",
     .help = "Displacement by axis since the start of the stage, functions of time.",
     .example = "{ x = { table = [[0, 0], [\"1 ms\", \"1 mm\"]] } }"},

    {.path = "stage[].pressure[]", .type = section_list,
     .help = "Pressure on a surface that follows its faces; both sides of an inner surface are loaded."},
    {.path = "stage[].pressure[].surface", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical surface group, or a list of groups.", .example = "\"slit\""},
    {.path = "stage[].pressure[].value", .level = basic, .type = function, .unit = "Pa", .required = true,
     .help = "Function of time; positive pushes into the body.", .example = "{ linear = \"20 GPa/s\" }"},

    {.path = "stage[].traction[]", .type = section_list,
     .help = "Force on a surface for each unit of its area at rest, in a direction that stays when the faces turn; "
             "both sides of an inner surface are loaded alike."},
    {.path = "stage[].traction[].surface", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical surface group, or a list of groups.", .example = "\"crest\""},
    {.path = "stage[].traction[].value", .level = basic, .type = function_vector, .unit = "Pa", .required = true,
     .help = "Along x, y and z, functions of time.", .example = "[\"1 MPa\", 0, \"-2 MPa\"]"},

    {.path = "stage[].force[]", .type = section_list,
     .help = "Force on a group as a whole, in a direction that stays, shared among its nodes: of a surface by area at "
             "rest, of a volume, curve or point by mass. What it acts on at a curve or point yields the more, the "
             "finer the elements there are, and may be torn off."},
    {.path = "stage[].force[].group", .level = basic, .type = text_or_list, .required = true,
     .help = "Physical volume, surface, curve or point; each of a list takes the whole force.",
     .example = "\"loaded line\""},
    {.path = "stage[].force[].value", .level = basic, .type = function_vector, .unit = "N", .required = true,
     .help = "Along x, y and z, functions of time.", .example = "[0, \"-500 N\", 0]"},

    {.path = "time", .type = section, .help = "Time steps and what stops a run early."},
    {.path = "time.step", .type = number, .unit = "s", .fallback = "auto", .range = positive, .word = "auto",
     .help = "Time step. auto: safety times the stable step.", .example = "\"20 ns\""},
    {.path = "time.safety", .type = number, .fallback = "0.8", .range = {.lower = 0, .upper = 1, .lower_open = true},
     .help = "Share of the stable time step that is used.", .example = "0.5"},
    {.path = "time.max_steps", .type = integer, .fallback = "0", .range = steps,
     .help = "Steps after which the run stops; 0: no limit.", .example = "2000"},
    {.path = "time.residual_limit", .type = number, .fallback = "0.05", .range = positive,
     .help = "Unaccounted energy, as a share of the largest term, which stops the run.",
     .example = "\"1 %\""},
    {.path = "time.energy_gain_limit", .type = number, .fallback = "0.01", .range = positive,
     .help = "Kinetic and stored energy beyond the initial energy and the external work, as a share of the largest "
             "term of the budget, which stops the run: energy from nowhere. Terms that are round-off stop nothing.",
     .example = "\"0.1 %\""},
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
