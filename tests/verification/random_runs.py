"""Runs of random cases and what their histories say of energy: what the generators of cases beside this file share.

A case comes from its seed alone, so that a failure can be repeated. Its run is sound when
- it ends with exit code 0,
- no dissipated term ever falls in history.csv,
- at no line is there energy from nowhere, but for GAIN of the most that was put in so far: what is held has risen since an earlier line
  by more than what was put in between, and what is held and dissipated is more than what was there at first and was put in. Each
  alone says less: the one also rises where a coarse step gives back what it lost before, the other where a law dissipates more than
  the step took from the motion.
"""

import argparse
import csv
import pathlib
import random
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

GAIN = 0.001
HARDEST = 3  # times that the load of a case is doubled if it does not break as much as it should
DISSIPATED = ["joint mode 1 [J]", "joint mode 2 [J]", "joint friction [J]", "contact dissipated [J]", "contact friction [J]",
              "plastic [J]", "viscous [J]"]
STORED = ["kinetic [J]", "elastic [J]", "joint elastic [J]", "contact stored [J]"]
WORK = "external work [J]"


def lines_of(folder):
    with open(folder / "history.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            yield {key: float(value) for key, value in row.items()}


def judge(lines):
    """What is wrong with a history, and its figures as shares of what was put in: gain, the most that came from nowhere, and made, the
    largest negative residual."""
    found, before, first, least, put_in = [], None, 0.0, 0.0, 0.0
    figures = {"gain": 0.0, "made": 0.0, "broken": 0, "fragments": 0, "steps": 0}
    for line in lines:
        excess = sum(line[key] for key in STORED) - line[WORK]
        if before is None:
            first = least = excess
        least, put_in = min(least, excess), max(put_in, first + line[WORK])
        when = f"t = {line['time [s]']:.4e} s"
        if put_in > 0:
            made = -line["residual [J]"] / put_in
            gain = min((excess - least) / put_in, made)
            figures.update(gain=max(figures["gain"], gain), made=max(figures["made"], made))
            if gain > GAIN:
                found.append(f"{when}: {gain * put_in:.4g} J from nowhere, {put_in:.4g} J put in")
        for key in DISSIPATED if before else []:
            if line[key] < before[key]:
                found.append(f"{when}: {key} falls from {before[key]:.17g} to {line[key]:.17g}")
        figures.update(broken=int(line["broken joints"]), fragments=int(line["fragments"]), steps=int(line["step"]))
        before = line
    if before is None:
        found.append("history.csv has no lines")
    return found, figures


def run(breccia, folder, seed, text, mesh):
    """Runs a case. Returns what is wrong and its figures."""
    case, out = folder / f"{seed}.toml", folder / str(seed)
    case.write_text(text.replace("MESH", f"{seed}.msh"), encoding="utf-8")
    if mesh:
        case.with_suffix(".msh").write_text(mesh, encoding="utf-8")
    command = [breccia, "run", str(case), "-f", "-o", str(out), "--set", "time.residual_limit=1e3", "--set", "time.energy_gain_limit=1e3"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return [f"exit {done.returncode}: {' '.join((done.stdout + done.stderr).split())[-400:]}"], {}
    return judge(lines_of(out))


def main(text_of, about, fragments=0):
    """@param text_of  (random.Random, arguments, doublings of the load) -> the case, and its mesh where it names MESH. @param fragments  least number at the end"""
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("breccia", help="the program")
    parser.add_argument("folder", type=pathlib.Path, help="where cases and runs go")
    parser.add_argument("seeds", type=int, nargs="+", help="seeds of the cases; with --count the first one")
    parser.add_argument("--count", type=int, help="so many cases from the first seed on")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time")
    parser.add_argument("--steps", type=float, default=1.0, help="length of the runs, as a multiple of the usual one")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    seeds = range(arguments.seeds[0], arguments.seeds[0] + arguments.count) if arguments.count else arguments.seeds

    def one(seed):
        for harder in range(HARDEST + 1):
            text, mesh = text_of(random.Random(seed), arguments, harder)
            found, figures = run(arguments.breccia, arguments.folder, seed, text, mesh)
            if found or figures["fragments"] >= fragments:
                return text.splitlines()[0], (found, figures)
        return text.splitlines()[0], (found + [f"only {figures['fragments']} fragments"], figures)

    failed = 0
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for seed, (title, (found, figures)) in zip(seeds, pool.map(one, seeds)):
            said = ", ".join(f"{key} {value:.2g}" if isinstance(value, float) else f"{value} {key}" for key, value in figures.items())
            print(f"{seed} {title.split(': ')[-1].strip(chr(34))}: {said}{'; ' + found[0] if found else ''}", flush=True)
            failed += bool(found)
    print(f"{len(seeds)} cases, {failed} failed")
    sys.exit(1 if failed else 0)
