"""Speed-up on several ranks, beside the reference's (experiments E5 A, E5 B and E6 of A. Schiava's thesis, chapter 9, and E3, chapter 6).

The case "e3" is a raster of bodies of one tetrahedron each, searched by MS as published. The case "corner" compares a fixed grid,
all of whose bodies are pulled into one half, with domains that follow the work; it runs to its end and takes its sizes from
--smallest and --largest, but not --steps.

What the machine itself allows is measured beside it: as many runs on one rank as there are ranks, each of a share of the model and
on a core of its own, at once and one alone. The column "ceiling" is the ranks times the time alone over the time at once: cores
share memory, caches and their clock, and a speed-up beyond that cannot be had but by smaller working sets.

usage: scaling.py PROGRAM MESHES FOLDER [--ranks 1,2] [--cases e5a,e5b,e6,e3,corner] [--smallest ELEMENTS] [--largest ELEMENTS] [--steps N] [--repeat N] [--no-ceiling] [--set KEY=VALUE]...

Every case runs on each number of ranks in turn, --repeat times; the shortest wall time counts. Writes FOLDER/scaling.csv and, where
gnuplot is there, FOLDER/scaling.svg. Ends with 1 if two runs of a case differ in a single bit of their state or kinetic energy.
"""

import argparse
import csv
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

SILENT = ["--set", "output.elements=false", "--set", "output.joints=false", "--set", "output.contacts=false",
          "--set", "output.frame_interval=0"]


def boxes(case, edge):
    radius = 0.5 * 3**0.5 * edge * 15e-3 + 0.1e-3
    centre = 0.5 * (edge * 15e-3 - 5e-3)
    return [f"bouncing_cubes/{case}", f"mesh.raster.boxes={edge}", f"sphere.radius={radius}", f"sphere.centre=[{centre},{centre},{centre}]"]


def tetrahedra(edge):
    file, *settings = boxes("case.toml", edge)
    return [file, *settings, "mesh.raster.kind=tetrahedra", "material.box.density=2340", "detection.algorithm=ms"]


def plate(cells, size):
    return ["slit_plate/case_a.toml", f"mesh.raster.cells=[{6 * cells},{6 * cells},{cells}]", f'mesh.raster.cell_size="{size} mm"']


def share_of_boxes(elements, ranks):
    n = round((elements / 24) ** (1 / 3))
    return f"mesh.raster.boxes=[{n},{n},{max(1, n // ranks)}]"


def share_of_plate(elements, ranks):
    n = round((elements / 864) ** (1 / 3))
    return f"mesh.raster.cells=[{6 * n},{6 * n},{max(1, n // ranks)}]"


# Elements -> case with its settings, the reference's speed-ups on 2 and 4 ranks: of the whole, of contact detection.
CASES = {
    "e5a": {24 * n**3: (boxes("case.toml", n), whole, search) for n, whole, search in (
        (4, {2: 1.87, 4: 2.92}, {2: 2.01, 4: 4.12}), (8, {2: 1.93, 4: 3.67}, {2: 2.03, 4: 4.12}),
        (16, {2: 1.98, 4: 3.87}, {2: 2.05, 4: 4.18}), (28, {2: 1.99, 4: 3.93}, {2: 2.05, 4: 4.19}))},
    "e5b": {24 * n**3: (boxes("case_breaking.toml", n), whole, search) for n, whole, search in (
        (4, {2: 1.85, 4: 2.92}, {2: 2.11, 4: 4.27}), (8, {2: 1.98, 4: 3.80}, {2: 2.03, 4: 4.07}),
        (16, {2: 2.01, 4: 3.94}, {2: 2.04, 4: 4.08}), (28, {2: 2.02, 4: 4.03}, {2: 2.04, 4: 4.13}))},
    "e6": {864 * 8**k: (plate(2**k, 10 / 2**k), whole, {}) for k, whole in (
        (0, {2: 1.85, 4: 3.29}), (1, {2: 1.94, 4: 3.65}), (2, {2: 1.94, 4: 3.67}), (3, {2: 1.97, 4: 3.76}))},
    "e3": {n**3: (tetrahedra(n), {}, {2: round(100 / on_two, 2), 4: round(100 / on_four, 2)}) for n, on_two, on_four in (
        (10, 46.3, 23.4), (48, 48.0, 24.3), (80, 47.9, 24.4), (110, 48.1, 24.6))},
    "corner": {24 * n**3: (boxes("case_corner.toml", n), {}, {}) for n in (8,)},
}
# Cases that run in several divisions of space on several ranks: name of the division -> its settings.
DIVISIONS = {"corner": {"grid": lambda ranks: ["domains.kind=grid", f"domains.n=[{ranks},1,1]"], "rcb": lambda ranks: []}}
TO_THE_END = {"corner"}
ONLY_WHEN_ASKED_FOR = {"corner", "e3"}

