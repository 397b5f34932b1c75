"""What each rule of contact gains: the experiments of README.md with all rules on and with some off, as one table.

usage: ablation.py BENCH_CONTACT FOLDER [--without NAME[,NAME] ...] [--experiments NAME ...] [--jobs N] [--long]
                   [--keep] [--no-count]
       ablation.py BENCH_CONTACT FOLDER --all-rules [--experiments NAME ...]
       ablation.py BENCH_CONTACT FOLDER --check BRECCIA [--one-each]

Writes table.md and table.csv into the folder, and the results of every run. A figure that is clearly worse than with
all rules is bold.
"""

import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "verification"))
import fragmentations  # noqa: E402
import piles  # noqa: E402
from impacts import Aligned, Impacts, RandomCases, Rest  # noqa: E402
from rubbing import Rig, Slides, Slopes, Spins  # noqa: E402
from structures import Arch, Debris, Platens, Seam  # noqa: E402
from surfaces import Ball, Cubes, Oblique  # noqa: E402

# Rules that act on the same error, of which one could do the work of both.
PAIRS = ["closing_pull,remembered_gain", "facing_sides,facing_face", "facing_sides,corner_normals",
         "bridge_gaps,first_offset"]
# Figures below these are as good as none. A figure is worse where it is above that and twice what it is with all rules.
LEAST = {"gain": 1e-4, "lost": 1e-3, "friction": 2e-3, "unsteady": 0.02, "sideways": 0.01, "failed": 0.5}
PERCENT = ["gain", "lost", "friction", "unsteady", "sideways"]
DEARER = {"cost": 1.25, "instructions": 1.02}  # CPU time beside other work scatters
SHOWN = 3  # failures of a row in an experiment
CONTACT_FORCES = "breccia::contact_forces(breccia::ContactParams*"
ALL = "all rules"


def experiments(long):
    """@param long  more seeds, and a longer fall of the debris"""
    return [Impacts(steep=False), Impacts(steep=True), Aligned(), Rest(),
            RandomCases("piles", piles, range(1, 31) if long else [3, 8, 11, 12]),
            RandomCases("fragmentations", fragmentations, range(1, 51) if long else [7, 21, 107, 325]),
            Rig("rig", [0.3, 0.6]), Rig("rig at 0.9", [0.9]), Slopes(), Slides(), Spins(),
            Arch(), Seam(), Ball(20 if long else 12), Oblique(4 if long else 2),
            Cubes(4 if long else 1, 0.25 if long else 0.05), Platens(), Debris(1.0 if long else 0.25)]


def write_cases(experiment, folder):
    """@return  label -> file"""
    folder.mkdir(parents=True, exist_ok=True)
    files = {}
    for number, (label, (case, mesh)) in enumerate(experiment.cases().items()):
        files[label] = folder / f"{number}.toml"
        if mesh:
            files[label].with_suffix(".msh").write_text(mesh, encoding="utf-8")
        files[label].write_text(f"# {label}\n" + case.replace("MESH", f"{number}.msh"), encoding="utf-8")
    return files


def run(bench, row, file, keep):
    """@param keep  read the result of an earlier call. @return  what bench_contact prints"""
    result = file.parent / row.replace(" ", "_") / f"{file.stem}.json"
    if not (keep and result.exists()):
        command = [bench, str(file)] + ([] if row == ALL else ["--without", row])
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        failure = {"status": f"exit {done.returncode}: {done.stderr[-200:]}", "history": {}, "cpu": 0}
        printed = done.stdout or json.dumps(failure)
        result.parent.mkdir(exist_ok=True)
        result.write_text(printed, encoding="utf-8")
    return json.loads(result.read_text(encoding="utf-8"))


