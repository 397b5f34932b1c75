"""Makes small mistakes in the sources on purpose, one at a time, and tells which of them the tests notice.

usage: mutation.py SCRATCH [ID or folder, ...] [--again] [--jobs N]   builds and tests in SCRATCH
       mutation.py --check                                             only: does every row still fit the sources?

A row of table/*.toml has
  id       a name
  file     the source, from the top of the repository
  find     text that stands exactly once in it
  replace  what is written instead
  breaks   a sentence: what is wrong then
  tests    programs of tests/ that ought to notice, the quickest first: "test_case", "mpi_parallel", or some of a
           program's tests, "test_program:Budget.*" (a pattern of GoogleTest)

SCRATCH/source is a copy of the sources, SCRATCH/build is where they are compiled; the repository itself is only read.
A mutation is noticed when one of its programs fails or does not end, though all pass without it. The first failure is
enough. Results are kept in SCRATCH/results.json: what has been noticed is not run again while row and source are the
same, so a run that was interrupted goes on where it ended, and one after a new test tries what is left. Prints a table
and exits with 1 when less than 95 % are noticed, or a row does not fit or does not compile.
"""

import argparse
import fcntl
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import time
import tomllib
from collections import Counter
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
TABLE = Path(__file__).with_name("table")
FIELDS = {"id", "file", "find", "replace", "breaks", "tests"}
ENOUGH = 0.95
LONGEST = 300  # s, of a program: a mutation may make an endless loop
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

NOTICED, MISSED, BROKEN = "noticed", "NOT NOTICED", "does not compile"


def read_table():
    files = sorted(TABLE.glob("*.toml"))
    return [row for file in files for row in tomllib.loads(file.read_text(encoding="utf-8"))["mutation"]]


def test_programs(repository):
    """Names of the programs that the lists of tests/ build."""
    calls = {"breccia_test": "test_", "breccia_mpi_test": "mpi_", "breccia_catalyst_test": "catalyst_",
             "breccia_catalyst_unit_test": "test_catalyst_", "add_executable": ""}
    programs = set()
    for file in (repository / "tests").rglob("CMakeLists.txt"):
        for call, name in re.findall(r"^\s*(\w+)\((?:NAME )?(\w+)", file.read_text(encoding="utf-8"), re.MULTILINE):
            if call in calls:
                programs.add(calls[call] + name)
    return programs


def problems(rows, repository=REPOSITORY):
    """What keeps rows from being applied, a line each."""
    found = []
    programs = test_programs(repository)
    for row in rows:
        name = row.get("id", "a row without an id")
        if set(row) != FIELDS:
            found.append(f"{name}: has {', '.join(sorted(row))}; needs {', '.join(sorted(FIELDS))}")
            continue
        source = repository / row["file"]
        if not source.is_file():
            found.append(f"{name}: there is no {row['file']}")
            continue
        times = source.read_text(encoding="utf-8").count(row["find"])
        if times != 1:
            found.append(f"{name}: the text stands {times} times in {row['file']}, must be once: {row['find']!r}")
        if row["find"] == row["replace"]:
            found.append(f"{name}: changes nothing")
        if not row["tests"]:
            found.append(f"{name}: names no tests")
        unknown = [test for test in row["tests"] if test.split(":")[0] not in programs]
        if unknown:
            found.append(f"{name}: there is no test program {', '.join(unknown)}")
    ids = Counter(row.get("id") for row in rows)
    found += [f"{name}: stands {number} times in the table" for name, number in ids.items() if number > 1]
    return found


def folder_of(row):
    """solver/mesh/joints.cpp is of mesh, catalyst/ranks.cpp of catalyst."""
    parts = row["file"].split("/")
    return parts[1] if parts[0] == "solver" else parts[0]


def chosen(rows, names):
    unknown = [n for n in names if not any(n in (row["id"], folder_of(row)) for row in rows)]
    if unknown:
        sys.exit(f"no mutation and no folder with mutations: {', '.join(unknown)}")
    # By file: a mutation after another one of the same source costs one compilation, not two.
    wanted = [row for row in rows if not names or row["id"] in names or folder_of(row) in names]
    return sorted(wanted, key=lambda row: row["file"])


