"""Checks that the sources keep the rules of the house: who may include what, file sizes, nothing left open.

usage: layering.py REPOSITORY
Prints one line a violation, "file:line: what", and exits 1 when there is any.
"""

import re
import sys
from fnmatch import fnmatch
from pathlib import Path

# Folder of solver/ -> folders whose headers its files may include (its own always).
MAY_INCLUDE = {
    "base": set(),
    "system": {"base"},
    "run_folder": {"base", "system"},  # of both, headers alone: HEADER_ONLY
    "case": {"base", "system"},
    "mesh": {"base", "system"},
    "parallel": {"base", "mesh"},
    "discretisation": {"base", "mesh"},
    "physics": {"base", "mesh", "discretisation"},
    "detection": {"base", "mesh", "discretisation"},
    "model": {"base", "system", "case", "mesh", "discretisation", "physics"},
    "state": {"base", "mesh", "discretisation", "physics", "model"},
    "output": {"base", "system", "run_folder", "case", "mesh", "state", "parallel"},
    "contact": {"base", "case", "mesh", "discretisation", "physics", "detection", "model", "state", "parallel"},
    "domains": {"base", "case", "mesh", "discretisation", "physics", "model", "state", "contact", "parallel"},
    "observe": {"base", "system", "case", "mesh", "discretisation", "physics", "model", "state", "contact", "domains", "parallel", "output"},
}
MAY_INCLUDE["report"] = {"base", "system", "run_folder", "case", "output"}
MAY_INCLUDE["advice"] = set(MAY_INCLUDE) - {"report"}
MAY_INCLUDE["simulation"] = set(MAY_INCLUDE) - {"advice"}
MAY_INCLUDE["commands"] = set(MAY_INCLUDE)
PROGRAM = set(MAY_INCLUDE)  # what main.cpp may include: everything

# The C interface of the in-situ adaptor is the one header from outside solver/, for output alone.
IN_SITU_HEADER = "catalyst/insitu_abi.h"

# What reads the files of a run for solver, desktop, plug-in and adaptor alike. It is header only and includes headers alone, of the
# solver these: who uses it links nothing.
HEADER_ONLY = re.compile(r"run_folder/\w+\.hpp|base/(json_depth|trimmed)\.hpp|system/(open_regular|write_all)\.hpp")

# What catalyst/, the adaptor behind that interface, may include: itself, HEADER_ONLY, VTK and ParaView, MPI, Python (in VTK's wrapping), X11
# and JSON.
ADAPTOR = re.compile(rf"({HEADER_ONLY.pattern}|catalyst/\w+\.h(pp)?|vtk\w+\.h|mpi\.h|Python\.h|X11/\w+\.h|nlohmann/json\.hpp)")

# What plugins/ may include: itself (without a folder), HEADER_ONLY, VTK and ParaView, Qt and ParaView's window.
PLUGIN = re.compile(rf"{HEADER_ONLY.pattern}|(Breccia|breccia|vtk|pq|Q)\w+(\.h)?")

# What a folder of gui/ may include: its own headers and those it builds on, Qt (Q...), VTK (vtk...), and the solver's case and base.
QT, VTK_HEADER, WIDGETS = r"Q(?!VTK)\w+", r"vtk\w+\.h", r"Q(Application|\w*(Widget|Dialog|Window|Box|Button|Label|View|Menu|Painter|Icon|Pixmap))"
GUI = {
    "core": (("core", "case", "base", "system", "run_folder"), QT),
    "render": (("render",), VTK_HEADER),
    "models": (("models", "core", "case", "base"), QT),
    "widgets": (("widgets", "models", "core", "render", "case", "base"), rf"{QT}|QVTK\w+\.h|{VTK_HEADER}"),
}

# Third-party headers -> files of solver/ that may include them. Eigen is the vector type of base/types.hpp, so everywhere.
THIRD_PARTY = [
    (r"Eigen/.*", ["*"]),
    (r"spdlog/.*", ["base/log.cpp"]),
    (r"fmt/.*", ["base/log.cpp", "base/quantity_text.cpp", "output/*.cpp", "report/*.cpp", "advice/*.cpp", "commands/*.cpp"]),
    (r"(toml\.hpp|toml\+\+/.*|toml\+\+\.h|tomlplusplus/.*)", ["case/*reader*.cpp"]),
    (r"gmsh(c|\.h_cwrap)?\.h", ["mesh/gmsh/*.cpp"]),
    (r"mpi\.h", ["parallel/*"]),
    (r"(hdf5(_hl)?|H5\w*)\.h", ["output/frames/hdf5*.cpp"]),
    (r"nlohmann/.*", ["output/*.cpp", "report/*.cpp", "commands/json_report.cpp",
                     "run_folder/status.hpp", "run_folder/series.hpp"]),
    (r"CLI/.*", ["main.cpp", "commands/command_line*"]),
]

# Of the operating system and the compiler; anything else with a slash or ".h" needs a line in THIRD_PARTY.
SYSTEM = re.compile(
    r"(experimental/simd|(x86|imm)intrin\.h|dlfcn\.h|fcntl\.h|malloc\.h|poll\.h|sched\.h|spawn\.h|unistd\.h|cpuid\.h|dirent\.h|ext/stdio_filebuf\.h|ucontext\.h|arpa/inet\.h"
    r"|linux/(audit|filter|landlock|seccomp)\.h|sys/(file|syscall|ioctl|mman|prctl|resource|socket|stat|statvfs|types|un|utsname|wait)\.h)")

