#include <array>

#include "case/topics.hpp"

namespace breccia::case_ {
namespace {

/// Words of computers, files, other programs and methods.
// clang-format off
constexpr auto kProgramTopics = std::to_array<Topic>({
    {"gpu|cuda|opencl|hip|rocm|sycl|nvidia|amd gpu|accelerator|graphics card",
     "There is no GPU version. The kernels use SSE2, AVX2 or AVX-512, chosen at run time, and ranks of MPI: "
     "`mpiexec -n 8 breccia run CASE`.",
     "domains|detection.algorithm"},
    {"parallel|parallelisation|parallelization|parallelism|mpi|rank|process|core|cpu|openmp|thread|"
     "multithreading|scaling|speedup|load balance|load balancing|domain decomposition|performance|speed up|slow|"
     "faster",
     "`mpiexec -n N breccia run CASE` runs on N ranks with bitwise identical results; there are no threads. `breccia "
     "check CASE --ranks N` shows the distribution of the work; more ranks than cores, or few thousand elements a "
     "rank, bring no speed-up.",
     "domains|domains.rebalance|detection.algorithm"},
    {"cluster|hpc|supercomputer|slurm|sbatch|srun|pbs|torque|lsf|sge|queue|batch|batch job|job script|walltime|"
     "preemption|node",
     "`srun breccia run CASE` or `mpiexec` in the job script. Configure the queue to send SIGTERM, SIGUSR2 or SIGXCPU "
     "before the time limit: the run ends with a checkpoint, and `breccia resume RUN` continues on any number of "
     "ranks; SIGUSR1 writes a checkpoint.",
     "checkpoint|checkpoint.wall_interval|domains"},
    {"memory|ram|out of memory|disk|disk space|storage|file size|run time|runtime|wall time|cost|estimate",
     "`breccia check CASE` estimates memory, run time, frames and disk space before a run. Breakable joints take some "
     "7 kB an element, shared nodes 0.5 kB. output.frame_interval determines the disk space.",
     "mesh.memory_limit|output.frame_interval|material.joints"},
    {"windows|mac|macos|os x|apple|arm|linux|ubuntu|fedora|debian|wsl|docker|singularity|apptainer|container|"
     "conda|pip|spack|install|installation|package|compile|build",
     "Breccia is for Linux; `./run packages` lists what it needs, `./run install` and `./run package` install "
     "it. Elsewhere use a container or WSL 2 with Debian 12 or 13. There are no packages of pip or conda.",
     "mesh.file|insitu"},
    {"python|scripting|script|api|library|bindings|jupyter|automation|macro|subroutine|user subroutine|umat|"
     "vumat|plugin|extension|customize|customise",
     "There is no Python module and no user material: a case is a TOML file that any script can write, `--set "
     "KEY=VALUE` changes it, --json and --progress json give output for programs. [insitu] runs ParaView's Python "
     "scripts.",
     "insitu.pipeline.name|insitu.on_error|mesh.parameters"},
    {"parameter study|parametric study|parametric|sweep|design of experiments|doe|optimisation|optimization|"
     "calibration|sensitivity|inverse analysis|fitting|machine learning",
     "The desktop runs studies over several values of a key; so does a loop in a shell with `breccia run CASE --set "
     "KEY=VALUE -o FOLDER`. There is no optimiser: an external one can read summary.json and history.csv.",
     "mesh.parameters|output.gauges"},
    {"gui|desktop|window|interface program|editor|cad window|preprocessor|pre processing|preprocessing|"
     "postprocessor",
     "`./run desktop` (breccia-gui once installed) edits cases by forms and text, shows mesh and results, "
     "starts and watches runs. It writes the same TOML and starts the same commands.",
     "mesh|output|insitu"},
    {"help|manual|documentation|tutorial|example|getting started|template|guide|bug|issue|faq|forum|changelog",
     "The guide, by tasks: solver/manual/guide, as HTML by `./run guide`; `man breccia` and `breccia COMMAND "
     "--help`; `breccia explain` lists every key and `breccia explain KEY` one. meshes/ holds worked cases, and "
     "the desktop starts from them.",
     "title|mesh|material"},
    {"version|release|license|licence|copyright|citation|cite|reference|author|gpl|bsd|open source|price|"
     "commercial",
     "`breccia --version`. Breccia is under the BSD 3-Clause license, binaries that link gmsh under the GPL. "
     "CITATION.cff has the citation; sources of the methods are in solver/manual/theory/references.md.",
     "title"},
    {"stop when|stop criterion|stopping criterion|termination|end condition|until|"
     "equilibrium reached|at rest",
     "time.stop_when and stage.stop_when end a run or a stage, and a [[trigger]] writes a frame, a checkpoint or an "
     "extract, when a condition over columns of the history becomes true, such as \"broken_joints > 100\" or "
     "\"kinetic < 0.001 * peak(kinetic) for 1 ms\".",
     "time.stop_when|stage.stop_when|trigger.when"},
    {"extensometer|strain gauge|strain gage|crack mouth opening|cmod|cod|clip gauge|lvdt|virtual gauge|point history|"
     "probe point|monitor point|displacement of a point|line of points",
     "A [[gauge]] records displacement, velocity and stress at points and lines of the material, the change of the "
     "distance of two points, and the broken joints at a group; conditions can read it.",
     "gauge.kind|gauge.from|output.gauges"},
    {"stop|pause|abort|cancel|kill|interrupt|ctrl c|signal|steering|steer|restart file|hang",
     "`breccia control RUN stop` (pause, resume, frame, checkpoint, extract) controls a run; Ctrl-C or SIGTERM ends it "
     "after the step with a checkpoint; `breccia resume RUN` continues it, also after a crash.",
     "checkpoint|checkpoint.wall_interval|output.frame_interval"},
    {"security|sandbox|untrusted|trust|hash|reproducible|reproducibility|determinism|deterministic|provenance|"
     "verification|validation|accuracy|benchmark",
     "Results are the same bits on any number of ranks; provenance.json has hashes of all inputs. A confined process "
     "reads meshes; [insitu] scripts run with the rights of the user. README.md and the cases, meshes/*/README.md, "
     "list comparisons with theory and tests.",
     "mesh.memory_limit|mesh.time_limit|time.residual_limit"},
    {"abaqus|ls dyna|lsdyna|dyna|ansys|autodyn|radioss|nastran|optistruct|pam crash|comsol|marc|inp|inp file|"
     "k file|bdf|cdb|med|unv|keyword file|other software|migration|convert|conversion",
     "Of .inp, .unv, .bdf and .mesh files the mesh is read, and its sets become groups; materials, loads and "
     "steps are not. *Material is [[material]] and [[joint]] here, *Boundary [[stage.constraint]], *Dload "
     "[[stage.pressure]], *Contact [[contact]]. Other files: save the solids as STEP, or convert the mesh, as "
     "with meshio.",
     "mesh.file|material|stage.constraint|contact"},
    {"3dec|udec|flac|pfc|itasca|rocscience|rs2|rs3|plaxis|irazu|elfen|y geo|y2d|hosssdem|hoss|fdem|gfdem|"
     "combined finite discrete element|finite discrete element method|munjiza|solidity|opensees|mfem|fenics|"
     "lammps|yade|liggghts|edem|rocky|esys particle|akantu|code aster|calculix|warp3d",
     "Breccia is a combined finite-discrete element code as Munjiza's: tetrahedra with joints that fail, then "
     "contact. From block codes bring blocks as volumes with a [[joint]] between; from particle codes bonds "
     "become joints and particles bodies. Their files are not read.",
     "joint.between|contact|mesh.file|material.joints"},
    {"sph|smoothed particle|particle|dem|discrete element|discrete element method|bonded particle|mpm|"
     "material point|meshfree|meshless|peridynamic|lattice|lattice model|sphere packing",
     "There are no particles: a discrete element is a body of tetrahedra, and a body of one tetrahedron is the "
     "smallest. Debris is fragments that collide, which keep their mass.",
     "mesh.raster|contact|material.joints"},
    {"xfem|extended finite element|phase field|cohesive crack|smeared crack|damage mechanics|gradient damage|"
     "nonlocal|crack band|czm|fem|fea|finite element|finite element method|bem|boundary element|"
     "finite difference",
     "Cracks are discrete: joints on the faces between tetrahedra soften with their opening and dissipate their "
     "fracture energy; then the faces are free and can be in contact. There is no smeared damage, phase field or "
     "enrichment.",
     "joint|joint.softening|material.joints"},
    {"submodel|submodelling|submodeling|multiscale|multi scale|coupling|co simulation|cosimulation|fsi|"
     "fluid structure interaction|mesh tying|superelement|substructure",
     "There is no coupling with other programs and no submodel: drive the borders of a part with motions "
     "recorded elsewhere, as tables in a [[stage.constraint]].",
     "stage.constraint|function.table|output.gauges"},
    {"load step|load case|sequence|load history|time function|smooth step",
     "A run is one or several [[stage]] with an end each; stages do not inherit from the previous one. Loads and "
     "motions are numbers or functions of time: ramp, table, sine.",
     "stage|stage.end|function.ramp|function.table"},
    {"centre of mass|center of mass|center|mass|volume|surface area",
     "Masses follow from density and the mesh; output.gauges records the momentum and mean motion of a group. "
     "Spin is about the centre of a solid. `breccia check` gives sizes and volumes of groups.",
     "material.density|output.gauges|initial_velocity.angular"},
    {"coordinate|coordinate system|local coordinate|axes|transform|translate|rotate|scale factor|mirror|array|"
     "copy",
     "Coordinates are those of the mesh, times mesh.scale; axes are x, y and z of it. Parts are moved, turned, "
     "mirrored and copied in the .geo, whose numbers mesh.parameters set.",
     "mesh.scale|mesh.parameters|mesh.raster.origin"},
    {"tension|compression|shear|torsion|pull|push|press",
     "Tension is positive. Motions are a [[stage.constraint]], forces by area a [[stage.traction]] or "
     "[[stage.pressure]], forces of a whole a [[stage.force]]; torsion is a traction around the axis or two "
     "spinning bodies.",
     "stage.constraint|stage.traction|stage.pressure|stage.force"},
    {"warning|error|exit code|energy residual|blow up|unstable|instability|nan|not a number|explodes",
     "Exit codes: 0 success, 1 usage, 2 input, 3 failure of the simulation, 4 error in the program. A run whose "
     "energies exceed their limits ends; the last sound checkpoint is kept. Usual causes are time.step, penalties and "
     "units.",
     "time.residual_limit|time.energy_gain_limit|time.safety|contact.penalty"},
    {"default|key|toml|case file|input file|syntax|comment|include|variable",
     "A case is one TOML file; `breccia explain` lists its keys with their defaults. It has no variables and "
     "includes nothing: `--set KEY=VALUE` and mesh.parameters change it from outside.",
     "title|mesh.parameters|start"},
});
// clang-format on

}  // namespace

std::span<const Topic> program_topics() { return kProgramTopics; }

}  // namespace breccia::case_
