"""Kills a run again and again at random moments, all its ranks or one of them, and resumes it on 1, 2 and 3 ranks in turn until it is done:
state hash and history.csv must be those of the undisturbed run.

usage: kill_and_resume.py BRECCIA MPIEXEC CASE FOLDER KILLS [SEED] [KEY=VALUE ...]

A run that is done before it has been killed is begun anew, until there were KILLS kills. Prints a line a run and exits with 1 if any differs.
"""

import csv
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

RANKS = (1, 2, 3)


def history(folder):
    """Lines without the number of candidate couples, which depends on when was searched."""
    with open(folder / "history.csv", newline="") as file:
        rows = list(csv.reader(file))
    column = rows[0].index("couples")
    return [row[:column] + row[column + 1:] for row in rows]


def result(folder):
    summary = json.loads((folder / "summary.json").read_text())
    frames = sorted(path.name for path in (folder / "frames").glob("*.vtkhdf"))
    return summary["status"], summary["state_hash"], summary["energy"], history(folder), frames


def ranks_below(pid):
    """Processes of the program that the launcher has started."""
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = entry.read_text().rsplit(") ", 1)
        except OSError:
            continue
        if int(fields[1].split()[1]) == pid:
            found.append(int(entry.parent.name))
    return found


class Killer:
    def __init__(self, breccia, mpiexec, case, folder, settings, seed):
        self.breccia, self.mpiexec, self.case, self.folder, self.settings = breccia, mpiexec, case, folder, settings
        self.random = random.Random(seed)
        self.turn = self.kills = self.idle = 0
        self.whole_s = 0.0

    def start(self, arguments):
        ranks = RANKS[self.turn % len(RANKS)]
        self.turn += 1
        launcher = [] if ranks == 1 else [self.mpiexec, "--oversubscribe", "-n", str(ranks)]
        return subprocess.Popen(launcher + [self.breccia, *arguments, "--progress", "none", *self.settings],
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True, text=True)

    def kill(self, process):
        below = ranks_below(process.pid)
        if below and self.random.random() < 0.5:
            os.kill(self.random.choice(below), signal.SIGKILL)  # the launcher ends the others
            try:
                process.wait(60)
            except subprocess.TimeoutExpired:
                sys.exit("ranks live on after one was killed")
        for pid in below + [process.pid]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        process.wait()
        self.kills += 1

    def run(self, name):
        """Until it is done; returns how often it was killed."""
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        begin = ["run", self.case, "-o", str(folder), "-f"]
        arguments, before = begin, self.kills
        while True:
            process = self.start(arguments)
            try:
                process.wait(self.random.uniform(0, 1.2 * self.whole_s))
            except subprocess.TimeoutExpired:
                self.kill(process)
                arguments = ["resume", str(folder)] if list((folder / "checkpoints").glob("*.h5")) else begin
                continue
            if process.returncode != 0:
                sys.exit(f"{' '.join(arguments)}: exit {process.returncode}\n{process.stderr.read()}")
            return self.kills - before


def main():
    breccia, mpiexec, case, folder, kills = sys.argv[1:6]
    seed = int(sys.argv[6]) if len(sys.argv) > 6 else 1
    settings = [word for setting in sys.argv[7:] + ["checkpoint.steps=40"] for word in ("--set", setting)]
    folder = pathlib.Path(folder)
    killer = Killer(breccia, mpiexec, case, folder, settings, seed)
    started = time.monotonic()
    shutil.rmtree(folder / "whole", ignore_errors=True)
    subprocess.run([breccia, "run", case, "-o", str(folder / "whole"), "--progress", "none", *settings], check=True)
    killer.whole_s = time.monotonic() - started
    expected = result(folder / "whole")
    wrong = 0
    number = 0
    while killer.kills < int(kills):
        killed = killer.run("killed")
        same = result(folder / "killed") == expected
        wrong += not same
        number += 1
        print(f"run {number}: {killed} kills, {'the same' if same else 'DIFFERENT'}", flush=True)
    print(f"{killer.kills} kills in {number} runs, {wrong} different")
    sys.exit(1 if wrong else 0)


main()