# A share of a case's model as a model of its own, for the ceiling: elements, ranks -> settings.
SHARES = {
    "e5a": lambda elements, ranks: [share_of_boxes(elements, ranks)], "e5b": lambda elements, ranks: [share_of_boxes(elements, ranks)],
    "e6": lambda elements, ranks: [share_of_plate(elements, ranks)],
}

PLOT = """set terminal svg size 900,600 background "white"
set output "scaling.svg"
set datafile separator ","
set logscale x
set xlabel "elements"
set ylabel "speed-up"
set key outside
set grid
plot {curves}
"""


def divisions(case, ranks):
    return DIVISIONS.get(case, {}) if ranks > 1 else {}


def command_of(arguments, elements, case, folder, more):
    (file, *settings), _, _ = CASES[case][elements]
    command = [arguments.program, "run", "-f", "--progress", "none", "-o", folder, arguments.meshes / file, *SILENT]
    if case not in TO_THE_END:
        settings = settings + [f"time.max_steps={arguments.steps}"]
    for setting in settings + more + arguments.set:
        command += ["--set", setting]
    return command


def seconds_at_once(arguments, elements, case, ranks, copies):
    """The longest wall time of so many runs at once, each of the share of one of `ranks`, on a core of its own."""
    folders = [arguments.folder / f"{case}_{elements}_share{copy}" for copy in range(copies)]
    more = SHARES[case](elements, ranks)
    cores = sorted(os.sched_getaffinity(0))
    runs = []
    for copy, folder in enumerate(folders):
        command = ["taskset", "-c", str(cores[copy])] + command_of(arguments, elements, case, folder, more)
        runs.append(subprocess.Popen(command))
    if any([process.wait() != 0 for process in runs]):
        sys.exit(f"{case}, {elements} elements: a run of a share failed")
    return max(json.loads((folder / "summary.json").read_text())["wall_s"] for folder in folders)


def ceiling(arguments, case, elements, ranks):
    """What so many cores of this machine allow; "" where that is not measured."""
    if arguments.no_ceiling or case not in SHARES or not 1 < ranks <= len(os.sched_getaffinity(0)) or not shutil.which("taskset"):
        return ""
    alone, together = ([seconds_at_once(arguments, elements, case, ranks, copies) for _ in range(arguments.repeat)] for copies in (1, ranks))
    return round(ranks * min(alone) / min(together), 3)


def run(arguments, elements, case, ranks, division):
    """One run; returns its summary and its kinetic energies."""
    folder = arguments.folder / f"{case}_{elements}_{ranks}{division}"
    command = command_of(arguments, elements, case, folder, DIVISIONS[case][division](ranks) if division else [])
    if ranks > 1:
        placed = ["--bind-to", "core"] if ranks <= (os.cpu_count() or 1) else ["--oversubscribe"]
        command = ["mpiexec", *placed, "-n", str(ranks)] + command
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    subprocess.run(command, check=True, env=environment)
    with open(folder / "history.csv", newline="") as stream:
        kinetic = [row["kinetic [J]"] for row in csv.DictReader(stream)]
    return json.loads((folder / "summary.json").read_text()), kinetic


