"""Scripts under a run and in a replay: one that ParaView's export has written, on one and on two ranks; pictures from all sides.

usage: exported_script_test.py PROGRAM MPIEXEC PVPYTHON XVFB_RUN
"""
import os
import subprocess
import sys
import tempfile
import unittest

import two_boxes

PROGRAM, MPIEXEC, PVPYTHON, XVFB_RUN = sys.argv[1:5]
HERE = os.path.dirname(os.path.abspath(__file__))
CASE = two_boxes.case(cells=[2, 2, 1], strength="20 kPa", energy="1 J/m2", end="4 ms")
PIPELINE = '{{name="{}", every_time="0.6 ms", strict=true}}'


class ExportedScript(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = cls.temporary.name
        with open(os.path.join(cls.folder, "case.toml"), "w", encoding="utf-8") as file:
            file.write(CASE)
        cls.run_case("recorded", 2)
        cls.script = os.path.join(cls.folder, "exported.py")
        cls.call([XVFB_RUN, "-a", "-s", "-screen 0 800x600x24 -noreset", PVPYTHON, os.path.join(HERE, "export_script.py"),
                  os.path.join(cls.folder, "recorded", "extracts"), cls.script])

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def call(cls, command):
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        done = subprocess.run(command, cwd=cls.folder, env=environment, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise AssertionError(f"{' '.join(command)}: {done.returncode}\n{done.stdout}\n{done.stderr}")
        return done

    @classmethod
    def on_ranks(cls, ranks, arguments):
        return cls.call([MPIEXEC, "--oversubscribe", "-n", str(ranks), PROGRAM, *arguments])

    @classmethod
    def run_case(cls, name, ranks, *scripts):
        pipelines = ",".join(PIPELINE.format(pipeline) for pipeline in ("surface", "volume", "fractures", *scripts))
        return cls.on_ranks(ranks, ["run", "case.toml", "-o", name, "--progress", "none", "--set", f"insitu.pipeline=[{pipelines}]"])

    def compare(self, records, extracts, ranks):
        self.call([PVPYTHON, os.path.join(HERE, "compare_extracts.py"), os.path.join(self.folder, records),
                   os.path.join(self.folder, extracts), str(ranks)])

    def test_a_run_writes_each_instant_and_piece_to_a_file_of_its_own(self):
        for ranks in (1, 2):
            name = f"run_{ranks}"
            self.assertEqual(self.run_case(name, ranks, self.script).stderr, "")
            self.compare(f"{name}/extracts", f"{name}/extracts/exported", ranks)

    def test_a_replay_does_so_too(self):
        for ranks in (1, 2):
            self.on_ranks(ranks, ["insitu", "replay", "recorded", self.script, "-o", f"replay_{ranks}"])
            self.compare("recorded/extracts", f"replay_{ranks}/exported", ranks)

    def test_pictures_from_all_sides_show_the_model_alone(self):
        self.on_ranks(1, ["insitu", "replay", "recorded", "stress", "-p", "orbit=4", "-o", "orbit"])
        folder = os.path.join(self.folder, "orbit", "stress")
        with open(os.path.join(folder, "data.csv"), encoding="utf-8") as table:
            rows = table.read().splitlines()
        instants = len({row.split(",")[0] for row in rows[1:]})
        self.assertEqual((rows[0], len(rows) - 1), ("time,phi,theta,FILE", 8 * instants))
        self.assertEqual(len([name for name in os.listdir(folder) if name.endswith(".png")]), 8 * instants)
        self.call([PVPYTHON, os.path.join(HERE, "blank_rim.py"), folder])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
