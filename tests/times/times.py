"""Tables of where the time of a build and of its tests goes.

usage: times.py build NINJA_LOG           what was compiled and linked, each as it was last built
       times.py tests JUNIT BUILD_FOLDER  what `ctest --output-junit` has written; the labels are those of BUILD_FOLDER
Prints a table. What cannot be read ends it with one line and 1.
"""

import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from collections import defaultdict
from pathlib import PurePosixPath

SLOWEST = 40  # rows of the last table
FAST = 1.0  # s: what a test with the label `fast` is to take at most, see tests/CMakeLists.txt
# A discovered name ends with the bytes of its parameter where that has no text; they differ from build to build.
BYTES_OF_A_PARAMETER = re.compile(r"  # GetParam\(\) = .*$")


class Unreadable(Exception):
    """What a table was to be made of cannot be read."""


def read_edges(path):
    """(seconds, output) of each edge in a log of ninja's: an edge with several outputs once, one that ran again as it ran last."""
    try:
        with open(path, encoding="utf-8") as file:
            lines = file.read().splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise Unreadable(f"{path}: {error}") from None
    if not lines or not lines[0].startswith("# ninja log v"):
        raise Unreadable(f"{path}: is no log of ninja's")
    last = {}
    for number, line in enumerate(lines[1:], 2):
        if line.startswith("#"):
            continue
        try:
            begin, end, _, output, command = line.split("\t")
            last[output] = (int(begin), int(end), command)
        except ValueError:
            raise Unreadable(f"{path}:{number}: is no line of ninja's log") from None
    edges = {}
    for output, edge in last.items():
        edges.setdefault(edge, output)
    return [((end - begin) / 1000, output) for (begin, end, _), output in edges.items()]


def folder_of(output):
    """Folder of the sources that an output of a build is made of, in two levels."""
    parts = PurePosixPath(output).parts
    if "CMakeFiles" in parts:
        return "/".join(parts[:parts.index("CMakeFiles")][:2]) or "."
    return "/".join(parts[:-1][:2]) or "."


def kind_of(output):
    return "compiled" if output.endswith(".o") else "linked and others"


def sums(rows):
    """rows: (group, seconds). [(group, seconds, number)], the slowest group first."""
    seconds, number = defaultdict(float), defaultdict(int)
    for group, time in rows:
        seconds[group] += time
        number[group] += 1
    return [(group, seconds[group], number[group]) for group in sorted(seconds, key=lambda group: (-seconds[group], group))]


def table(title, rows):
    lines = [title]
    lines += [f"{seconds:9.1f} s {number:6}  {group}" for group, seconds, number in rows]
    return "\n".join(lines)


def slowest(title, rows):
    rows = sorted(rows, key=lambda row: (-row[0], row[1]))[:SLOWEST]
    return "\n".join([title, *(f"{seconds:9.1f} s  {name}" for seconds, name in rows)])


def build_report(log):
    edges = read_edges(log)
    whole = sum(seconds for seconds, _ in edges)
    return "\n\n".join([
        f"{len(edges)} edges, {whole:.1f} s in sum (edges run side by side)",
        table("By kind", sums((kind_of(output), seconds) for seconds, output in edges)),
        table("By folder", sums((folder_of(output), seconds) for seconds, output in edges)),
        slowest("Slowest", edges)])


def read_tests(path):
    """(seconds, name, status) of each test that ran."""
    try:
        root = ET.parse(path).getroot()
        found = [(float(case.get("time")), case.get("name"), case.get("status")) for case in root.iter("testcase")]
    except (OSError, ET.ParseError) as error:
        raise Unreadable(f"{path}: {error}") from None
    except TypeError:
        raise Unreadable(f"{path}: has a test without a time") from None
    if not found:
        raise Unreadable(f"{path}: has no tests")
    return float(root.get("time") or 0), found


def read_labels(build):
    """{name of a test: its labels}, as ctest lists them for a build folder."""
    listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True, check=False)
    try:
        tests = json.loads(listed.stdout)["tests"]
    except (json.JSONDecodeError, KeyError):
        raise Unreadable(f"{build}: ctest lists no tests there: {listed.stderr.strip()}") from None
    return {BYTES_OF_A_PARAMETER.sub("", test["name"]):
            next((p["value"] for p in test.get("properties", []) if p["name"] == "LABELS"), []) for test in tests}


def suite_of(name):
    return name.split(".")[0] if "." in name else name


def tests_report(junit, build):
    wall, tests = read_tests(junit)
    labels = read_labels(build)
    tests = [(seconds, BYTES_OF_A_PARAMETER.sub("", name), status) for seconds, name, status in tests]
    of = {name: labels.get(name) or ["without a label"] for _, name, _ in tests}
    failed = [name for _, name, status in tests if status == "fail"]
    not_run = sum(status not in ("run", "fail") for _, _, status in tests)
    slow = [(seconds, name) for seconds, name, _ in tests if "fast" in of[name] and seconds > FAST]
    parts = [
        f"{len(tests)} tests, {sum(row[0] for row in tests):.1f} s in sum, {wall:.0f} s on the clock; "
        f"{len(failed)} failed, {not_run} were not run",
        table("By label (a test with two counts twice)",
              sums((label, seconds) for seconds, name, _ in tests for label in of[name])),
        table("By suite", sums((suite_of(name), seconds) for seconds, name, _ in tests)[:SLOWEST]),
        slowest("Slowest", [row[:2] for row in tests])]
    if slow:
        parts.append(slowest(f"With the label fast, but more than {FAST:g} s", slow))
    if failed:
        parts.append("\n".join(["Failed", *failed]))
    return "\n\n".join(parts)


def main(arguments):
    reports = {"build": (build_report, 1), "tests": (tests_report, 2)}
    if not arguments or arguments[0] not in reports or len(arguments) != 1 + reports[arguments[0]][1]:
        print("usage: times.py build NINJA_LOG | times.py tests JUNIT BUILD_FOLDER", file=sys.stderr)
        return 1
    try:
        print(reports[arguments[0]][0](*arguments[1:]))
    except Unreadable as problem:
        print(f"times.py: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
