"""The manual page and the completion say what the program says.

    python3 manual_test.py PROGRAM MANUAL_FOLDER SOURCE_FOLDER
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from functools import lru_cache
from pathlib import Path

# Options of other programs that the page names: mpiexec's.
FOREIGN = {"-n", "--oversubscribe"}

OPTION = re.compile(r"(?<![\w-])--?[A-Za-z][\w-]*")
PAGE_NAME, COMPLETION_NAME = "breccia.1.in", "breccia.bash"


@lru_cache(maxsize=None)
def help_of(*command):
    return subprocess.run([PROGRAM, *command, "--help"], capture_output=True, text=True, check=True, stdin=subprocess.DEVNULL).stdout


def commands():
    """Every command that does something, as its words: ("run",), ("insitu", "replay"), ..."""

    def below(command):
        found = re.search(r"^subcommands:\n((?: .*\n)+)", help_of(*command), re.MULTILINE | re.IGNORECASE)
        if not found:
            return [command]
        return [leaf for name in re.findall(r"^  ([a-z]+)", found[1], re.MULTILINE) for leaf in below((*command, name))]

    return below(())


def options_of(*command):
    """Options in the help of a command: those that stand first in their line, whatever the descriptions mention."""
    lines = re.findall(r"^ {1,12}(-[^ ]+(?:, *-[^ ]+)?)", help_of(*command), re.MULTILINE)
    return {option for line in lines for option in re.split(", *", line)}


def choices_of(*command):
    """Words that the help lists as the allowed values of an option."""
    return {word for found in re.findall(r"\{([^}]*)\}", help_of(*command)) for word in found.split(",")}


def page():
    """The page's lines as plain text, with the macro that begins a line left in front."""
    text = (MANUAL / PAGE_NAME).read_text(encoding="utf-8").replace(r"\-", "-")
    lines = [line for line in text.splitlines() if not line.startswith('.\\"')]
    return [re.sub(r'\\f[BIRP]|"', "", line) for line in lines]


def section(heading, macro):
    """Lines below a heading, to the next one of its rank or above; [] if there is none."""
    found, inside = [], False
    for line in page():
        if re.match(r"\.S[HS] ", line):
            inside = bool(re.match(rf"\.{macro} {heading}\b", line)) or (inside and line.startswith(".SS") and macro == "SH")
        elif inside:
            found.append(line)
    return found


def section_of(command):
    return section(" ".join(command), "SS")


def tags(lines):
    """The tags of the tagged paragraphs."""
    return [tag for before, tag in zip(lines, lines[1:]) if before == ".TP"]


def option_tags(lines):
    return {option for tag in tags(lines) for option in OPTION.findall(tag.replace(" , ", " "))}


def variables_read():
    """Names of BRECCIA_ variables that the code asks the environment for."""
    asks = re.compile(r"""(?:getenv\(|environ\.get\(|environ\[|\benvironment\()\s*["'](BRECCIA_\w+)""")
    files = [file for folder in ("solver", "catalyst") for ending in ("cpp", "hpp", "h", "py") for file in (SOURCE / folder).rglob(f"*.{ending}")]
    return {name for file in files for name in asks.findall(file.read_text(encoding="utf-8"))}


class Page(unittest.TestCase):
    def test_each_command_has_a_section_with_exactly_the_options_of_its_help(self):
        self.assertGreater(len(commands()), 5)
        for command in commands():
            with self.subTest(command=" ".join(command)):
                self.assertTrue(section_of(command), "no section")
                self.assertEqual(option_tags(section_of(command)), options_of(*command) - {"-h", "--help"})

    def test_each_value_that_the_help_lists_stands_in_the_section_of_its_command(self):
        self.assertTrue(choices_of("run"))
        for command in commands():
            words = set(re.findall(r"\w+", " ".join(section_of(command))))
            with self.subTest(command=" ".join(command)):
                self.assertEqual(choices_of(*command) - words, set())

    def test_each_command_of_control_stands_in_its_section_and_no_other_does(self):
        listed = re.search(r"^Commands:\n((?:  .*\n)+)", help_of("control"), re.MULTILINE)[1]
        asked = {name for line in listed.splitlines() for name in re.findall(r"\b[a-z_]+\b", re.split("  +", line.strip())[0])}
        described = {name for tag in tags(section_of(("control",))) if "--" not in tag for name in re.findall(r"\b[a-z_]+\b", tag)}
        self.assertEqual(described, asked)

    def test_the_options_of_the_program_itself_are_the_common_ones(self):
        self.assertEqual(option_tags(section("COMMON OPTIONS", "SH")), options_of())

    def test_each_section_below_commands_is_a_command(self):
        headings = [line.split() for line in page() if line.startswith(".SS ")]
        named = {tuple(word for word in heading[1:] if word.islower()) for heading in headings}
        self.assertEqual(named, set(commands()))

    def test_no_option_is_named_that_neither_breccia_nor_mpiexec_knows(self):
        known = FOREIGN.union(options_of(), *(options_of(*command) for command in commands()))
        self.assertEqual(set(OPTION.findall("\n".join(page()))) - known, set())

    def test_each_command_stands_in_the_synopsis(self):
        synopsis = " ".join(section("SYNOPSIS", "SH"))
        for command in commands():
            self.assertIn("breccia " + " ".join(command), synopsis)

    def test_the_environment_is_that_of_the_code(self):
        described = {tag for tag in " ".join(tags(section("ENVIRONMENT", "SH"))).split() if tag.startswith("BRECCIA_")}
        self.assertTrue(described)
        self.assertEqual(described, variables_read())

    def test_exit_codes_are_those_of_the_help(self):
        listed = re.search(r"Exit codes: (.*)", help_of())[1]
        described = {tag.split()[-1] for tag in tags(section("EXIT STATUS", "SH"))}
        self.assertEqual(described, set(re.findall(r"\b\d\b", listed)))

    def test_groff_has_nothing_to_warn_of(self):
        if shutil.which("groff") is None:
            self.skipTest("groff is not installed")
        text = (MANUAL / PAGE_NAME).read_text(encoding="utf-8").replace("@PROJECT_VERSION@", "1.2.3")
        self.assertNotIn("@", text)
        result = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-Z"], input=text, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))


