#include <array>

#include "case/topics.hpp"

namespace breccia::case_ {
namespace {

/// Words of mechanics, materials, loads and results.
// clang-format off
constexpr auto kPhysicsTopics = std::to_array<Topic>({
    {"temperature|thermal|heat|heat transfer|thermal expansion|thermal stress|thermal shock|thermomechanical|"
     "fire",
     "There is no temperature in Breccia. A thermal stress can be put in as a pressure or a motion that opens "
     "or squeezes a body; coupled problems need a thermo-mechanical code.",
     "stage.pressure|stage.constraint.displacement|start"},
    {"water|fluid|flow|pore|pore pressure|pore water|permeability|seepage|darcy|groundwater|hydro mechanical|"
     "poroelastic|drained|undrained",
     "There is no fluid in Breccia. Model water in a known crack or on a wall by a [[stage.pressure]] on its surface; "
     "for known pore pressures give effective stresses and strengths.",
     "stage.pressure|joints.broken"},
    {"hydraulic|hydraulic fracturing|hydraulic fracture|fracking|fracturing|hydrofrac|injection|proppant|"
     "leak off",
     "There is no flow in cracks. A [[stage.pressure]] opens a broken surface; it is a function of time and does not "
     "spread with the crack.",
     "stage.pressure|joints.broken|stage.broken"},
    {"periodic|periodic boundary|periodic boundary condition|pbc|cyclic symmetry|representative volume|rve|"
     "homogenization|homogenisation",
     "There are no periodic boundaries: model a piece with planes of symmetry, or a larger one and evaluate its "
     "middle. Absorbing borders represent an infinite surrounding.",
     "stage.constraint.fixed|stage.absorbing"},
    {"axisymmetric|axisymmetry|axial symmetry|rotational symmetry|axially symmetric",
     "There is no axisymmetric model, since cracks are not axisymmetric. Use a sector with two planes of symmetry, "
     "fixed along their normals.",
     "stage.constraint.fixed|plane"},
    {"modal|mode shape|modal analysis|eigenvalue|eigenfrequency|eigenfrequencies|natural frequency|"
     "natural frequencies|frequency response|harmonic|buckling|resonance",
     "There is no eigenvalue analysis: everything is explicit in time. Strike the model and read natural "
     "frequencies from the gauges of history.csv; a body that buckles does so in a run with a small disturbance.",
     "output.gauges|output.history_interval|initial_velocity"},
    {"implicit|newton|newton raphson|newmark|hht|generalized alpha|generalised alpha|arc length|solver|"
     "linear solver|convergence",
     "Time integration is explicit, by central differences: no equations are solved and nothing has to "
     "converge; the step is below the stable one. A slow problem is run with damping.",
     "time.safety|stage.local_damping|stage.mass_damping"},
    {"static|equilibrium|steady state|steady|creeping load",
     "There is no static solver: a stage with local_damping or mass_damping comes to rest, under loads that "
     "grow by a ramp. Kinetic over elastic energy in history.csv shows when.",
     "stage.local_damping|stage.mass_damping|function.ramp"},
    {"explicit|central difference|leapfrog|verlet|time integration|integrator",
     "Central differences with half-step velocities; the step is time.safety times the stable one, which "
     "`breccia check` gives with what limits it.",
     "time.safety|time.step"},
    {"shell|plate|membrane|thin shell|beam|truss|rod|bar element|frame structure|1d",
     "There are no shells, plates, beams or bars: every part is a volume of tetrahedra, a few of them thick. "
     "`breccia check` names slender solids that are too coarse.",
     "mesh|material.joints|plane"},
    {"hexahedron|hexahedra|hex|brick|quad|quadrilateral|wedge element|pyramid|prism|voronoi|polyhedron|"
     "polyhedra|grain",
     "Elements are tetrahedra. Other shapes are cut into them: gmsh does that with its own geometry; grains or "
     "blocks are volumes, each a body or a group with a [[joint]] between them.",
     "mesh.file|mesh.raster|joint.between"},
    {"tetrahedron|tetrahedra|tet|tetrahedral|tet10|c3d4|c3d10|element",
     "Elements are linear tetrahedra (four nodes, constant strain), each with nodes of its own where joints can "
     "fail. Of tetrahedra of second order the corners are read.",
     "mesh|material.joints|material.law"},
    {"adaptive|adaptivity|adaptive mesh|amr|remesh|remeshing|remap|refinement|refine|h adaptive",
     "There is no adaptive mesh: cracks run along faces that are there from the start. Make the mesh fine where "
     "cracks are expected, in the .geo or by mesh.parameters; about three elements a process zone.",
     "mesh.parameters|mesh.size|joint.energy_mode_1"},
    {"meshing|mesh generator|mesh format|msh|import|cad|stp|stl|brep|iges|igs|parasolid|x t|solidworks|catia|"
     "freecad|inventor|salome|hypermesh|gmsh",
     "mesh.file is a .geo or .msh of gmsh, a mesh as .inp, .unv, .bdf or .mesh, or solids as STEP, BREP or STL; "
     "[mesh.raster] makes boxes without a file. IGES, Parasolid and native CAD files are not read: export STEP.",
     "mesh.file|mesh.size|mesh.scale|mesh.raster"},
    {"elastic|elasticity|linear elastic|isotropic|hooke|neo hooke|hyperelastic|hyperelasticity|rubber|"
     "mooney rivlin|ogden|young modulus|elastic modulus|shear modulus|bulk modulus|lame|poisson ratio|stiffness",
     "Elements are isotropic, by young and poisson: neo-Hookean for any rotation and strain, or Green-St. Venant. Of a "
     "shear modulus G, young = 2 G (1 + poisson). Mooney-Rivlin, Ogden and others are not available.",
     "material.young|material.poisson|material.law"},
    {"anisotropic|anisotropy|orthotropic|orthotropy|transversely isotropic|transverse isotropy|composite|"
     "laminate|lamina|fibre|fiber|fibre reinforced|fiber reinforced|cfrp|gfrp|ply|delamination|textile",
     "There is no anisotropic law. Layers and fibres are volumes of their own, with a [[joint]] between them "
     "for delamination; weak planes are surfaces with weaker joints.",
     "joint.between|material.law|mesh.glue"},
    {"plasticity|plastic|plastic flow|yield|yield stress|yield strength|elastoplastic|von mises plasticity|j2|"
     "flow rule|cap model|cam clay|crushable foam|foam",
     "material.law = \"drucker_prager\" yields and flows, with cohesion, friction, dilation, hardening, a cap and a "
     "tension cut-off; with friction_angle = 0 it is von Mises'. Other models are not available.",
     "material.law|material.cohesion|material.friction_angle|material.hardening|material.cap_pressure"},
    {"rate|rate dependence|rate dependent|strain rate effect|dynamic increase factor|dif|johnson cook|"
     "cowper symonds|viscoplastic|viscoplasticity",
     "Strengths do not depend on the rate; material.viscosity adds a stress in proportion to the rate of strain. "
     "Inertia of fragments already raises apparent strengths. For a given rate, multiply strengths by their dynamic "
     "increase.",
     "material.viscosity|joint.tensile_strength|initial_velocity.strain_rate"},
    {"viscoelastic|viscoelasticity|maxwell|kelvin voigt|prony|prony series|relaxation|creep|ageing|aging|"
     "shrinkage|time dependent",
     "There is no creep or relaxation: material.viscosity (Kelvin-Voigt) only damps the rate of strain. "
     "Strengths can be changed between runs with [start].",
     "material.viscosity|start"},
    {"fatigue|cyclic|cyclic loading|s n curve|paris law|subcritical crack growth|stress corrosion",
     "There is no law of fatigue: joints below their strength keep it. They unload towards the origin and soften with "
     "their opening; a load may be any function of time.",
     "joint|joint.softening|function.table"},
    {"equation of state|eos|shock|shock wave|hugoniot|mie grueneisen|jwl|jones wilkins lee|detonation|hydrocode|"
     "ale|eulerian",
     "There is no equation of state and no fluid: pressure follows the elastic law, which is right below about "
     "a tenth of the bulk modulus. Stronger shocks need a hydrocode.",
     "material.law|stage.pressure"},
    {"explosive|charge|tnt|blasting|blast hole|blasthole|burden|air blast|conwep|friedlander|decoupling|"
     "blast wave|rock blasting",
     "There is no explosive: give the pressure on the wall of the hole, or of a blast wave on a face, as a "
     "function of time in a [[stage.pressure]] (a ramp up, a table down). It follows the faces.",
     "stage.pressure|function.table|stage.absorbing"},
    {"concrete|rock|granite|glass|ceramic|alumina|brick wall|mortar|masonry|steel|metal|aluminium|aluminum|ice|"
     "bone|wood|timber|coal|salt|material library|material properties|material data",
     "A material is its density, young and poisson, and a [[joint]] with tensile_strength, shear_strength and "
     "fracture energies. The desktop has a library with sources (Materials); the cases of meshes/ hold glass, "
     "concrete and rock.",
     "material|joint|joint.tensile_strength|joint.energy_mode_1"},
    {"soil|sand|clay|gravel|granular|granular material|powder|ballast",
     "Soil is a [[material]] with law = \"drucker_prager\" and joints = \"none\", or many bodies in contact "
     "where grains matter: [mesh.raster] with boxes and gaps fills a volume with them.",
     "material.law|mesh.raster.boxes|contact.friction"},
    {"reinforcement|reinforced concrete|reinforcing bar|tendon|prestressing|stirrup|embedded|embedded element|"
     "tie constraint",
     "There are no embedded bars: a bar is a volume of its own in the mesh, glued by mesh.glue to what is "
     "around it, with a [[joint]] between them for the bond.",
     "mesh.glue|joint.between|material.joints"},
    {"adhesion|adhesive|glue line|cohesion between particles|jkr|van der waals|electrostatic|capillary|"
     "capillarity|magnetic|electric|piezoelectric|radiation|chemical|diffusion|corrosion",
     "There are no such forces. Bonds are joints: [[joint]] with between = two groups gives a glued interface "
     "its strengths and energies; once broken it only presses and rubs.",
     "joint.between|mesh.glue|contact"},
    {"weibull|weibull distribution|probability|stochastic|monte carlo|random field|uncertainty|reliability|"
     "spatial correlation|variability",
     "Strengths scatter by joint, without correlation, with joint.weibull_modulus and a seed: run a case with "
     "several seeds, `--set joint[0].weibull_seed=2`, or a study of the desktop.",
     "joint.weibull_modulus|joint.weibull_seed"},
    {"impact|collision|crash|projectile|bullet|penetration|perforation|ballistic|drop|drop test|fall|striker|"
     "missile|hail|bird strike",
     "A body with an [[initial_velocity]] and a [[contact]] with what it strikes; meshes/glass_impact is such a "
     "case. For a drop give the speed at the end of the fall, sqrt(2 g h), and place it close.",
     "initial_velocity.velocity|contact|stage.gravity"},
    {"wave|elastic wave|stress wave|p wave|s wave|pressure wave|shear wave|wave speed|wave propagation|sound|"
     "spall|spallation|spalling|ultrasound|acoustic",
     "Waves are what an explicit code computes: c_p follows from young, poisson and density. About ten elements "
     "a wave length; borders that absorb them are named in stage.absorbing; gauges record stress and motion.",
     "stage.absorbing|output.gauges|material.young|material.density"},
    {"seismic|earthquake|ground motion|accelerogram|acceleration|base excitation|response spectrum|vibration|"
     "shaking",
     "A [[stage.constraint]] on the base with a velocity or displacement as a table of times and values; an "
     "accelerogram is integrated once beforehand. Response spectra are not available.",
     "stage.constraint.velocity|function.table|stage.absorbing"},
    {"weight|self weight|dead load|body force|centrifuge|centrifugal force|g force",
     "stage.gravity is an acceleration along x, y and z, a function of time each. There is no rotating frame: spin the "
     "body with initial_velocity.angular.",
     "stage.gravity|initial_velocity.angular"},
    {"slope|dam|landslide|rock fall|rockfall|pillar|stope|mine|mining|caving|subsidence|foundation|footing|"
     "retaining wall|cavern|shaft|wellbore|cutting|tbm|disc cutter",
     "A first run comes to rest under gravity; a second one with [start] changes loads or strengths, or excavates. "
     "Water in cracks is a [[stage.pressure]], borders absorb waves, interfaces have a [[joint]].",
     "start|stage.gravity|stage.pressure|joint.between|stage.absorbing"},
    {"three point bending|four point bending|bending test|double cantilever|dcb|compact tension|fracture test|"
     "indentation|scratch|point load test|punch|drill|grinding|milling|crushing|comminution|fragmentation|mill",
     "Sample, supports and tools are volumes of one geometry, with [[contact]] between them; tools are fixed or driven "
     "by a [[stage.constraint]], and output.gauges record their forces. meshes/ has such cases.",
     "contact|stage.constraint|output.gauges|joint"},
    {"gap element|contact law|contact stiffness|penalty method|lagrange multiplier|hertz|self contact|"
     "general contact|master slave|overlap|interpenetration|stick slip|coulomb friction",
     "Contact is by penalty, between all free faces of the groups that a [[contact]] names, new ones of cracks "
     "included; there are no masters and slaves. friction is Coulomb's.",
     "contact|contact.penalty|contact.friction|contact_points"},
    {"energy|work|dissipation|momentum|angular momentum|kinetic energy|strain energy|energy conservation|"
     "external work",
     "history.csv has all energies (J) and momenta by time: kinetic, elastic, joints, contact, fracture of mode "
     "I and II, friction, damping, plastic flow, external work, and the residual, beyond which a run ends.",
     "output.history_interval|time.residual_limit|joint.energy_mode_1"},
    {"strain|deformation|velocity field|stress intensity|stress intensity factor|j integral|k factor|damage|"
     "mixed mode|mode i|mode ii",
     "Element frames hold stress, velocity, displacement; joint frames damage, opening, slip, energies and the mode of "
     "failure. Stress intensities and J integrals are not computed: cracks grow by their energy.",
     "output.elements|output.joints|joint.energy_mode_1|joint.energy_mode_2"},
    {"result|export|post processing|postprocessing|plot|graph|hdf5|h5|vtkhdf|ensight|exodus|tecplot|matlab|"
     "octave|excel|pandas|numpy|origin lab",
     "frames/*.series are VTKHDF for ParaView (plain HDF5 to h5py and MATLAB's h5read), history.csv, bodies.csv "
     "and race tables are text with a header, summary.json and status.jsonl JSON. `breccia report RUN` makes a "
     "page.",
     "output.frame_interval|output.history_interval|output.gauges"},
    {"video|movie|picture|image|screenshot|render|rendering|camera|live view|monitor|monitoring|dashboard",
     "[insitu] draws pictures during a run and joins them to an animation if ffmpeg is installed; `--live` shows the "
     "run in ParaView; the desktop and `breccia report` draw frames.",
     "insitu|insitu.pipeline|insitu.live|output.frame_interval"},
    {"colour|color|colour map|color map|colormap|legend|opacity|transparency",
     "Colours are chosen where results are displayed: in the desktop's results, in ParaView, or in a script of "
     "ParaView's that [insitu] runs. A case has none.",
     "insitu.pipeline|output.elements"},
});
// clang-format on

}  // namespace

std::span<const Topic> physics_topics() { return kPhysicsTopics; }

}  // namespace breccia::case_
