"""What times.py reports of logs that are written here."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).with_name("times.py")
LOG = "\n".join(["# ninja log v5",
                 "0\t9000\t1\tsolver/base/CMakeFiles/breccia_base.dir/old.cpp.o\taa",
                 "100\t2100\t1\tsolver/base/CMakeFiles/breccia_base.dir/old.cpp.o\taa",  # ran again: counts as it ran last
                 "0\t1500\t1\ttests/unit/base/CMakeFiles/test_base.dir/a.cpp.o\tbb",
                 "1500\t2000\t1\ttests/unit/base/test_base\tcc",
                 "1500\t2000\t1\ttests/unit/base/test_base[1]_tests.cmake\tcc"]) + "\n"  # of the same edge
JUNIT = """<testsuite tests="4" time="7"><testcase name="One.is" time="0.5" status="run"/>
<testcase name="One.was" time="2.5" status="fail"/><testcase name="alone" time="1.25" status="notrun"/>
<testcase name="Any/Of.x/0  # GetParam() = 4-byte object &lt;01-00 00-00&gt;" time="1" status="run"/></testsuite>"""
# The names of tests with parameters differ between the build that is asked and the one that ran.
TESTFILE = """add_test(One.is true)
set_tests_properties(One.is PROPERTIES LABELS "unit;fast")
add_test(One.was true)
set_tests_properties(One.was PROPERTIES LABELS "unit;fast")
add_test(alone true)
add_test([=[Any/Of.x/0  # GetParam() = 4-byte object <02-00 00-00>]=] true)
set_tests_properties([=[Any/Of.x/0  # GetParam() = 4-byte object <02-00 00-00>]=] PROPERTIES LABELS mpi)
"""


class Times(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return str(self.folder / name)

    def call(self, *arguments):
        return subprocess.run([sys.executable, SCRIPT, *arguments], capture_output=True, text=True, check=False)

    def lines(self, *arguments):
        ended = self.call(*arguments)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        return [" ".join(line.split()) for line in ended.stdout.splitlines()]

    def refused(self, *arguments):
        ended = self.call(*arguments)
        self.assertEqual((ended.returncode, ended.stdout, ended.stderr.count("\n")), (1, "", 1), ended.stderr)
        return ended.stderr

    def test_a_build_is_ended_by_kind_by_folder_and_by_edge(self):
        lines = self.lines("build", self.write("log", LOG))
        self.assertEqual(lines[0], "3 edges, 4.0 s in sum (edges run side by side)")
        for line in ("3.5 s 2 compiled", "0.5 s 1 linked and others", "2.0 s 1 solver/base", "2.0 s 2 tests/unit"):
            self.assertIn(line, lines)
        edges = lines[lines.index("Slowest") + 1:]
        self.assertEqual(edges[0], "2.0 s solver/base/CMakeFiles/breccia_base.dir/old.cpp.o")
        self.assertEqual(len(edges), 3)

    def test_tests_are_ended_by_label_by_suite_and_one_by_one(self):
        self.write("CTestTestfile.cmake", TESTFILE)
        lines = self.lines("tests", self.write("junit.xml", JUNIT), str(self.folder))
        self.assertEqual(lines[0], "4 tests, 5.2 s in sum, 7 s on the clock; 1 failed, 1 were not run")
        for line in ("3.0 s 2 unit", "3.0 s 2 fast", "1.0 s 1 mpi", "1.2 s 1 without a label", "3.0 s 2 One", "1.0 s 1 Any/Of"):
            self.assertIn(line, lines)
        self.assertEqual(lines[lines.index("Slowest") + 1], "2.5 s One.was")
        self.assertEqual(lines[lines.index("With the label fast, but more than 1 s") + 1], "2.5 s One.was")
        self.assertEqual(lines[lines.index("Failed") + 1], "One.was")

    def test_what_cannot_be_read_is_one_line(self):
        log, junit = self.write("log", "no log"), self.write("junit.xml", JUNIT)
        self.assertIn("log: is no log of ninja's", self.refused("build", log))
        self.assertIn("log:2: is no line of ninja's log", self.refused("build", self.write("log", "# ninja log v5\n1\t2\n")))
        self.assertIn("nothing", self.refused("build", str(self.folder / "nothing")))
        self.assertIn("nothing", self.refused("tests", str(self.folder / "nothing"), str(self.folder)))
        self.assertIn("broken.xml", self.refused("tests", self.write("broken.xml", "<testsuite>"), str(self.folder)))
        self.assertIn("has no tests", self.refused("tests", self.write("none.xml", "<testsuite/>"), str(self.folder)))
        self.assertIn("without a time", self.refused("tests", self.write("x.xml", "<a><testcase name='x'/></a>"), str(self.folder)))
        self.assertIn("lists no tests there", self.refused("tests", junit, str(self.folder / "nothing")))
        for wrong in ((), ("build",), ("tests", junit), ("others", log)):
            self.assertIn("usage", self.refused(*wrong))


if __name__ == "__main__":
    unittest.main()