SOURCE_SUFFIXES = {".cpp", ".hpp", ".h", ".cxx", ".py"}
MAX_LINES = 450
MAX_COLUMNS = 120  # as in .clang-format, which does not break comments and string literals
FORMATTED_SUFFIXES = {".cpp", ".hpp", ".h"}
LEFT_OPEN = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def include_problem(file, bracket, header):
    """What is wrong with `#include` of header in file (path below solver/), or None."""
    for pattern, files in THIRD_PARTY:
        if re.fullmatch(pattern, header):
            if any(fnmatch(file, allowed) for allowed in files):
                return None
            return f"third-party header {header} is allowed only in {', '.join(files)}"
    if bracket == "<":
        if ("/" not in header and not header.endswith(".h")) or SYSTEM.fullmatch(header):
            return None
        return f"third-party header {header} is not in the table of tests/layering"
    folder = file.split("/")[0] if "/" in file else None
    if header == IN_SITU_HEADER and folder == "output":
        return None
    if "/" not in header:
        return None if folder is None else f'write the folder in the include of "{header}"'
    target = header.split("/")[0]
    allowed = MAY_INCLUDE[folder] | {folder} if folder else PROGRAM
    if target not in allowed:
        return f"{folder or 'the program'} must not include {header}; it may include {', '.join(sorted(allowed))}"
    if HEADER_ONLY.fullmatch(file) and not HEADER_ONLY.fullmatch(header):
        return f"{file} is for programs that link nothing of the solver and must not include {header}; it may include {HEADER_ONLY.pattern}"
    return None


def solver_problems(solver):
    for path in sorted(solver.rglob("*")):
        if path.suffix not in SOURCE_SUFFIXES:
            continue
        file = path.relative_to(solver).as_posix()
        if file.startswith("manual/"):  # documents, and the scripts that draw and build them
            continue
        if "/" in file and file.split("/")[0] not in MAY_INCLUDE:
            yield path, 1, f"folder solver/{file.split('/')[0]} is not in the table of tests/layering"
            continue
        if file.startswith("run_folder/") and path.suffix != ".hpp":
            yield path, 1, "solver/run_folder is header only"
            continue
        if "/" not in file and file != "main.cpp":
            yield path, 1, "only main.cpp stands at the top of solver/"
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if match and (problem := include_problem(file, *match.groups())):
                yield path, number, problem


def adaptor_problems(adaptor):
    for path in sorted(adaptor.rglob("*")):
        if path.suffix not in SOURCE_SUFFIXES:
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match or ADAPTOR.fullmatch(match[2]) or SYSTEM.fullmatch(match[2]):
                continue
            # The interface is for programs in C too; other bare names are those of the C++ library.
            if match[1] == "<" and (re.fullmatch(r"\w+", match[2]) or match[2] in ("stddef.h", "stdint.h")):
                continue
            yield path, number, f"catalyst must not include {match[2]}; it may include its own headers, solver/run_folder, VTK, ParaView, MPI, Python, X11 and JSON"


def plugin_problems(plugins):
    for path in sorted(plugins.rglob("*")):
        if path.suffix not in {".cxx", ".h"}:
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match or PLUGIN.fullmatch(match[2]) or SYSTEM.fullmatch(match[2]):
                continue
            if match[1] == "<" and re.fullmatch(r"\w+", match[2]):
                continue
            yield path, number, f"plugins must not include {match[2]}; it may include its own headers, solver/run_folder, VTK, ParaView and Qt"


def gui_problems(gui):
    for path in sorted(gui.rglob("*")):
        folder = path.relative_to(gui).parts[0]
        if path.suffix not in SOURCE_SUFFIXES or folder not in GUI:
            continue
        folders, third_party = GUI[folder]
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            header = match[2]
            if "/" in header and header.split("/")[0] in folders:
                continue
            if folder == "core" and re.fullmatch(WIDGETS, header):
                yield path, number, f"gui/core has no widget and must not include {header}"
            elif not (re.fullmatch(third_party, header) or SYSTEM.fullmatch(header) or re.fullmatch(r"[a-z_]+|signal\.h", header)):
                yield path, number, f"gui/{folder} must not include {header}; it may include {', '.join(folders)} and what matches {third_party}"


def text_problems(repository):
    """Sizes and things left open, in every source of the repository."""
    for top in ("solver", "catalyst", "gui", "plugins", "meshes", "tests"):
        for path in sorted((repository / top).rglob("*")):
            if path.suffix not in SOURCE_SUFFIXES and path.name != "CMakeLists.txt":
                continue
            lines = path.read_text(encoding="utf-8").splitlines()
            if len(lines) > MAX_LINES:
                yield path, len(lines), f"{len(lines)} lines; split it along its meaning (at most {MAX_LINES})"
            for number, line in enumerate(lines, 1):
                if match := LEFT_OPEN.search(line):
                    yield path, number, f"{match.group()} left in the source"
                if path.suffix in FORMATTED_SUFFIXES and len(line) > MAX_COLUMNS:
                    yield path, number, f"{len(line)} columns; at most {MAX_COLUMNS}"


def problems(repository):
    """Every violation in the repository as "file:line: what"."""
    repository = Path(repository)
    found = [*solver_problems(repository / "solver"), *adaptor_problems(repository / "catalyst"), *plugin_problems(repository / "plugins"),
             *gui_problems(repository / "gui"), *text_problems(repository)]
    return [f"{path.relative_to(repository)}:{line}: {what}" for path, line, what in found]


def main():
    if len(sys.argv) != 2 or not (Path(sys.argv[1]) / "solver").is_dir():
        sys.exit(__doc__)
    found = problems(sys.argv[1])
    print("\n".join(found) if found else "no violations")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
