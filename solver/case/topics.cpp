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
     "The length ahead of a crack over which joints soften. It follows from young, tensile_strength and the "
     "fracture energy; `breccia check` tells it for every kind of joint, and advises elements of a third of it.",
     "joint.tensile_strength|joint.energy_mode_1|material.young"},
    {"cohesive|cohesive element|cohesive law|traction separation|traction separation law",
     "Cohesive interfaces are the joints between neighbouring elements: a [[joint]] has their strengths, fracture "
     "energies and softening. `breccia check CASE --joints` gives traction over opening and slip.",
     "joint|joint.softening|material.joints"},
    {"crack|fracture|joint opening",
     "Cracks run along faces between elements, whose joints soften and fail; frames show their damage, opening, "
     "slip and time_of_failure. One that is there from the start is a surface in joints.broken.",
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
     "displacement. It includes what accelerates the held part and what local_damping takes.",
     "output.gauges|output.history_interval|stage.local_damping"},
    {"boundary condition|support|spc|encastre|clamp|clamped|fixed support",
     "Nodes of a group are held or driven by a [[stage.constraint]]; fixed = \"xyz\" clamps them. Surfaces take a "
     "pressure or a traction, or absorb waves; any group takes a force.",
     "stage.constraint|stage.pressure|stage.traction|stage.force|stage.absorbing"},
    {"roller|pin|loading pin|loading nose|hinge",
     "A small body of its own, held or driven by a [[stage.constraint]] on its volume group, that presses through "
     "[[contact]]. A constraint on a patch of the sample itself clamps it.",
     "stage.constraint|contact"},
    {"platen|rigid|rigid body|rigid wall|rigid part",
     "There are no rigid bodies: a [[stage.constraint]] along x, y and z on a volume group moves it as a whole; "
     "joints = \"none\" in its [[material]] makes it cheap.",
     "stage.constraint|material.joints|contact"},
    {"prescribed velocity|prescribed displacement|prescribed motion|imposed velocity|imposed displacement|"
     "loading rate|displacement control",
     "A [[stage.constraint]] with velocity or displacement. One that begins with a jump in speed strikes what "
     "rests with a wave of stress rho c v; let it grow by a ramp where a slow load is meant.",
     "stage.constraint.velocity|stage.constraint.displacement|function.ramp"},
    {"point load|nodal force|concentrated force|concentrated load|external force",
     "A [[stage.force]] acts on a volume, surface, curve or point as a whole, in a fixed direction; a "
     "[[stage.traction]] by area, a [[stage.pressure]] follows the faces.",
     "stage.force|stage.traction|stage.pressure|stage.gravity"},
    {"time step|timestep|time increment|critical time step|cfl",
     "It is time.safety times the stable step, which `breccia check` tells with what limits it; time.step gives "
     "another.",
     "time.step|time.safety"},
    {"mass scaling|selective mass scaling",
     "There is none: masses are those of the density. `breccia check` tells what limits the time step: the "
     "smallest elements, or penalties of joints or contact.",
     "time.safety|joint.penalty_factor|contact.penalty|material.density"},
    {"rebound|bounce|restitution|coefficient of restitution",
     "Contact gives all energy back unless it has a plateau, an unloading_exponent above 1 or a damping_ratio.",
     "contact.unloading_exponent|contact.damping_ratio|contact.plateau"},
    {"erosion|element erosion|element deletion|failure strain",
     "Nothing is deleted: joints fail, and what has come apart stays in the model as fragments that collide.",
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
     "[[joint]] with between says how their interface holds, for good if it has no strengths.",
     "mesh.glue|mesh.merge_nodes|joint.between"},
    {"set|element set|node set|section assignment|wildcard",
     "A set is a group: a physical volume, surface, curve or point of the mesh, or a solid or face of a STEP file. "
     "Physical volumes may overlap where one of them has a [[material]] for every element. "
     "Groups that are alike share an entry: group = [\"left\", \"right\"]. In a [[joint]] and a [[contact]] \"*\" "
     "stands for every group.",
     "material.group|joint.group|joint.between|contact.between|stage.constraint.group"},
    {"heterogeneity|scatter|random strength",
     "Strengths scatter from joint to joint with a weibull_modulus.",
     "joint.weibull_modulus|joint.weibull_area|joint.weibull_seed"},
    {"initial stress|in situ stress|k0|geostatic|prestress|excavation|tunnel|staged construction",
     "A first run settles under gravity or outer pressures; a second one starts from its state with other loads, "
     "constraints and materials.",
     "start|stage.gravity|stage.pressure|stage.local_damping"},
    {"remove|removal|delete|deletion|demolition|demolish",
     "No part is taken out of a model. A run that starts from another one's state gives a group next to no strength, "
     "and it breaks, or next to no stiffness, and it holds nothing up.",
     "start|joint.tensile_strength|material.young"},
    {"viscous boundary|quiet boundary|non reflecting boundary|absorbing boundary|infinite boundary|lysmer",
     "Surfaces named in a stage's absorbing list take waves up that arrive, and go on holding what they held.",
     "stage.absorbing"},
    {"dynamic relaxation|quasi static|static equilibrium|static analysis|settle",
     "A stage with damping comes to rest: local_damping takes a share of every unbalanced force, mass_damping slows "
     "all motion. Kinetic over elastic energy in the history tells when; a load that grows by a ramp rings less.",
     "stage.local_damping|stage.mass_damping|function.ramp"},
    {"rayleigh|rayleigh damping|damping|structural damping",
     "mass_damping is the share of the mass (alpha, 1/s), a material's viscosity damps its rate of strain (beta, as a "
     "stress over a rate). Joints and contact damp by what they dissipate; contact.damping_ratio adds to that.",
     "stage.mass_damping|stage.local_damping|material.viscosity|contact.damping_ratio"},
    {"strength reduction|factor of safety|safety factor|slope stability",
     "A case settles; others start from its state with cohesion, strengths and friction divided by a factor. The "
     "largest with which it comes to rest is the factor of safety. Of a material that flows it comes out too "
     "high (material.law).",
     "start|joint.shear_strength|joint.friction|material.cohesion"},
    {"confinement|confining pressure|confining stress|triaxial|triaxial test|fluid pressure|borehole|blast|explosion|"
     "gas pressure",
     "A [[stage.pressure]] on a surface, as a function of time; it follows the faces. On a surface that has broken it "
     "opens the crack.",
     "stage.pressure|stage.traction"},
    {"restart|continue|checkpoint restart",
     "`breccia resume RUN` goes on from the last checkpoint, on any number of ranks, to the same bits. [start] takes "
     "the state of a run into a case with other loads, materials or contact.",
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
     "output.gauges records the forces on both. meshes/disc is such a case. Strengths on a regular mesh, a raster "
     "above all, are those of its planes.",
     "contact|stage.constraint|output.gauges"},
    {"history|history csv|history output|energies|energy balance|energy budget|time history",
     "history.csv has a line each history_interval: energies, J, counts of joints and fragments, momenta and what "
     "output.gauges record. All that is held and dissipated makes, but for the residual, the external work, what "
     "changes of the step have moved, and what the bodies had at the start: the sum in the first line, after [start] "
     "with the new laws. `summary.txt` tells the energies at the end.",
     "output.history_interval|output.gauges|time.residual_limit"},
    {"frame|field output|vtk|vtu|paraview|visualization|visualisation|animation",
     "frames/*.series hold stresses, velocities, displacements, joints and contacts at times, in SI, for ParaView; "
     "`breccia report RUN` draws some, [insitu] draws and records while the run goes on.",
     "output.frame_interval|output.elements|output.joints|insitu"},
    {"fragment|fragments|fragment size|fragment size distribution|debris",
     "A fragment is what intact joints and shared nodes hold together. Element frames number it (fragment), with mass "
     "and velocity of each element; `breccia report RUN` draws how many there are and their sizes by mass.",
     "output.elements|output.frame_interval"},
    {"stress|stresses|principal stress|von mises|pressure in the material",
     "Element frames hold the Cauchy stress (stress), its principal values (principal) and von Mises' (von_mises), Pa, "
     "tension positive.",
     "output.elements|output.frame_interval"},
    {"unit|units|unit system|si",
     "A number without a unit is SI: m, kg, s, N, Pa, J, rad. A text may have another one: \"5 mm\", \"2.4 g/cm3\", "
     "\"30 deg\". All results are SI.",
     "mesh.scale"},
    {"inertia|moment of inertia|rotation|rotational inertia|lumped mass",
     "A quarter of the mass of an element lies at each of its corners: moments of inertia are too large by a factor of "
     "5 for a fragment of one element, 1.75, 1.19, 1.05 and 1.01 for a cube of 1, 2, 4 and 8 cells along an edge. "
     "Angular momentum is kept; small fragments spin too slowly.",
     "initial_velocity.angular|output.gauges"},
    {"strength|tensile strength|compressive strength|shear strength",
     "A joint opens at its tensile_strength and slides at its shear_strength, the cohesion, plus friction times the "
     "pressure on it; a compressive strength results from both. `breccia check CASE --joints` draws the curves.",
     "joint.tensile_strength|joint.shear_strength|joint.friction"},
    {"bolt|rock bolt|anchor|cable|rebar|spring|dashpot|beam element|shell element",
     "There are no springs, bolts, beams or shells: every part is a volume, bonded by joints or held by contact.",
     "joint.between|contact"},
    {"bending|locking|shear locking|thin plate|slender|linear tetrahedron|tet4|quadratic element|element type",
     "Elements are linear tetrahedra, which are too stiff in bending: cantilevers of unstructured meshes with elements "
     "of a whole, a half, a third and a quarter of the thickness had 0.43, 0.54, 0.78 and 0.82 of the deflection of "
     "theory, rasters with 2, 4 and 8 cells across 0.88, 0.96 and 0.99. `breccia check` names slender solids that are "
     "few elements thick.",
     "mesh.parameters|mesh.raster.cells"},
    {"crack tip|crack speed|crack velocity|crack length|crack growth|acoustic emission|microseismicity|seismic event",
     "Joints in frames have their time_of_failure. The plugin for ParaView makes of it where the crack tip was and how "
     "fast (filter Fracture Surface, output 3), and events with energy, moment tensor and magnitude (Crack Events); "
     "`breccia report RUN` lists the largest.",
     "output.frame_interval|output.joints"},
    {"servo|servo control|stress control|force control",
     "There is none: a load is a function of time. A run stopped at a state of interest goes on from it with [start].",
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
