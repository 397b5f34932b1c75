"""Random cases of the other generators, run on one rank, on several with other margins and buffers, and stopped at a random step and resumed:
all end in the same state, to the bit.

usage: same_bits.py BRECCIA MPIEXEC FOLDER SEED... [--count N] [--steps N]

Prints a line a case and exits with 1 if any differs.
"""

import argparse
import json
import pathlib
import random
import shutil
import subprocess
import sys

import fragmentations
import piles
import relatives

GENERATORS = [fragmentations, piles, relatives]


class Case:
    def __init__(self, arguments, seed):
        self.breccia, self.mpiexec, self.folder = arguments.breccia, arguments.mpiexec, arguments.folder / str(seed)
        self.folder.mkdir(parents=True, exist_ok=True)
        generator = GENERATORS[seed % len(GENERATORS)]
        text, mesh = generator.text_of(random.Random(seed), argparse.Namespace(steps=1.0), 0)
        (self.folder / "mesh.msh").write_text(mesh)
        self.file = self.folder / "case.toml"
        self.file.write_text(text.replace("MESH", "mesh.msh"))
        self.name = generator.__name__

    def call(self, ranks, folder, *arguments):
        """@return  the summary, or None where the program refuses so many ranks"""
        command = [self.mpiexec, "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        shutil.rmtree(self.folder / folder, ignore_errors=True)
        command += [self.breccia, *arguments, "-o", self.folder / folder, "--progress", "none"]
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
        if done.returncode == 2 and ranks > 1:
            return None
        summary = self.folder / folder / "summary.json"
        if done.returncode not in (0, 3):
            raise SystemExit(f"{self.file}: exit code {done.returncode}: {done.stderr[-500:]}")
        return json.loads(summary.read_text())

    def run(self, ranks, folder, steps, *settings):
        settings = ["output.frame_interval=0", f"time.max_steps={steps}", *settings]
        return self.call(ranks, folder, "run", self.file, *(part for key in settings for part in ("--set", key)))


def judge(arguments, seed):
    rng, case = random.Random(seed), Case(arguments, seed)
    whole = case.run(1, "whole", arguments.steps)
    steps = whole["steps"]
    hashes = {"1": whole["state_hash"]}

    def note(name, summary):
        if summary is not None:
            hashes[name] = summary["state_hash"]

    note("1, own buffer", case.run(1, "buffer", arguments.steps, f"detection.buffer={rng.uniform(0.02, 0.3) * 1e-3}"))
    note("2", case.run(2, "two", arguments.steps))
    note("3, narrow", case.run(3, "three", arguments.steps, f"domains.margin={rng.choice([0.1, 0.5])}"))
    if steps > 2 and whole["status"] != "failed":
        stop, ranks = rng.randrange(1, steps), rng.choice([1, 2])
        case.run(1, "part", stop)
        note(f"resumed at {stop} on {ranks}",
             case.call(ranks, "resumed", "resume", case.folder / "part", "--set", f"time.max_steps={arguments.steps}"))
    differ = {name: text for name, text in hashes.items() if text != hashes["1"]}
    print(f"{seed} {case.name}: {steps} steps, {len(hashes)} runs" + (f"; {hashes['1']} but {differ}" if differ else ""), flush=True)
    return bool(differ)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("breccia", help="the program")
    parser.add_argument("mpiexec", help="that launches it on several ranks")
    parser.add_argument("folder", type=pathlib.Path, help="where cases and runs go")
    parser.add_argument("seeds", type=int, nargs="+", help="seeds of the cases; with --count the first one")
    parser.add_argument("--count", type=int, help="so many cases from the first seed on")
    parser.add_argument("--steps", type=int, default=3000, help="at which a run ends that has not ended before")
    arguments = parser.parse_args()
    seeds = range(arguments.seeds[0], arguments.seeds[0] + arguments.count) if arguments.count else arguments.seeds
    differ = sum(judge(arguments, seed) for seed in seeds)
    print(f"{len(seeds)} cases, {differ} differ")
    sys.exit(1 if differ else 0)


if __name__ == "__main__":
    main()
