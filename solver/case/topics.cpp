#include "case/topics.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace breccia::case_ {
namespace {

// clang-format off
constexpr auto kGeneralTopics = std::to_array<Topic>({
    {"process zone|fracture process zone|cohesive zone",
     "The length ahead of a crack over which joints soften. It follows from young, tensile_strength and the fracture "
     "energy; `breccia check` reports it for every kind of joint, and recommends elements of a third of it.",
     "joint.tensile_strength|joint.energy_mode_1|material.young"},
    {"cohesive|cohesive element|cohesive law|traction separation|traction separation law",
     "Cohesive interfaces are the joints between neighbouring elements: a [[joint]] has their strengths, fracture "
     "energies and softening. `breccia check CASE --joints` gives traction over opening and slip.",
     "joint|joint.softening|material.joints"},
    {"crack|fracture|joint opening",
     "Cracks run along faces between elements, whose joints soften and fail; frames show their damage, opening, slip "
     "and time_of_failure. An initial crack is a surface in joints.broken.",
     "joint|joints.broken|output.joints"},
    {"notch|pre crack|precrack|initial crack|starter crack",
     "A notch is a gap in the geometry, or a surface of the mesh whose joints are broken from the start; a raster "
     "makes such a surface with mesh.raster.slit.",
     "joints.broken|mesh.raster.slit|stage.broken"},
    {"fracture energy|toughness|fracture toughness|energy release rate|gic|g ic|kic|k ic",
     "The fracture energies of opening and sliding. Of a toughness K it is K^2/young, (1 - poisson^2) times that "
     "under plane strain.",
     "joint.energy_mode_1|joint.energy_mode_2|joint.energy_counts"},
    {"symmetry|symmetry plane|symmetric",
     "A plane of symmetry is a surface that is fixed along its normal, fixed = \"x\". No crack can run in it, and "
     "forces and energies are those of the part that is modelled.",
     "stage.constraint|stage.constraint.fixed"},
    {"reaction|reaction force|support force|load cell|force displacement",
     "The history records the reaction of the constraints on every group that output.gauges names, beside its "
     "displacement. It includes the inertia of the constrained part and the force of local_damping.",
     "output.gauges|output.history_interval|stage.local_damping"},
    {"boundary condition|support|spc|encastre|clamp|clamped|fixed support",
     "A [[stage.constraint]] fixes or drives the nodes of a group; fixed = \"xyz\" clamps them. Surfaces take a "
     "pressure or a traction, or absorb waves; any group takes a force.",
     "stage.constraint|stage.pressure|stage.traction|stage.force|stage.absorbing"},
    {"roller|pin|loading pin|loading nose|hinge",
     "A small separate body, fixed or driven by a [[stage.constraint]] on its volume group, that presses through "
     "[[contact]]. A constraint on a patch of the sample itself clamps it.",
     "stage.constraint|contact"},
    {"platen|rigid|rigid body|rigid wall|rigid part",
     "There are no rigid bodies: a [[stage.constraint]] along x, y and z on a volume group moves it as a whole; joints "
     "= \"none\" in its [[material]] reduces its cost.",
     "stage.constraint|material.joints|contact"},
    {"prescribed velocity|prescribed displacement|prescribed motion|imposed velocity|imposed displacement|"
     "loading rate|displacement control",
     "A [[stage.constraint]] with velocity or displacement. A jump in speed sends a stress wave rho c v into bodies at "
     "rest; use a ramp for a slow load.",
     "stage.constraint.velocity|stage.constraint.displacement|function.ramp"},
    {"point load|nodal force|concentrated force|concentrated load|external force",
     "A [[stage.force]] acts on a volume, surface, curve or point as a whole, in a fixed direction; a "
     "[[stage.traction]] by area, a [[stage.pressure]] follows the faces.",
     "stage.force|stage.traction|stage.pressure|stage.gravity"},
    {"time step|timestep|time increment|critical time step|cfl",
     "It is time.safety times the stable step, which `breccia check` reports with its limiting term; time.step sets "
     "another.",
     "time.step|time.safety"},
    {"mass scaling|selective mass scaling",
     "There is none: masses follow from the density. `breccia check` reports the limit of the time step: the smallest "
     "elements, or penalties of joints or contact.",
     "time.safety|joint.penalty_factor|contact.penalty|material.density"},
    {"rebound|bounce|restitution|coefficient of restitution",
     "Contact is elastic unless it has a plateau, an unloading_exponent above 1 or a damping_ratio.",
     "contact.unloading_exponent|contact.damping_ratio|contact.plateau"},
    {"erosion|element erosion|element deletion|failure strain",
     "Nothing is deleted: joints fail, and fragments stay in the model and collide.",
     "material.joints|joint|contact"},
    {"hourglass|hourglass control|element formulation",
     "Elements are tetrahedra of constant strain, which have no hourglass modes.",
     "mesh|material.law"},
    {"element size|mesh size|mesh density|mesh refinement",
     "Given in the .geo file, where mesh.parameters set it from the case, by mesh.size for STEP, BREP and STL, or "
     "by the raster's cell_size. `breccia check` compares it with the process zone.",
     "mesh.parameters|mesh.size|mesh.raster.cell_size"},
    {"plane strain|plane stress|2d|two dimensional",
     "One flat layer of elements and a [plane] section.",
     "plane|plane.kind"},
    {"tie|tied|tied contact|bond|bonded|weld",
     "mesh.glue joins volumes of one conforming mesh to one body, mesh.merge_nodes those that were meshed apart; a "
     "[[joint]] with between is the law of their interface, which cannot break without strengths.",
     "mesh.glue|mesh.merge_nodes|joint.between"},
    {"set|element set|node set|section assignment|wildcard",
     "A set is a group: a physical volume, surface, curve or point of the mesh, or a solid or face of a STEP file. "
     "Physical volumes may overlap if each element has one [[material]]. Several groups may share an entry: group = "
     "[\"left\", \"right\"]. In a [[joint]] and a [[contact]] \"*\" stands for every group.",
     "material.group|joint.group|joint.between|contact.between|stage.constraint.group"},
    {"heterogeneity|scatter|random strength",
     "Strengths scatter from joint to joint with a weibull_modulus.",
     "joint.weibull_modulus|joint.weibull_area|joint.weibull_seed"},
    {"initial stress|in situ stress|k0|geostatic|prestress|excavation|tunnel|staged construction",
     "A first run comes to rest under gravity or outer pressures; a second one starts from its state with other loads, "
     "constraints and materials.",
     "start|stage.gravity|stage.pressure|stage.local_damping"},
    {"remove|removal|delete|deletion|demolition|demolish",
     "Parts cannot be removed from a model. In a run that starts from the state of another, give the group almost no "
     "strength, so that it breaks, or almost no stiffness, so that it supports nothing.",
     "start|joint.tensile_strength|material.young"},
    {"viscous boundary|quiet boundary|non reflecting boundary|absorbing boundary|infinite boundary|lysmer",
     "Surfaces in the absorbing list of a stage absorb incoming waves; their previous constraint forces continue to "
     "act.",
     "stage.absorbing"},
    {"dynamic relaxation|quasi static|static equilibrium|static analysis|settle",
     "A stage with damping comes to rest: local_damping opposes a share of every unbalanced force, mass_damping slows "
     "all motion. The ratio of kinetic to elastic energy in the history shows when; ramp loads excite fewer "
     "vibrations.",
     "stage.local_damping|stage.mass_damping|function.ramp"},
    {"rayleigh|rayleigh damping|damping|structural damping",
     "mass_damping is the share of the mass (alpha, 1/s), a material's viscosity damps its rate of strain (beta, as a "
     "stress over a rate). Joints and contact damp by dissipation; contact.damping_ratio adds to it.",
     "stage.mass_damping|stage.local_damping|material.viscosity|contact.damping_ratio"},
    {"strength reduction|factor of safety|safety factor|slope stability",
     "A first run comes to rest; others start from its state with cohesion, strengths and friction divided by a "
     "factor. The largest factor with which the model comes to rest is the factor of safety. It is overestimated for "
     "plastic flow (material.law).",
     "start|joint.shear_strength|joint.friction|material.cohesion"},
    {"confinement|confining pressure|confining stress|triaxial|triaxial test|fluid pressure|borehole|blast|explosion|"
     "gas pressure",
     "A [[stage.pressure]] on a surface, as a function of time; it follows the faces. On a broken surface it opens the "
     "crack.",
     "stage.pressure|stage.traction"},
    {"restart|continue|checkpoint restart",
     "`breccia resume RUN` continues from the last checkpoint, on any number of ranks, with bitwise identical results. "
     "[start] starts a case with other loads, materials or contact from the state of a run.",
     "checkpoint|start"},
    {"mohr coulomb|coulomb|drucker prager|yield surface",
     "Between elements: shear_strength is the cohesion of a joint, friction that of its faces. Within them: "
     "material.law = \"drucker_prager\".",
     "joint.shear_strength|joint.friction|joint.friction_angle|material.law"},
    {"fault|bedding|bedding plane|dfn|joint set|discontinuity|weak plane|interface",
     "A surface of the mesh: between two volumes, whose interface has a [[joint]] of its own, or a physical surface "
     "within one that joints.broken or stage.broken opens.",
     "joint.between|joints.broken|stage.broken|mesh.glue"},
    {"ucs|uniaxial compression|unconfined compression|brazilian|brazilian test|hopkinson|split hopkinson",
     "Sample and platens or bars are volumes of one geometry that touch by [[contact]]; one platen is driven, "
     "output.gauges records the forces on both. meshes/disc is such a case. Strengths on a regular mesh, such as a "
     "raster, depend on its planes.",
     "contact|stage.constraint|output.gauges"},
    {"history|history csv|history output|energies|energy balance|energy budget|time history",
     "history.csv has a line each history_interval: energies, J, counts of joints and fragments, momenta and what "
     "output.gauges record. Stored and dissipated energies equal, up to the residual, the initial energy plus external "
     "work and step change; the initial energy is the sum of the first line, after [start] with the new laws. "
     "`summary.txt` lists the energies at the end.",
     "output.history_interval|output.gauges|time.residual_limit"},
    {"frame|field output|vtk|vtu|paraview|visualization|visualisation|animation",
     "frames/*.series contain stresses, velocities, displacements, joints and contacts at times, in SI, for ParaView; "
     "`breccia report RUN` draws some, [insitu] draws and records during the run.",
     "output.frame_interval|output.elements|output.joints|insitu"},
    {"fragment|fragments|fragment size|fragment size distribution|debris",
     "A fragment is a set of elements connected by intact joints and shared nodes. Element frames have its number "
     "(fragment), with mass and velocity of each element; `breccia report RUN` plots the number and sizes by mass of "
     "fragments.",
     "output.elements|output.frame_interval"},
    {"stress|stresses|principal stress|von mises|pressure in the material",
     "Element frames contain the Cauchy stress (stress), its principal values (principal) and von Mises' (von_mises), "
     "Pa, tension positive.",
     "output.elements|output.frame_interval"},
    {"unit|units|unit system|si",
     "A number without a unit is SI: m, kg, s, N, Pa, J, rad. A text may have another one: \"5 mm\", \"2.4 g/cm3\", "
     "\"30 deg\". All results are SI.",
     "mesh.scale"},
    {"inertia|moment of inertia|rotation|rotational inertia|lumped mass",
     "A quarter of the mass of an element lies at each of its corners: moments of inertia are too large, most for "
     "small fragments, which therefore spin too slowly. Angular momentum is conserved.",
     "initial_velocity.angular|output.gauges"},
    {"strength|tensile strength|compressive strength|shear strength",
     "A joint opens at its tensile_strength and slides at its shear_strength, the cohesion, plus friction times the "
     "pressure on it; a compressive strength results from both. `breccia check CASE --joints` draws the curves.",
     "joint.tensile_strength|joint.shear_strength|joint.friction"},
    {"bolt|rock bolt|anchor|cable|rebar|spring|dashpot|beam element|shell element",
     "There are no springs, bolts, beams or shells: every part is a volume, connected by joints or contact.",
     "joint.between|contact"},
    {"bending|locking|shear locking|thin plate|slender|linear tetrahedron|tet4|quadratic element|element type",
     "Elements are linear tetrahedra, which are too stiff in bending. Use at least four elements across the thickness "
     "of bent parts, or a raster. `breccia check` lists slender solids of few elements across.",
     "mesh.parameters|mesh.raster.cells"},
    {"crack tip|crack speed|crack velocity|crack length|crack growth|acoustic emission|microseismicity|seismic event",
     "Joints in frames have their time_of_failure. The plugin for ParaView derives position and speed of the crack tip "
     "(filter Fracture Surface, output 3), and events with energy, moment tensor and magnitude (Crack Events); "
     "`breccia report RUN` lists the largest.",
     "output.frame_interval|output.joints"},
    {"servo|servo control|stress control|force control",
     "There is none: a load is a function of time. Stop a run at a state of interest and continue from it with "
     "[start].",
     "stage.traction|stage.pressure|start"},
});
// clang-format on

/// Lower case, with spaces for _ and -.
std::string plain(std::string_view word) {
  std::string out(word);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return c == '_' || c == '-' ? ' ' : static_cast<char>(std::tolower(c)); });
  return out;
}

/// @param words  "a|b|c"
bool is_among(std::string_view words, std::string_view word) {
  for (std::size_t at = 0; at <= words.size();) {
    const std::size_t end = std::min(words.find('|', at), words.size());
    if (words.substr(at, end - at) == word) return true;
    at = end + 1;
  }
  return false;
}

}  // namespace

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all = [] {
    std::vector<Topic> rows(kGeneralTopics.begin(), kGeneralTopics.end());
    for (const std::span<const Topic> part : {physics_topics(), program_topics()})
      rows.insert(rows.end(), part.begin(), part.end());
    return rows;
  }();
  return all;
}

const Topic* topic_of(std::string_view word) {
  const std::string wanted = plain(word);
  const std::string_view several = wanted;
  for (const Topic& topic : topics()) {
    for (const std::string_view ending : {"", "s", "es"}) {
      if (several.size() > ending.size() && several.ends_with(ending) &&
          is_among(topic.words, several.substr(0, several.size() - ending.size())))
        return &topic;
    }
  }
  return nullptr;
}

}  // namespace breccia::case_