def count(bench, row, experiment, folder, keep):
    """Instructions of the contact forces, a couple that touches and a step, by valgrind."""
    case, mesh = experiment.counted()
    place = folder / row.replace(" ", "_")
    place.mkdir(parents=True, exist_ok=True)
    (place / "mesh.msh").write_text(mesh, encoding="utf-8")
    (place / "case.toml").write_text(case.replace("MESH", "mesh.msh"), encoding="utf-8")
    result = place / "count.json"
    if not (keep and result.exists()):
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={place / 'callgrind'}",
                   f"--toggle-collect={CONTACT_FORCES}", bench, str(place / "case.toml")]
        command += [] if row == ALL else ["--without", row]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        touching = sum(json.loads(done.stdout)["history"]["touching"])
        lines = (place / "callgrind").read_text(encoding="utf-8").splitlines()
        counted = next(int(line.split()[1]) for line in lines if line.startswith("totals:"))
        result.write_text(json.dumps({"instructions": counted, "touching": touching}), encoding="utf-8")
    found = json.loads(result.read_text(encoding="utf-8"))
    return found["instructions"] / found["touching"]


def counts(arguments, pool, rows, chosen):
    """@return  (row, experiment) -> count(), to be waited for"""
    if arguments.no_count or not shutil.which("valgrind"):
        return {}
    return {(row, e): pool.submit(count, arguments.bench, row, e, arguments.folder / "counted", arguments.keep)
            for e in chosen if hasattr(e, "counted") for row in rows}


def measure(arguments, rows, chosen):
    """@return  (row, experiment) -> figures"""
    with ThreadPoolExecutor(arguments.jobs) as pool:
        waiting = {}
        for experiment in chosen:
            for label, file in write_cases(experiment, arguments.folder / experiment.name.replace(" ", "_")).items():
                for row in rows:
                    waiting[row, experiment, label] = pool.submit(run, arguments.bench, row, file, arguments.keep)
        counting = counts(arguments, pool, rows, chosen)
        found = {}
        for experiment in chosen:
            for row in rows:
                results = {label: task.result() for (r, e, label), task in waiting.items()
                           if r == row and e is experiment}
                figures = experiment.figures(results)
                figures["cpu"] = sum(result["cpu"] for result in results.values())
                if (row, experiment) in counting:
                    figures["instructions"] = counting[row, experiment].result()
                found[row, experiment.name] = figures
            seconds = found[rows[0], experiment.name]["cpu"]
            print(f"{experiment.name}: {seconds:.1f} s with {rows[0]}", file=sys.stderr, flush=True)
    for (row, name), figures in found.items():
        base = found[rows[0], name]["cpu"]
        figures["cost"] = figures["cpu"] / base if base > 0 else 1.0
        figures["failed"] = len(figures["failures"])
    return found


def columns(rows, chosen, found):
    names = ["gain", "lost", "friction", "unsteady", "sideways", "failed", "cost", "instructions"]
    return [(e.name, column) for e in chosen for column in names if column in found[rows[0], e.name]]


def shown(column, value):
    if column in ("failed", "instructions"):
        return f"{value:,.0f}"
    return f"{value:.2f}" if column == "cost" else f"{100 * value:.2g}"


def is_worse(column, value, base):
    if column in DEARER:
        return value > DEARER[column] * base
    return value > LEAST[column] and value > 2 * base


def worse(row, base_row, wide, found):
    """The figures that are worse than with all rules, in words."""
    for name, column in wide:
        value, base = found[row, name][column], found[base_row, name][column]
        if is_worse(column, value, base):
            unit = " %" if column in PERCENT else ""
            yield f"{name}: {column} {shown(column, base)} to {shown(column, value)}{unit}"


