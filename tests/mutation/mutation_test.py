"""The check of the table is itself tested: rows that fit pass, and every kind of row that does not is found, alone."""

import tempfile
import unittest
from pathlib import Path

from mutation import BROKEN, MISSED, NOTICED, chosen, problems, report

SOURCE = "double half(double x) { return 0.5 * x; }\nint one() { return 1; }\n"
ROW = {"id": "half", "file": "solver/base/half.cpp", "find": "0.5 * x", "replace": "x", "breaks": "A half is a whole.",
       "tests": ["test_base"]}
OTHER = {**ROW, "id": "one", "file": "solver/physics/half.cpp", "find": "return 1;", "replace": "return 2;"}

# (what is changed in a row, part of the message)
MISFITS = [
    ({"find": "0.25 * x"}, "the text stands 0 times"),
    ({"find": "return"}, "the text stands 2 times"),
    ({"file": "solver/base/gone.cpp"}, "there is no solver/base/gone.cpp"),
    ({"replace": "0.5 * x"}, "changes nothing"),
    ({"tests": []}, "names no tests"),
    ({"tests": ["test_base", "Budget"]}, "there is no test program Budget"),
    ({"comment": "x"}, "needs breaks, file, find, id, replace, tests"),
]


class Table(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.repository = Path(self.folder.name)
        for row in (ROW, OTHER):
            (self.repository / row["file"]).parent.mkdir(parents=True)
            (self.repository / row["file"]).write_text(SOURCE, encoding="utf-8")
        (self.repository / "tests").mkdir()
        (self.repository / "tests/CMakeLists.txt").write_text("breccia_test(NAME base LABEL unit)\n", encoding="utf-8")

    def test_rows_that_fit_have_no_problems(self):
        self.assertEqual(problems([ROW, OTHER], self.repository), [])

    def test_each_misfit_is_found_and_nothing_else(self):
        for change, message in MISFITS:
            with self.subTest(message=message):
                found = problems([{**ROW, **change}, OTHER], self.repository)
                self.assertEqual(len(found), 1, found)
                self.assertIn(message, found[0])
                self.assertTrue(found[0].startswith("half:"), found[0])

    def test_an_id_that_stands_twice_is_found(self):
        self.assertEqual(problems([ROW, ROW], self.repository), ["half: stands 2 times in the table"])

    def test_rows_are_chosen_by_id_and_by_folder(self):
        self.assertEqual(chosen([ROW, OTHER], ["one"]), [OTHER])
        self.assertEqual(chosen([OTHER, ROW], ["base"]), [ROW])
        self.assertEqual(chosen([OTHER, ROW], []), [ROW, OTHER])
        with self.assertRaises(SystemExit):
            chosen([ROW, OTHER], ["nothing"])


class Report(unittest.TestCase):
    def code(self, *results):
        rows = [{**ROW, "id": str(i)} for i in range(len(results))]
        return report(rows, {str(i): {"result": result, "by": ""} for i, result in enumerate(results)})

    def test_95_of_100_are_enough_and_94_are_not(self):
        self.assertEqual(self.code(*[NOTICED] * 95, *[MISSED] * 5), 0)
        self.assertEqual(self.code(*[NOTICED] * 94, *[MISSED] * 6), 1)

    def test_a_row_that_does_not_compile_is_a_fault_of_the_table(self):
        self.assertEqual(self.code(*[NOTICED] * 99, BROKEN), 1)


if __name__ == "__main__":
    unittest.main()
