"""The test of the READMEs is itself tested: in a small made-up repository a sound README passes, and every planted fault is found."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import readme_test
from commands import PROGRAM, Command, anchors_of, block_below, broken_links, commands_of, links_of, strip_comment, unmarked_commands
from plans import Problem, plan_of, substituted

# Stands for the program: what it is asked for is in its first words.
FAKE_PROGRAM = """#!/bin/bash
case "$*" in
  *--help) echo "  --ranks INT  --set TEXT" ;;
  *" failing.toml"*) exit 3 ;;
  *" silent.toml"*) ;;
  *" complaining.toml"*) echo "breccia: warning: unknown key" ;;
  run*) mkdir -p runs/a && echo '{"status": "complete"}' >runs/a/summary.json ;;
esac
"""
FAKE_RUN = """#!/bin/bash
cat <<TXT
usage: ./run COMMAND
  demo      draws
            --slowly
  test [-R] tests
  demo and test --preset NAME
TXT
"""
PICTURE = "![a picture](meshes/a/picture.png)\n"
SOUND = f"""# A project

{PICTURE}
```sh
./run demo --slowly          # draws
{PROGRAM} run \\
  meshes/a/case.toml         # continued
```

See [the case](meshes/a), `breccia check meshes/a/case.toml`, `breccia check
CASE --ranks N`, `breccia mesh`, `./run`, `breccia`, and `--set a=1`.

```
breccia is a word in here
```
"""


def plant(folder, readme):
    root = Path(folder)
    for name, content in (("run", FAKE_RUN), (PROGRAM, FAKE_PROGRAM), ("meshes/a/case.toml", ""), ("meshes/a/picture.png", ""),
                          ("README.md", readme)):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(content, encoding="utf-8")
        (root / name).chmod(0o755)


def messages(method, readme):
    """What a test of readme_test.py says about that README."""
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
        plant(folder, readme)
        readme_test.OfReadme.repository, readme_test.OfReadme.build = Path(folder), Path(folder, "build/release")
        result = unittest.TestResult()
        readme_test.OfReadme(method, "README.md").run(result)
        return [f"{case}\n{text}" for case, text in result.failures + result.errors]


def in_block(line):
    return f"```sh\n{line}\n```\n"


class Planted(unittest.TestCase):
    def test_a_sound_readme_passes(self):
        for method in ("test_commands_work", "test_commands_stand_in_blocks_marked_sh", "test_links_lead_to_files"):
            self.assertEqual(messages(method, SOUND), [])

    def test_each_planted_command_is_found(self):
        for readme, message in (
                (in_block(f"{PROGRAM} run meshes/a/case.toml failing.toml"), "ended with 3"),
                (in_block(f"{PROGRAM} run silent.toml -o runs/none"), "left no runs/none/summary.json"),
                ("`breccia check complaining.toml`", "printed 'breccia: warning: unknown key'"),
                ("`breccia burn case.toml`", "no sub-command 'burn'"),
                ("`breccia check --cores 2`", "does not tell of --cores"),
                (in_block("./run demo --fast"), "does not tell of --fast"),
                (in_block("./run test --slowly"), "does not tell of --slowly"),
                (in_block("./run dance"), "no rule"),
                (in_block("make"), "no rule"),
                ("`cmake --build build`", "no rule"),
                ("`mpiexec -n 2 ls`", "no rule"),
                (in_block("sudo apt-get install ./other.deb"), "no rule"),
                (in_block(f"{PROGRAM} check meshes/a/case.toml && echo"), "several commands"),
                ("`breccia run MY_CASE.toml`", "'MY_CASE' is no placeholder"),
                ("`breccia run ...`", "'...' is no placeholder"),
                ("`breccia check\n<case>`", "'<case>' is no placeholder"),
                (in_block("command_that_is_nowhere"), "no rule")):
            with self.subTest(readme=readme):
                found = messages("test_commands_work", readme)
                self.assertEqual(len(found), 1, found)
                self.assertIn(message, found[0])
                self.assertIn("README.md:", found[0])

    def test_a_missing_link_and_a_missing_picture_are_found(self):
        found = messages("test_links_lead_to_files", SOUND + "\n[gone](meshes/b)\n![gone](c.png) [kept](https://example.org/c) [below](#a)\n")
        self.assertEqual(len(found), 1)
        self.assertIn("no file meshes/b", found[0])
        self.assertIn("no file c.png", found[0])
        self.assertIn("no heading #a in README.md", found[0])
        self.assertNotIn("example", found[0].partition("First list contains")[2])

    def test_a_command_in_a_block_without_a_mark_is_found(self):
        self.assertEqual(unmarked_commands("```\n./run demo\n```\n```bash\nctest\n```\n"), [(2, "./run demo"), (5, "ctest")])


class Extraction(unittest.TestCase):
    def test_commands_are_found_with_their_lines(self):
        self.assertEqual([(command.line, command.text, command.inline) for command in commands_of(SOUND)], [
            (6, "./run demo --slowly", False), (7, f"{PROGRAM} run meshes/a/case.toml", False),
            (11, "breccia check meshes/a/case.toml", True), (11, "breccia check CASE --ranks N", True), (12, "breccia mesh", True),
            (12, "./run", True), (12, "breccia", True)])

    def test_comments_end_where_a_shell_ends_them(self):
        for text, command in (("a b # c", "a b"), ("# c", ""), ("a#b", "a#b"), ("a '# b' # c", "a '# b'"), ('a "\\" # b"', 'a "\\" # b"')):
            self.assertEqual(strip_comment(text), command)

    def test_placeholders_are_replaced_and_values_are_not(self):
        self.assertEqual(substituted("breccia check case.toml --ranks N"), "breccia check meshes/block_wall/case.toml --ranks 2")
        for text in ("breccia run meshes/a/case.toml --set a=\"30 N\"", "ctest -L unit -R x", "OMPI_X=1 breccia --help", "cmake -D A_B=ON"):
            self.assertEqual(substituted(text), text)
        with self.assertRaises(Problem):
            substituted("breccia run [OPTIONS]")

    def test_short_forms_only_append(self):
        for text in (f"mpiexec -n 2 {PROGRAM} run meshes/a/case.toml -o runs/b", "breccia race meshes/a/case.toml", "./run insitu",
                     "./run scaling", "ctest --preset release", "mpiexec --oversubscribe"):
            plan = plan_of(Command(text, 1))
            self.assertTrue(plan.text.startswith(text + " "), plan.text)

    def test_the_block_below_a_heading_is_taken(self):
        self.assertEqual(block_below("```toml\na\n```\n## H\n```sh\nb\n```\n```toml\nc\n```\n", "## H", "toml"), "c\n")
        self.assertIsNone(block_below("## H\n", "## I", "toml"))

    def test_links_in_code_do_not_count(self):
        self.assertEqual(links_of("`[a](b)` [c](d#e) [f](#g)\n[![h](i)](j)"), [(1, "d"), (2, "i"), (2, "j")])

    def test_headings_are_named_as_a_code_host_names_them(self):
        self.assertEqual(anchors_of("# A `b.c`, d_e\n## [F](g) h-i\n```\n# j\n```\n## K\n## K\n"), {"a-bc-d_e", "f-h-i", "k", "k-1"})

    def test_links_are_relative_to_the_readme(self):
        with tempfile.TemporaryDirectory() as folder:
            plant(folder, "[a](meshes/a)")
            self.assertEqual(broken_links(Path(folder, "README.md")), [])


if __name__ == "__main__":
    unittest.main()