def measure(arguments, case, elements):
    """Rows of the table for one size; stops the program when ranks disagree."""
    best, first = {}, None
    for _ in range(arguments.repeat):
        for ranks in arguments.ranks:
            for division in divisions(case, ranks) or [""]:
                summary, kinetic = run(arguments, elements, case, ranks, division)
                bits = (summary["state_hash"], kinetic)
                first = first or bits
                if bits != first:
                    sys.exit(f"{case}, {elements} elements: {ranks} ranks {division} give other bits")
                key = (ranks, division)
                if key not in best or summary["wall_s"] < best[key]["wall_s"]:
                    best[key] = summary
    _, whole, search = CASES[case][elements]
    ceilings = {ranks: ceiling(arguments, case, elements, ranks) for ranks in arguments.ranks}
    for (ranks, division), s in best.items():
        one = best.get((1, ""), s)
        phases, steps = s["phases"], max(s["steps"], 1)
        yield {
            "case": case, "elements": elements, "ranks": ranks, "division": division, "steps": s["steps"], "wall_s": round(s["wall_s"], 3),
            "speedup": round(one["wall_s"] / s["wall_s"], 3) if (1, "") in best else "", "ceiling": ceilings[ranks], "reference_speedup": whole.get(ranks, ""),
            "search_s": round(phases["search"], 4),
            "search_speedup": round(one["phases"]["search"] / phases["search"], 3) if (1, "") in best and phases["search"] > 0 else "",
            "reference_search_speedup": search.get(ranks, ""),
            "search_percent_of_one_rank": round(100 * phases["search"] / one["wall_s"], 2),
            "communication_percent": round(100 * phases["communication"] / s["wall_s"], 2),
            "decomposition_percent": round(100 * phases["decomposition"] / s["wall_s"], 2),
            "decompositions": s["decompositions"], "searches": s["searches"], "broken_joints": s["broken_joints"],
            "messages_a_step": round(s["messages"] / steps, 2), "kB_a_step": round(s["message_bytes"] / steps / 1000, 2),
            "element_steps_per_s": round(s["element_steps_per_s"]), "state_hash": s["state_hash"]}


def plot(arguments, rows):
    curves = []
    for case in arguments.cases:
        for ranks in arguments.ranks:
            mine = [r for r in rows if r["case"] == case and r["ranks"] == ranks and ranks > 1 and not r["division"]]
            if not mine:
                continue
            for column, name in (("speedup", "Breccia"), ("reference_speedup", "reference")):
                points = [(r["elements"], r[column]) for r in mine if r[column] != ""]
                if not points:
                    continue
                data = f"{case}_{ranks}_{name}.dat"
                (arguments.folder / data).write_text("".join(f"{x},{y}\n" for x, y in points))
                curves.append(f'"{data}" with linespoints title "{case}, {ranks} ranks, {name}"')
    if curves and shutil.which("gnuplot"):
        (arguments.folder / "scaling.gp").write_text(PLOT.format(curves=", \\\n  ".join(curves)))
        subprocess.run(["gnuplot", "scaling.gp"], cwd=arguments.folder, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("meshes", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--ranks", type=lambda text: [int(n) for n in text.split(",")], default=[1, 2])
    parser.add_argument("--cases", type=lambda text: text.split(","), default=[c for c in CASES if c not in ONLY_WHEN_ASKED_FOR])
    parser.add_argument("--smallest", type=int, default=0)
    parser.add_argument("--largest", type=int, default=10**9)
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--no-ceiling", action="store_true")
    parser.add_argument("--set", action="append", default=[])
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for case in arguments.cases:
        for elements in CASES[case]:
            if not arguments.smallest <= elements <= arguments.largest:
                continue
            for row in measure(arguments, case, elements):
                print(" ".join(f"{k}={v}" for k, v in row.items() if v != ""), flush=True)
                rows.append(row)
            with open(arguments.folder / "scaling.csv", "w", newline="") as stream:
                table = csv.DictWriter(stream, fieldnames=list(rows[0]))
                table.writeheader()
                table.writerows(rows)
    plot(arguments, rows)


if __name__ == "__main__":
    main()
