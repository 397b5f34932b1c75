"""./run refuses wrong arguments before it installs or builds anything.

usage: run_arguments_test.py REPOSITORY
"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

WRONG = {
    "scaling --wrong 2": "--wrong",
    "scaling --preset nonsense": "nonsense",
    "detection --wrong": "--wrong",
    "detection --counts --budget 3": "--budget",
    "bench --preset nonsense": "nonsense",
    "build relase": "relase",
    "build release native": "native",
    "install --wrong": "--wrong",
    "install one two": "two",
    "package now": "now",
    "guide now": "now",
    "packages demo extra": "extra",
    "test --fuzz soon": "soon",
    "test --fuzz -3": "-3",
    "demo fast": "demo takes no arguments",
    "no_such_command": "no_such_command",
}
WORKS = ("apt-get", "cmake", "ninja", "dpkg-query", "ctest")


class RunArguments(unittest.TestCase):
    def test_that_are_wrong_are_refused_before_anything_is_done(self):
        repository = sys.argv[1]
        with tempfile.TemporaryDirectory() as folder:
            done = Path(folder, "done")
            for name in WORKS:
                tool = Path(folder, name)
                tool.write_text(f"#!/bin/sh\necho {name} >>'{done}'\nexit 1\n", encoding="utf-8")
                tool.chmod(0o755)
            environment = os.environ | {"PATH": f"{folder}:{os.environ['PATH']}"}
            for words, named in WRONG.items():
                with self.subTest(words):
                    outcome = subprocess.run([repository + "/run", *words.split()], env=environment, text=True,
                                             capture_output=True, stdin=subprocess.DEVNULL, timeout=60, check=False)
                    self.assertEqual(outcome.returncode, 1)
                    self.assertIn(named, outcome.stderr.splitlines()[-1])
                    self.assertFalse(done.exists())
            subprocess.run([repository + "/run", "build"], env=environment, capture_output=True, timeout=60, check=False)
            self.assertTrue(done.exists(), "what is right is not refused")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
