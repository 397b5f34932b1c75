"""The script of the continuous integration, with a ./run that only notes what it is asked for.

usage: ci_run_test.py REPOSITORY
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

REPOSITORY = Path(sys.argv[1])
RUN = """#!/bin/sh
echo "$*" >>asked
[ "$*" != "$FAILS" ]
"""
AT_ONCE = ["test --bare --package", "test --bare bookworm"]
ALWAYS = ["test --configure", "test --build", "test", *AT_ONCE]
TRIXIE = "test --bare trixie"


@unittest.skipUnless(shutil.which("git"), "git is not installed")
class ContinuousIntegration(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.clone, self.cache = Path(folder.name, "clone"), Path(folder.name, "cache", "breccia", "bare")
        for part in (".ci", "tests/times"):
            shutil.copytree(REPOSITORY / part, self.clone / part)
        self.cache.mkdir(parents=True)
        (self.clone / "run").write_text(RUN, encoding="utf-8")
        (self.clone / "run").chmod(0o755)
        self.git("init", "-q")
        self.commit()

    def git(self, *arguments):
        subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=e", *arguments], cwd=self.clone, check=True)

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "change")

    def asked(self, fails="nothing"):
        """Exit code and what the script asked ./run for, that which it asks at once in the order of AT_ONCE."""
        (self.clone / "asked").unlink(missing_ok=True)
        environment = {**os.environ, "XDG_CACHE_HOME": str(self.cache.parents[1]), "FAILS": fails}
        ended = subprocess.run([".ci/run"], cwd=self.clone, env=environment, capture_output=True, text=True, check=False)
        self.output = ended.stdout
        asked = (self.clone / "asked").read_text(encoding="utf-8").splitlines()
        if set(asked[3:5]) == set(AT_ONCE):
            asked[3:5] = AT_ONCE
        return ended.returncode, asked

    def test_tries_debian_13_again_when_what_decides_it_has_changed_or_a_week_has_passed(self):
        self.assertEqual(self.asked(), (0, [*ALWAYS, TRIXIE]))
        self.assertEqual(self.asked(), (0, ALWAYS))
        self.assertIn("within a week", self.output)
        (self.clone / "source.cpp").write_text("", encoding="utf-8")
        self.commit()
        self.assertEqual(self.asked(), (0, ALWAYS))
        for file in ("run", "solver.cmake", "tests/CMakeLists.txt"):
            with (self.clone / file).open("a", encoding="utf-8") as text:
                text.write("# changed\n")
            self.commit()
            self.assertEqual(self.asked(), (0, [*ALWAYS, TRIXIE]), file)
        os.utime(self.cache / "trixie.tried", (0, 0))
        self.assertEqual(self.asked(), (0, [*ALWAYS, TRIXIE]))
        self.assertEqual(self.asked(), (0, ALWAYS))

    def test_tries_debian_13_where_it_failed_before_and_where_nothing_is_known(self):
        for _ in range(2):
            self.assertEqual(self.asked(TRIXIE), (1, [*ALWAYS, TRIXIE]))
        self.assertEqual(self.asked(), (0, [*ALWAYS, TRIXIE]))
        shutil.rmtree(self.clone / ".git")
        for _ in range(2):
            self.assertEqual(self.asked(), (0, [*ALWAYS, TRIXIE]))

    def test_ends_with_the_first_part_that_fails_and_tells_the_time_of_each(self):
        for number, part in enumerate(ALWAYS):
            asked = ALWAYS if part in AT_ONCE else ALWAYS[:number + 1]
            self.assertEqual(self.asked(part), (1, asked))
            table = (self.clone / "runs/ci/parts.txt").read_text(encoding="utf-8").splitlines()
            self.assertEqual(len(table), len(asked) + 1)
            failed = [row for row in table if row.endswith("(failed)")]
            self.assertEqual(len(failed), 1, table)
            self.assertIn(failed[0], table[-3:-1] if part in AT_ONCE else [table[-2]])
            self.assertTrue(table[-1].endswith("all"), table)
            self.assertIn("\n".join(table), self.output)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
