"""The scripts that build the manual: links follow the pages, keys lead to the reference, the reference shows all that the schema says.

    python3 guide_test.py MANUAL_FOLDER
"""

import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, sys.argv.pop())
import build_guide  # noqa: E402
import reference    # noqa: E402

KEYS = [
    {"path": "title", "type": "text", "required": False, "help": "A line.", "allowed": "text", "unit": "1", "default": '""'},
    {"path": "joint[]", "type": "section_list", "required": False, "help": "Law of a | joint_law. More.", "allowed": "one or more tables, [[joint]]"},
    {"path": "joint[].penalty", "type": "number", "required": False, "help": "Stiffness, see `[x]`.", "allowed": "a number in Pa", "unit": "Pa",
     "level": "expert", "example": '"1 GPa"'},
    {"path": "joint[].law", "type": "choice", "required": True, "help": "Law.", "allowed": "one of a, b_c", "unit": "1", "choices": ["a", "b_c"],
     "start": "as in the run | that it starts from"},
]
PROGRAM = f"#!/bin/sh\ncat <<'TXT'\n{json.dumps({'keys': KEYS})}\nTXT\n"


class Links(unittest.TestCase):
    def rewritten(self, text, source="solver/manual/guide/a.md", page="guide/a.md"):
        pages = {"solver/manual/guide/a.md": "guide/a.md", "solver/manual/theory/t.md": "theory/t.md", "meshes/disc/README.md": "cases/disc.md",
                 "README.md": "more/readme.md"}
        with tempfile.TemporaryDirectory() as folder:
            self.folder = Path(folder)
            result = build_guide.Rewriter(source, page, pages, {"joint.penalty"}, self.folder).rewritten(text)
            self.copied = sorted(str(file.relative_to(folder)) for file in self.folder.rglob("*") if file.is_file())
        return result

    def test_links_follow_the_pages(self):
        for text, expected in (
                ("[a](../theory/t.md#b)", "[a](../theory/t.md#b)"),
                ("[a](../../../meshes/disc)", "[a](../cases/disc.md)"),
                ("[a](../../../meshes/disc/README.md#b)", "[a](../cases/disc.md#b)"),
                ("[a](../../../README.md)", "[a](../more/readme.md)"),
                ("[a](#b) [c](https://example.org)", "[a](#b) [c](https://example.org)"),
                ("[a](../../../solver/base)", "a"),                                    # a folder that is no page
                ("[a](gone.md)", "[a](gone.md)"),                                      # Sphinx reports it
                ("`[a](gone.md)`", "`[a](gone.md)`"),
                ("```\n[a](../../../meshes/disc)\n```", "```\n[a](../../../meshes/disc)\n```")):
            with self.subTest(text):
                self.assertEqual(self.rewritten(text), expected)

    def test_files_that_are_no_pages_are_copied(self):
        self.assertEqual(self.rewritten("![a](../../../meshes/glass_impact/picture.png) [b](../../../meshes/disc/case.toml)"),
                         "![a](../_files/meshes/glass_impact/picture.png) [b](../_files/meshes/disc/case.toml)")
        self.assertEqual(self.copied, ["_files/meshes/disc/case.toml", "_files/meshes/glass_impact/picture.png"])

    def test_a_picture_that_is_a_link_keeps_both(self):
        self.assertEqual(self.rewritten("[![a](../../../meshes/glass_impact/picture.png)](../../../meshes/disc)"),
                         "[![a](../_files/meshes/glass_impact/picture.png)](../cases/disc.md)")

    def test_names_of_keys_lead_to_the_reference(self):
        self.assertEqual(self.rewritten("Set `joint.penalty`, not `joint.other`."),
                         "Set [`joint.penalty`](../reference/joint.md#jointpenalty), not `joint.other`.")
        for text in ("# `joint.penalty`", "[`joint.penalty`](#a)", "    ```\n`joint.penalty`\n    ```", "`joint.penalty = 1`"):
            self.assertEqual(self.rewritten(text), text)


class Reference(unittest.TestCase):
    def pages(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder, "program")
            program.write_text(PROGRAM, encoding="utf-8")
            program.chmod(0o755)
            reference.write_pages(program, Path(folder, "pages"))
            return {file.name: file.read_text(encoding="utf-8") for file in Path(folder, "pages").iterdir()}

    def test_each_section_has_a_page_and_the_index_names_it(self):
        pages = self.pages()
        self.assertEqual(sorted(pages), ["index.md", "joint.md"])
        self.assertIn("[`joint`](joint.md)", pages["index.md"])
        self.assertIn("## `title`", pages["index.md"])

    def test_a_key_has_all_that_the_schema_says(self):
        page = self.pages()["joint.md"]
        for text in ("`[[joint]]`", "## `joint.law`", "| required | yes |", "| choices | `a`, `b_c` |", "| unit | Pa |", '`penalty = "1 GPa"`',
                     "Law of a \\| joint\\_law.", "see `[x]`", "as in the run \\\\| that"):
            self.assertIn(text, page)

    def test_expert_keys_come_last_in_a_section_of_their_own(self):
        page = self.pages()["joint.md"]
        self.assertLess(page.index("## `joint.law`"), page.index("## Expert keys"))
        self.assertLess(page.index("## Expert keys"), page.index("### `joint.penalty`"))


class Check(unittest.TestCase):
    def test_the_guide_lists_the_rules_of_check_by_level(self):
        rules = re.findall(r'Rule\{"(\w+)", *(\w+), *"[^"]*", *(\w+),', (build_guide.REPOSITORY / "solver/advice/rules.cpp").read_text(encoding="utf-8"))
        expected = {}
        for name, level, place in rules:
            expected.setdefault(level, []).append(f"`{name}`" + ("\\*" if place == "kRun" else ""))
        page = (build_guide.MANUAL / "guide/06-reading-check.md").read_text(encoding="utf-8")
        listed = {level: names.split(", ") for level, names in re.findall(r"^\| \*\*(\w+)\*\*:[^|]*\| (.*) \|$", page, re.MULTILINE)}
        self.assertEqual(listed, expected)


if __name__ == "__main__":
    unittest.main()