def write_tables(folder, rows, chosen, found):
    wide = columns(rows, chosen, found)
    with open(folder / "table.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["without", *(f"{name}: {column}" for name, column in wide)])
        for row in rows:
            writer.writerow([row, *(f"{found[row, name][column]:.4g}" for name, column in wide)])
    names = [e.name for e in chosen]
    heads = [f"{name}: {column}" + (", %" if column in PERCENT else "") for name, column in wide]
    lines = ["| without | " + " | ".join(heads) + " |", "|---" * (len(wide) + 1) + "|"]
    for row in rows:
        cells = []
        for name, column in wide:
            value, base = found[row, name][column], found[rows[0], name][column]
            bold = "**" if row != rows[0] and is_worse(column, value, base) else ""
            cells.append(bold + shown(column, value) + bold)
        lines.append(f"| {row.replace(',', ', ')} | " + " | ".join(cells) + " |")
    lines += ["", "Worse without it:", "", "| without | worse |", "|---|---|"]
    lines += [f"| {row.replace(',', ', ')} | " + "; ".join(worse(row, rows[0], wide, found)) + " |" for row in rows[1:]]
    lines += ["", "Failures, without those with all rules:", ""]
    usual = {(name, failure) for name in names for failure in found[rows[0], name]["failures"]}
    lines += [f"- {rows[0]}: {name}: {failure}" for name, failure in sorted(usual)]
    for row in rows[1:]:
        for name in names:
            new = [failure for failure in found[row, name]["failures"] if (name, failure) not in usual]
            more = f"; {len(new) - SHOWN} more" if len(new) > SHOWN else ""
            if new:
                lines.append(f"- {row.replace(',', ', ')}: {name}: " + "; ".join(new[:SHOWN]) + more)
    (folder / "table.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))


def check(breccia, chosen, folder, one_each):
    """@param one_each  of cases that begin with the same word the first. @return  number of cases that are refused"""
    refused = 0
    for experiment in chosen:
        files = write_cases(experiment, folder / experiment.name.replace(" ", "_"))
        first = {label.split()[0]: label for label in reversed(files)}
        for label, file in files.items():
            if one_each and label not in first.values():
                continue
            done = subprocess.run([breccia, "check", str(file)], capture_output=True, text=True, check=False)
            if done.returncode != 0:
                refused += 1
                print(f"{experiment.name}, {label}: {done.stderr.strip()}")
    print(f"{refused} cases refused")
    return refused


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bench", help="the program bench_contact")
    parser.add_argument("folder", type=pathlib.Path, help="where cases and tables go")
    parser.add_argument("--without", action="append",
                        help="a row: rules that are off; default: each of bench_contact --rules, and pairs")
    parser.add_argument("--all-rules", action="store_true",
                        help="that row alone; exit code 1 where an experiment fails")
    parser.add_argument("--experiments", nargs="+", help="those alone; default: all")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    parser.add_argument("--long", action="store_true", help="more random cases, a longer fall of debris")
    parser.add_argument("--keep", action="store_true", help="results of an earlier call are not made again")
    parser.add_argument("--no-count", action="store_true", help="count no instructions, which takes 20 s a row")
    parser.add_argument("--check", metavar="BRECCIA", help="check the cases with the program instead")
    parser.add_argument("--one-each", action="store_true", help="check one case of a kind")
    arguments = parser.parse_args()
    chosen = [e for e in experiments(arguments.long) if not arguments.experiments or e.name in arguments.experiments]
    if arguments.check:
        sys.exit(1 if check(arguments.check, chosen, arguments.folder, arguments.one_each) else 0)
    rules = subprocess.run([arguments.bench, "--rules"], capture_output=True, text=True, check=True).stdout.split()
    pairs = [pair for pair in PAIRS if set(pair.split(",")) <= set(rules)]
    rows = [ALL] if arguments.all_rules else [ALL, *(arguments.without or [*rules, *pairs])]
    arguments.folder.mkdir(parents=True, exist_ok=True)
    found = measure(arguments, rows, chosen)
    write_tables(arguments.folder, rows, chosen, found)
    if arguments.all_rules:
        sys.exit(1 if any(figures["failures"] for figures in found.values()) else 0)


if __name__ == "__main__":
    main()