class Completion(unittest.TestCase):
    """What bash would offer in a folder with two cases and a run, with a program called breccia first on PATH."""

    @classmethod
    def setUpClass(cls):
        if shutil.which("bash") is None:
            raise unittest.SkipTest("bash is not installed")
        cls.scratch = tempfile.TemporaryDirectory()
        root = Path(cls.scratch.name)
        (root / "bin").mkdir()
        # Counts its calls, to see that a completion makes no more than one.
        program = root / "bin" / "breccia"
        program.write_text(f'#!/bin/sh\necho "$*" >>"{root}/calls"\nexec "{PROGRAM}" "$@"\n', encoding="utf-8")
        program.chmod(0o755)
        cls.work = root / "work"
        for folder in ("cases/my plate", "runs/plate", "runs/empty"):
            (cls.work / folder).mkdir(parents=True)
        for file in ("cases/a.toml", "cases/b.toml", "cases/notes.txt", "runs/plate/status.jsonl", "view.py"):
            (cls.work / file).touch()

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def offered(self, *words):
        """Candidates for the last word; `words` as bash cuts them, at "=" too."""
        script = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _breccia; '
                  '((${#COMPREPLY[@]} == 0)) || printf "%s\\n" "${COMPREPLY[@]}"')
        root = Path(self.scratch.name)
        (root / "calls").write_text("")
        environment = dict(os.environ, PATH=f"{root / 'bin'}:{os.environ['PATH']}", HOME=str(root))
        result = subprocess.run(["bash", "--norc", "-c", script, "bash", str(MANUAL / COMPLETION_NAME), *words], cwd=self.work,
                                env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertLessEqual((root / "calls").read_text().count("\n"), 1, "the program is called more than once")
        return result.stdout.splitlines()

    def test_commands_are_those_of_the_help(self):
        self.assertEqual(set(self.offered("breccia", "")), {command[0] for command in commands()})
        self.assertEqual(set(self.offered("breccia", "insitu", "")), {command[1] for command in commands() if command[0] == "insitu"})

    def test_a_begun_command_is_completed(self):
        self.assertEqual(self.offered("breccia", "expl"), ["explain"])
        self.assertEqual(self.offered("breccia", "insitu", "re"), ["replay"])

    def test_nothing_is_offered_after_a_command_that_does_not_exist(self):
        self.assertEqual(self.offered("breccia", "walk", ""), [])

    def test_options_of_each_command_are_those_of_its_help(self):
        for command in commands():
            with self.subTest(command=" ".join(command)):
                self.assertEqual(set(self.offered("breccia", *command, "-")), options_of(*command))
                self.assertEqual(self.offered("breccia", *command, "--he"), ["--help"])

    def test_values_of_progress_are_offered_after_a_space_and_after_an_equals_sign(self):
        values = {"auto", "bar", "log", "json", "none"}
        self.assertEqual(set(self.offered("breccia", "run", "--progress", "")), values)
        self.assertEqual(set(self.offered("breccia", "run", "--progress", "=")), values)
        self.assertEqual(self.offered("breccia", "race", "--progress", "=", "j"), ["json"])

    def test_algorithms_are_a_list_in_which_none_stands_twice(self):
        self.assertIn("ms", self.offered("breccia", "race", "--algorithms", ""))
        self.assertEqual(self.offered("breccia", "race", "--algorithms", "packed_tree,m"), ["packed_tree,ms", "packed_tree,ms_slices"])
        self.assertEqual(self.offered("breccia", "race", "--algorithms", "ms,ms_"), ["ms,ms_slices"])
        self.assertEqual(self.offered("breccia", "race", "--algorithms", "ms_slices,ms_"), [])
        self.assertEqual(self.offered("breccia", "race", "--algorithms", "ms_slices,m"), ["ms_slices,ms"])

    def test_pipelines_are_names_and_scripts(self):
        self.assertEqual(set(self.offered("breccia", "run", "--insitu", "fractures,s")), {"fractures,surface", "fractures,stress"})
        self.assertEqual(self.offered("breccia", "run", "--insitu", "v"), ["volume", "view.py"])
        self.assertEqual(self.offered("breccia", "insitu", "replay", "-o", "out", "runs/plate", "str"), ["stress"])

    def test_keys_to_set_end_with_an_equals_sign(self):
        self.assertEqual(self.offered("breccia", "run", "--set", "time.sa"), ["time.safety="])
        self.assertEqual(self.offered("breccia", "check", "--set", "=", "time.sa"), ["time.safety="])

    def test_keys_to_set_in_a_list_name_an_entry(self):
        self.assertEqual(self.offered("breccia", "run", "--set", "material.glass.yo"), ["material.glass.young="])
        self.assertEqual(self.offered("breccia", "run", "--set", "material[2].yo"), ["material[2].young="])
        self.assertIn("material[0].young=", self.offered("breccia", "run", "--set", "mat"))
        self.assertIn("stage.impact.constraint[0].fixed=", self.offered("breccia", "run", "--set", "stage.impact.con"))

    def test_values_to_set_are_the_choices_of_the_key(self):
        self.assertEqual(self.offered("breccia", "run", "--set", "detection.algorithm", "=", "so"), ["sorted_grid"])
        self.assertEqual(self.offered("breccia", "run", "--set", "output.joints", "=", "f"), ["false"])
        self.assertEqual(self.offered("breccia", "run", "--set", "time.safety", "="), [])

    def test_keys_to_explain_are_sections_and_keys(self):
        self.assertEqual(self.offered("breccia", "explain", "joint.pen"), ["joint.penalty_factor", "joint.penalty"])
        keys = self.offered("breccia", "explain", "")
        for key in ("title", "mesh", "mesh.raster.slit.lower", "stage.constraint", "stage.constraint.fixed", "function.ramp.to"):
            self.assertIn(key, keys)

    def test_each_key_that_is_offered_can_be_explained(self):
        for key in self.offered("breccia", "explain", "")[::6]:
            with self.subTest(key=key):
                subprocess.run([PROGRAM, "explain", key], capture_output=True, check=True)

    def test_cases_are_toml_files_and_folders_on_the_way(self):
        self.assertEqual(set(self.offered("breccia", "run", "")), {"cases", "runs"})
        for before in (("run",), ("run", "-f"), ("run", "-o", "x"), ("check", "--set", "time.safety", "=", "0.5"), ("mesh",), ("race",), ("live",)):
            with self.subTest(before=before):
                self.assertEqual(set(self.offered("breccia", *before, "cases/")), {"cases/a.toml", "cases/b.toml", "cases/my plate"})
        self.assertEqual(self.offered("breccia", "run", "cases/a.toml", "cases/"), [])

    def test_the_output_is_a_folder(self):
        self.assertEqual(set(self.offered("breccia", "run", "cases/a.toml", "-o", "")), {"cases", "runs"})
        self.assertEqual(self.offered("breccia", "mesh", "--output", "=", "cas"), ["cases"])

    def test_control_is_given_a_run_and_a_command(self):
        self.assertEqual(self.offered("breccia", "control", ""), ["runs/plate"])
        self.assertEqual(self.offered("breccia", "control", "runs/p"), ["runs/plate"])
        self.assertEqual(set(self.offered("breccia", "control", "runs/plate", "")), {"pause", "resume", "stop", "extract", "frame", "frame_interval", "checkpoint"})
        self.assertEqual(self.offered("breccia", "control", "--patience", "5", "runs/plate", "st"), ["stop"])

    def test_the_program_may_be_given_by_its_path(self):
        self.assertEqual(self.offered("../bin/breccia", "expl"), ["explain"])
        self.assertEqual(self.offered(str(Path(self.scratch.name) / "bin" / "breccia"), "expl"), ["explain"])
        self.assertEqual(self.offered("~/bin/breccia", "expl"), ["explain"])

    def test_nothing_is_offered_and_nothing_said_where_there_is_no_program(self):
        self.assertEqual(self.offered("/nowhere/breccia", ""), [])


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    PROGRAM, MANUAL, SOURCE = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
