"""Tries every command of READMEs, and looks after their links and examples.

usage: readme_test.py REPOSITORY BUILD_FOLDER [--only-look-up] README...
A README is given below REPOSITORY and may hold a *. Its commands are typed in its order in one scratch folder. With --only-look-up they are
not typed, only their sub-commands and options looked up.
"""

import argparse
import json
import re
import sys
import time
import unittest
from pathlib import Path

from commands import block_below, blocks, broken_links, commands_of, unmarked_commands
from plans import RUN_GOING_ON, Plan, Problem, not_in_help, plan_of
from scratch import PYTHON, Scratch

COMPLAINT = re.compile(r"^(\S+: )?(error|warning: unknown)\b.*", re.IGNORECASE | re.MULTILINE)
# Page -> the heading above a case that stands there, and the file of that case.
EXAMPLES = {
    "README.md": ("## A first case", "meshes/notched_bar/case.toml"),
    "solver/manual/guide/01-first-run.md": ("## A complete case", "meshes/block_wall/case.toml"),
}
# What takes as long as all other commands of a page together, and is the same on each -> the page for which it is typed;
# for others it is looked up.
TYPED_FOR = {"./run insitu": "catalyst/README.md"}


def check_presets(scratch, plan):
    presets = json.loads((scratch.root / "CMakePresets.json").read_text(encoding="utf-8"))["configurePresets"]
    unknown = set(plan.options) - {preset["name"] for preset in presets}
    if unknown:
        raise Problem(f"no preset {', '.join(unknown)}")


def try_plan(scratch, plan):
    """Types what the plan says. Throws Problem unless all came about that it promises."""
    if plan.kind == "presets":
        check_presets(scratch, plan)
        return
    if plan.kind == "control" or (RUN_GOING_ON in plan.text and plan.kind == "typed"):
        scratch.start_run()
    code, printed = scratch.type(plan.text)
    scratch.end_run()
    if code != 0:
        raise Problem(f"ended with {code}\n{printed[-2000:]}")
    complaint = COMPLAINT.search(printed)
    if complaint:
        raise Problem(f"printed '{complaint.group()}'")
    if plan.kind == "look_up" and not_in_help(plan, printed):
        raise Problem(f"the help does not tell of {', '.join(not_in_help(plan, printed))}")
    if plan.kind == "ctest" and not re.search(r"Total Tests: [1-9]", printed):
        raise Problem("finds no test")
    if plan.kind == "live" and "paraview --script=" not in scratch.calls():
        raise Problem("did not start ParaView")
    if plan.run_folder:
        scratch.check_run(plan.run_folder)
    if plan.file:
        scratch.check_file(plan.file)


def tried(scratch, plan, command=""):
    """Tries it, unless this machine lacks what it needs, and prints which. Returns what is wrong, or None."""
    lacking = next(filter(None, map(scratch.lacks, plan.needs)), "")
    start = time.monotonic()
    try:
        if not lacking:
            try_plan(scratch, plan)
    except Problem as problem:
        return str(problem)
    if lacking:
        print(f"  skipped, as {lacking}: {plan.text}", flush=True)
    elif plan.kind in ("look_up", "presets"):
        print(f"  looked up  {command}", flush=True)
    else:
        print(f"  {time.monotonic() - start:7.1f} s  {plan.text}", flush=True)
    return None


class OfReadme(unittest.TestCase):
    """One README; load() chooses among the tests."""
    repository = build = None
    maxDiff = None

    def __init__(self, method, readme, only_look_up=False):
        super().__init__(method)
        self.readme, self.only_look_up = readme, only_look_up
        self.markdown = (self.repository / readme).read_text(encoding="utf-8")

    def __str__(self):
        return f"{self._testMethodName}: {self.readme}"

    def scratch(self):
        scratch = Scratch(self.repository, self.build)
        self.addCleanup(scratch.close)
        return scratch

    def test_commands_work(self):
        scratch = self.scratch()
        print(f"\n{self.readme}")
        for command in commands_of(self.markdown):
            with self.subTest(f"{self.readme}:{command.line}: {command.text}"):
                only_look_up = self.only_look_up or TYPED_FOR.get(command.text, self.readme) != self.readme
                try:
                    plan = plan_of(command, only_look_up)
                except Problem as problem:
                    wrong = str(problem)
                else:
                    wrong = tried(scratch, plan, command.text)
                if wrong:
                    self.fail(wrong)

    def test_commands_stand_in_blocks_marked_sh(self):
        self.assertEqual(unmarked_commands(self.markdown), [])

    def test_links_lead_to_files(self):
        self.assertEqual("\n".join(broken_links(self.repository / self.readme)), "")

    def test_the_example_is_the_case(self):
        heading, case = EXAMPLES[self.readme]
        self.assertEqual(block_below(self.markdown, heading, "toml"), (self.repository / case).read_text(encoding="utf-8"))

    def test_scripts_work(self):
        """Scripts of ParaView as pipelines of a run, others after the runs of the page, which they read."""
        scratch = self.scratch()
        for line, text in blocks(self.markdown, "python"):
            with self.subTest(f"{self.readme}:{line}"):
                compile(text, f"{self.readme}:{line}", "exec")
                (scratch.root / "script.py").write_text(text, encoding="utf-8")
                pipeline = Plan("breccia run meshes/glass_impact/case_smoke.toml --insitu script.py -f -o runs/script "
                                "--set time.max_steps=40", "typed", ("adaptor",), "runs/script")
                for plan in [pipeline] if "paraview" in text else [*self.runs(), Plan(f"{PYTHON} script.py", "typed", ("h5py",))]:
                    wrong = tried(scratch, plan)
                    if wrong:
                        self.fail(wrong)

    def runs(self):
        """Plans of the runs in the blocks of the page."""
        plans = [plan_of(command) for command in commands_of(self.markdown) if not command.inline]
        return [plan for plan in plans if plan.run_folder and not plan.needs]

    def test_scripts_of_the_shell_are_sound(self):
        scratch = self.scratch()
        for line, text in blocks(self.markdown, "bash"):
            with self.subTest(f"{self.readme}:{line}"):
                (scratch.root / "script.sh").write_text(text, encoding="utf-8")
                code, printed = scratch.type("bash -n script.sh")
                self.assertEqual((code, printed), (0, ""))


def load(readme, only_look_up):
    """The tests of a README."""
    methods = ["test_commands_work", "test_commands_stand_in_blocks_marked_sh", "test_links_lead_to_files"]
    markdown = (OfReadme.repository / readme).read_text(encoding="utf-8")
    if readme in EXAMPLES:
        methods.append("test_the_example_is_the_case")
    if blocks(markdown, "python") and not only_look_up:
        methods.append("test_scripts_work")
    if blocks(markdown, "bash"):
        methods.append("test_scripts_of_the_shell_are_sound")
    return [OfReadme(method, readme, only_look_up) for method in methods]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("repository", type=Path)
    parser.add_argument("build", type=Path)
    parser.add_argument("readmes", nargs="+")
    parser.add_argument("--only-look-up", action="store_true")
    arguments = parser.parse_args()
    OfReadme.repository, OfReadme.build = arguments.repository.resolve(), arguments.build.resolve()
    suite = unittest.TestSuite()
    for pattern in arguments.readmes:
        files = sorted(OfReadme.repository.glob(pattern))
        if not files:
            parser.error(f"no {pattern}")
        for file in files:
            suite.addTests(load(str(file.relative_to(OfReadme.repository)), arguments.only_look_up))
    sys.exit(not unittest.TextTestRunner(verbosity=0).run(suite).wasSuccessful())


if __name__ == "__main__":
    main()
