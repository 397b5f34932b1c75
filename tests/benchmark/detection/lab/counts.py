"""Counts instead of times: instructions, cache misses and mispredicted branches of one detection of each algorithm, by callgrind.

usage: counts.py PROGRAM FOLDER [--bodies N] [--no-peers] [--algorithms NAME,NAME]

Only building and searching is counted (count_cycle in experiments.hpp), so the figures do not depend on what else the machine
does. Writes FOLDER/counts.csv. direct_search is left out: its counts are quadratic.
"""

import argparse
import csv
import re
import subprocess
import sys
from pathlib import Path

EVENTS = {"Ir": "instructions", "D1m": "first_level_misses", "LLm": "last_level_misses", "Bm": "mispredicted"}
CASES = [("equal_size", "III", ""), ("points", "points", "sizes 1:1"), ("points", "points", "sizes 1:100")]
LEFT_OUT = {"direct_search"}


def events_of(file):
    """Event -> total, of a callgrind output file."""
    text = file.read_text()
    names = re.search(r"^events: (.*)$", text, re.MULTILINE).group(1).split()
    totals = re.search(r"^(?:summary|totals): (.*)$", text, re.MULTILINE).group(1).split()
    raw = {name: int(total) for name, total in zip(names, totals)} | {name: 0 for name in names[len(totals):]}
    if raw["Ir"] == 0:
        sys.exit(f"counts.py: {file} holds no counted cycle")
    return {"Ir": raw["Ir"], "D1m": raw["D1mr"] + raw["D1mw"], "LLm": raw["DLmr"] + raw["DLmw"], "Bm": raw["Bcm"] + raw["Bim"]}


def count(program, folder, algorithm, experiment, scene, bodies):
    """Bodies or tetrahedra there were, and event -> total of one detection of them."""
    out = folder / f"callgrind.{algorithm}.out"
    out.unlink(missing_ok=True)
    told = subprocess.run(["valgrind", "--tool=callgrind", "--quiet", "--cache-sim=yes", "--branch-sim=yes", "--collect-atstart=no",
                    "--toggle-collect=breccia_counted_cycle", f"--callgrind-out-file={out}",
                    program, "--count", algorithm, "--experiments", experiment, "--scene", scene, "--largest", str(bodies)],
                   check=True, stdout=subprocess.PIPE, text=True).stdout
    events = events_of(out)
    out.unlink()
    return int(re.search(r": (\d+) ", told.splitlines()[-1]).group(1)), events  # experiments round the number to a cube


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--bodies", type=int, default=100_000, help="bodies or tetrahedra (default: 100000)")
    parser.add_argument("--no-peers", action="store_true", help="Breccia's own searches only")
    parser.add_argument("--algorithms", type=lambda text: text.split(","), help="only these")
    asked = parser.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    peers = ["--no-peers"] if asked.no_peers else []
    listed = subprocess.run([asked.program, "--names", *peers], check=True, capture_output=True, text=True).stdout
    names = [line.split() for line in listed.splitlines() if line.startswith(("equal_size ", "points "))]
    with open(asked.folder / "counts.csv", "w", newline="") as stream:
        table = csv.writer(stream)
        table.writerow(["experiment", "scene", "algorithm", "bodies", *EVENTS.values()])
        for kind, experiment, scene in CASES:
            print(f"\n{scene or experiment}, {asked.bodies:,}: a body or tetrahedron\n{'':14}{'instructions':>14}{'L1 misses':>11}{'LL misses':>11}{'mispredicted':>14}")
            for name in (n for k, n in names if k == kind and n not in LEFT_OUT):
                if asked.algorithms and name not in asked.algorithms:
                    continue
                bodies, events = count(asked.program, asked.folder, name, experiment, scene, asked.bodies)
                table.writerow([experiment, scene, name, bodies, *(events[e] for e in EVENTS)])
                stream.flush()
                each = [events[e] / bodies for e in EVENTS]
                print(f"{name:14}{each[0]:14,.0f}{each[1]:11.2f}{each[2]:11.3f}{each[3]:14.2f}", flush=True)


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f"counts.py: {error}")