def copy_sources(target):
    """Makes target the working tree as it is; files that are the same keep their times, so that little is compiled."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=REPOSITORY, check=True,
                            capture_output=True, text=True).stdout.split("\0")
    files = {name for name in listed if name and (REPOSITORY / name).is_file()}
    copied = target / ".copied"
    before = set(copied.read_text(encoding="utf-8").split("\n")) if copied.is_file() else set()
    for name in files:
        source, copy = REPOSITORY / name, target / name
        if copy.is_file() and copy.read_bytes() == source.read_bytes():
            continue
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, copy)  # with the time of now
    for name in before - files - {""}:
        (target / name).unlink(missing_ok=True)
    copied.write_text("\n".join(sorted(files)), encoding="utf-8")


class Scratch:
    """A copy of the sources and its build."""

    def __init__(self, folder, jobs):
        self.source, self.build, self.jobs = folder / "source", folder / "build", jobs
        self.source.mkdir(parents=True, exist_ok=True)
        self.lock = (folder / "lock").open("w", encoding="utf-8")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            sys.exit(f"somebody else works in {folder}")
        copy_sources(self.source)
        if not (self.build / "CMakeCache.txt").is_file():
            subprocess.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"],
                           check=True, stdout=subprocess.DEVNULL)
        self.known = {}  # commands by test
        self.passing = set()

    def make(self, programs):
        """Compiles; returns what the compiler says when it fails, else None."""
        command = ["cmake", "--build", self.build, "-j", str(self.jobs), "--target", *programs]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace")
        return None if done.returncode == 0 else done.stdout[-3000:] + done.stderr[-1000:]

    def commands(self, test):
        """Command lines and settings of "program" or "program:pattern", as ctest would run them."""
        program, _, pattern = test.partition(":")
        asked = subprocess.run(["ctest", "--show-only=json-v1"], cwd=self.build, check=True, capture_output=True)
        found = []
        for entry in json.loads(asked.stdout)["tests"]:
            command = entry.get("command", [])
            place = next((i for i, word in enumerate(command) if Path(word).name == program), None)
            if place is None:
                continue
            properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
            if any("--gtest_filter" in word for word in command[place:]) and place == 0:
                command = command[:1]  # one of many tests of the program: all of them in one go
            if pattern:
                command = [*command, f"--gtest_filter={pattern}"]
            settings = dict(word.split("=", 1) for word in properties.get("ENVIRONMENT", []))
            run = (command, properties.get("WORKING_DIRECTORY", str(self.build)), settings)
            if run not in found:
                found.append(run)
        if not found:
            sys.exit(f"ctest knows no test of {program}")
        if pattern:
            executable = next(word for word in found[0][0] if Path(word).name == program)
            listed = subprocess.run([executable, "--gtest_list_tests", f"--gtest_filter={pattern}"], check=True,
                                    capture_output=True, text=True, env=os.environ | ENVIRONMENT).stdout
            if not any(line.startswith("  ") for line in listed.splitlines()):
                sys.exit(f"{program} has no test {pattern}")
        return found

    def fails(self, test):
        """Whether a test program fails, or does not end."""
        if test not in self.known:
            self.known[test] = self.commands(test)
        for command, folder, settings in self.known[test]:
            if "mpiexec" not in Path(command[0]).name:
                command = [*command, "--gtest_fail_fast"]
            environment = os.environ | ENVIRONMENT | settings
            process = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL, start_new_session=True)
            try:
                if process.wait(LONGEST) != 0:
                    return True
            except subprocess.TimeoutExpired:
                return True
            finally:
                if process.poll() is None:
                    os.killpg(process.pid, 9)
                    process.wait()
        return False

    def demand_passing(self, tests):
        """Without a mutation the programs are built and pass."""
        fresh = [test for test in tests if test not in self.passing]
        if not fresh:
            return
        if said := self.make(sorted({test.partition(":")[0] for test in fresh})):
            sys.exit(f"{', '.join(fresh)} cannot be built without a mutation:\n{said}")
        for test in fresh:
            if self.fails(test):
                sys.exit(f"{test} fails without a mutation")
            self.passing.add(test)

    def outputs(self):
        """What has been made, with its time: objects, libraries, programs."""
        found = {}
        for folder, _, names in os.walk(self.build):
            if Path(folder).name == "Testing":
                continue
            for name in names:
                path = os.path.join(folder, name)
                if name.endswith((".o", ".a", ".so")) or ("." not in name and os.access(path, os.X_OK)):
                    found[path] = os.stat(path).st_mtime_ns
        return found

    def try_one(self, row):
        """Result of a mutation and the program that noticed it, "" for none; afterwards all is as before."""
        self.demand_passing(row["tests"])
        path = self.source / row["file"]
        text, times, before = path.read_text(encoding="utf-8"), path.stat(), self.outputs()
        path.write_text(text.replace(row["find"], row["replace"]), encoding="utf-8")
        try:
            for test in row["tests"]:
                if said := self.make([test.partition(":")[0]]):
                    # CMake runs the program to list its tests: one that crashes before the first is noticed.
                    return (NOTICED, test) if "Error running test executable" in said else (BROKEN, said)
                if self.fails(test):
                    return NOTICED, test
            return MISSED, ""
        finally:
            # With its old time again nothing but what the mutation has changed is compiled anew.
            path.write_text(text, encoding="utf-8")
            for made, time_made in self.outputs().items():
                if before.get(made) != time_made:
                    os.unlink(made)
            os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))


def fingerprint(row):
    source = (REPOSITORY / row["file"]).read_bytes()
    return hashlib.sha256(json.dumps(row, sort_keys=True).encode() + source).hexdigest()[:16]


def run(rows, scratch, kept, again):
    """Tries rows; returns {id: result}. kept: the file of results."""
    results = json.loads(kept.read_text(encoding="utf-8")) if kept.is_file() else {}
    for number, row in enumerate(rows, 1):
        known = results.get(row["id"], {})
        if not again and known.get("result") == NOTICED and known.get("fingerprint") == fingerprint(row):
            continue
        start = time.monotonic()
        result, by = scratch.try_one(row)
        results[row["id"]] = {"result": result, "by": by, "seconds": round(time.monotonic() - start, 1),
                              "fingerprint": fingerprint(row)}
        kept.write_text(json.dumps(results, indent=1), encoding="utf-8")
        print(f"{number:4}/{len(rows)}  {result:<16} {row['id']:<44} {by.splitlines()[0] if by else '':<24} "
              f"{results[row['id']]['seconds']:6.1f} s", flush=True)
    return results


def report(rows, results):
    """Prints what was found; returns the exit code."""
    print(f"\n{'folder':<12} {'mutations':>9} {'noticed':>9}")
    for folder in sorted({folder_of(row) for row in rows}):
        here = [results[row["id"]]["result"] for row in rows if folder_of(row) == folder]
        print(f"{folder:<12} {len(here):>9} {here.count(NOTICED):>9}")
    wrong = [row for row in rows if results[row["id"]]["result"] == BROKEN]
    missed = [row for row in rows if results[row["id"]]["result"] == MISSED]
    for row in missed:
        print(f"not noticed: {row['id']} ({row['file']}): {row['breaks']}")
    for row in wrong:
        print(f"does not compile: {row['id']} ({row['file']})\n{results[row['id']]['by']}")
    share = 1 - (len(missed) + len(wrong)) / len(rows)
    print(f"{len(rows)} mutations, {100 * share:.1f} % noticed")
    return 0 if share >= ENOUGH and not wrong else 1


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n\n")[0])
    parser.add_argument("scratch", nargs="?", type=Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    asked = parser.parse_intermixed_args()  # options may stand between names
    rows = read_table()
    if found := problems(rows):
        sys.exit("\n".join(found))
    if asked.check:
        print(f"{len(rows)} mutations fit the sources")
        return 0
    if asked.scratch is None:
        parser.error("names no scratch folder")
    scratch_folder = asked.scratch.resolve()
    if scratch_folder == REPOSITORY or scratch_folder in REPOSITORY.parents:
        parser.error("the scratch folder must not hold the repository")
    rows = chosen(rows, asked.names)
    results = run(rows, Scratch(scratch_folder, asked.jobs), scratch_folder / "results.json", asked.again)
    return report(rows, results)


if __name__ == "__main__":
    sys.exit(main())
