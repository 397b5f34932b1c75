"""`breccia live`: ParaView's window under Xvfb, its view under pvpython, its ports.

usage: live_view_test.py PROGRAM MPIEXEC CATALYST LOOPBACK [TEST]
CATALYST: the folder catalyst of the sources; LOOPBACK: the library that is preloaded into ParaView.
"""

import json
import os
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import two_boxes

PROGRAM, MPIEXEC, CATALYST, LOOPBACK = sys.argv[1:5]
HERE = os.path.dirname(os.path.abspath(__file__))
PATIENCE = 200.0  # s, for each thing waited for; machines may be busy
SCREEN = (1600, 1000)
# Two boxes that break, for as long as it takes to look at them.
CASE = two_boxes.case(cells=[3, 3, 2], strength="5 kPa", energy="0.1 J/m2", end="20 s", more="""[sphere]
centre = ["30 mm", "15 mm", "10 mm"]
radius = "38 mm"
penalty = "40 MPa"
""")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def listeners(port, state="0A"):
    """Addresses at which somebody listens at a port (state 01: is connected to), as /proc/net tells them, in hexadecimal."""
    found = set()
    for table in ("/proc/net/tcp", "/proc/net/tcp6"):
        if not os.path.exists(table):
            continue
        with open(table, encoding="ascii") as file:
            for fields in map(str.split, list(file)[1:]):
                address, number = fields[1].split(":")
                if fields[3] == state and int(number, 16) == port:
                    found.add(address)
    return found


def children(process):
    """The process and all that descend from it."""
    found = [process]
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
                parent = int(file.read().rpartition(")")[2].split()[1])
        except (OSError, IndexError):
            continue
        if parent == process:
            found += children(int(pid))
    return found


def public_ports(process):
    """Ports of TCP at which a process, or one that it has started, listens for other machines."""
    sockets = set()
    for pid in children(process):
        try:
            for number in os.listdir(f"/proc/{pid}/fd"):
                target = os.readlink(f"/proc/{pid}/fd/{number}")
                if target.startswith("socket:["):
                    sockets.add(target[8:-1])
        except OSError:
            continue
    with open("/proc/net/tcp", encoding="ascii") as file:
        rows = [line.split() for line in list(file)[1:]]
    return [row[1] for row in rows if row[3] == "0A" and row[9] in sockets and not row[1].startswith("0100007F")]


def state(process):
    with open(f"/proc/{process}/stat", encoding="utf-8") as file:
        return file.read().rpartition(")")[2].split()[0]


class Screen:
    """An Xvfb whose picture can be read."""

    def __init__(self, folder):
        self._file = os.path.join(folder, "Xvfb_screen0")
        reader, writer = os.pipe()
        self._server = subprocess.Popen(["Xvfb", "-displayfd", str(writer), "-noreset", "-nolisten", "tcp", "-fbdir", folder, "-screen", "0",
                                         f"{SCREEN[0]}x{SCREEN[1]}x24"], pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as line:
            self.name = ":" + line.readline().strip()

    def coloured(self, left, right, top, bottom):
        """Part of the pixels in a rectangle that are neither white, grey nor black."""
        with open(self._file, "rb") as file:
            data = file.read()
        fields = struct.unpack(">20I", data[:80])
        begin, line, pixel = fields[0] + 12 * fields[19], fields[12], fields[11] // 8
        number = coloured = 0
        for y in range(top, bottom, 3):
            for x in range(left, right, 3):
                place = begin + y * line + x * pixel
                colour = data[place:place + 3]
                number += 1
                coloured += max(colour) - min(colour) > 60
        return coloured / number

    def close(self):
        self._server.terminate()
        self._server.wait()


class LiveView(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="breccia_live_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.case = os.path.join(self.folder, "case.toml")
        with open(self.case, "w", encoding="utf-8") as file:
            file.write(CASE)
        self.port = free_port()
        self.environment = {**os.environ, "HOME": self.folder, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        for name in ("DISPLAY", "XDG_CONFIG_HOME", "PYTHONPATH"):
            self.environment.pop(name, None)

    def start(self, command, name, **environment):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as output:
            process = subprocess.Popen(command, env={**self.environment, **environment}, stdout=output, stderr=output, start_new_session=True)
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGTERM)
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    def text(self, name):
        try:
            with open(os.path.join(self.folder, name), encoding="utf-8", errors="replace") as file:
                return file.read()
        except OSError:
            return ""

    def wait(self, what, condition, *logs):
        end = time.time() + PATIENCE
        while not condition():
            if time.time() > end:
                self.fail(f"waited in vain for {what}\n" + "\n".join(f"{log}:\n{self.text(log)}" for log in logs))
            time.sleep(0.1)

    def run_with_live(self, name, ranks):
        """A run that goes on until it is stopped."""
        many = [MPIEXEC, "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        return self.start([*many, PROGRAM, "run", self.case, "-o", os.path.join(self.folder, name), "--progress", "none", "--live",
                           f"localhost:{self.port}", "--set", "insitu.live.interval=0", "--set", "insitu.live.max_overhead=0.5",
                           "--set", "output.frame_interval=1", "--set", "output.history_interval='1 us'"], name + ".log")

    def stop(self, run, name):
        subprocess.run([PROGRAM, "control", os.path.join(self.folder, name), "stop"], check=True, stdout=subprocess.DEVNULL, timeout=PATIENCE)
        run.wait(PATIENCE)

    def live_updates(self, name):
        summary = json.loads(self.text(os.path.join(name, "summary.json")))
        return next(pipeline["executed"] for pipeline in summary["insitu"]["pipelines"] if pipeline["name"] == "live")

    def test_the_view_follows_a_run_pauses_it_and_goes_on_with_the_next_one(self):
        screen = Screen(self.folder)
        self.addCleanup(screen.close)
        paths = ":".join(os.path.join(CATALYST, part) for part in ("python", "pipelines"))
        client = self.start(["pvpython", os.path.join(HERE, "live_view_client.py"), self.folder], "pvpython.log", DISPLAY=screen.name,
                            PYTHONPATH=paths, BRECCIA_LIVE_PORT=str(self.port), BRECCIA_LIVE_TITLE="two boxes", BRECCIA_LIVE_END="20",
                            BRECCIA_LIVE_STRENGTH="5e3", STEERING=PROGRAM)

        def told(line):
            if client.poll() not in (None, 0):
                self.fail(self.text("client.log") + self.text("pvpython.log"))
            return f"\n{line}" in "\n" + self.text("client.log")

        logs = ("client.log", "pvpython.log", "one.log", "two.log")
        self.wait("the view", lambda: told("ready"), *logs)
        run = self.run_with_live("one", 2)
        self.wait("the first run to be seen", lambda: told("ready for its end"), *logs)
        self.stop(run, "one")
        self.wait("its end to be seen", lambda: told("ready for the next"), *logs)
        run = self.run_with_live("two", 1)
        self.wait("the second run to be seen and steered", lambda: told("ready with all"), *logs)
        run.wait(PATIENCE)
        self.assertIn("stopped", json.loads(self.text(os.path.join("two", "summary.json")))["status"])

        lines = self.text("client.log").splitlines()
        said = {line.split()[0]: line for line in lines if not line.startswith("ready")}
        self.assertIn("waiting for a run: breccia run CASE.toml --live=localhost:", lines[0])
        self.assertRegex(said["first"], r"two boxes \| t = [\d.]+ .s?, step [\d,]+ \| [\d,]+ broken joints, 2 ranks")
        self.assertIn("held", said)
        self.assertIn("went on", lines)
        self.assertRegex(said["ended"], r"step [\d,]+ .*the run has ended; waiting for the next one cells [1-9]")
        self.assertIn("began again", lines)
        self.assertRegex(said["second"], r"broken joints, 1 rank .*coloured yes")
        self.assertEqual(said["curves"], "curves coloured")
        self.assertEqual(said["folder"], "folder " + os.path.join(self.folder, "two"))
        self.assertIn("answered frame_interval 1 ms: done", lines)
        self.assertIn("soon", said["refused"])
        self.assertIn("stood", lines)
        for answer in ("pause: done", "resume: done", "extract: done", "this view was not opened by `breccia live`"):
            self.assertIn("answered " + answer, lines)
        self.assertIn("cracks by opening", lines)

    def test_the_window_shows_a_coloured_view_without_a_click_and_listens_for_this_machine_only(self):
        screen = Screen(self.folder)
        self.addCleanup(screen.close)
        view = (420, 1000, 300, 900)  # within the view, without its words and keys
        window = self.start([PROGRAM, "live", self.case, "--set", f"insitu.live.address='localhost:{self.port}'"], "live.log",
                            DISPLAY=screen.name)
        self.wait("the port", lambda: listeners(self.port), "live.log")
        self.assertEqual(listeners(self.port), {"0100007F"})
        self.assertEqual(public_ports(window.pid), [])
        self.assertIn(f"--live=localhost:{self.port}", self.text("live.log"))
        self.assertLess(screen.coloured(*view), 0.001)
        for name in ("one", "two"):
            run = self.run_with_live(name, 1)
            self.wait("a connection", lambda: listeners(self.port, "01"), "live.log", name + ".log")
            # The second run finds the picture of the first one, and its own is pale until joints break.
            self.wait("broken joints", lambda: self.last_status(name).get("broken_joints", 0) > 0, name + ".log")
            self.wait("a coloured view", lambda: screen.coloured(*view) > 0.02, "live.log", name + ".log")
            self.stop(run, name)
            self.assertGreaterEqual(self.live_updates(name), 1)
            time.sleep(3)  # a box of messages would cover the view by then
            self.assertGreater(screen.coloured(*view), 0.02)
        self.assertIsNone(window.poll())
        settings = os.path.join(self.folder, ".config", "breccia", "ParaView")
        self.assertEqual(sorted(os.listdir(os.path.join(settings, "Macros"))), ["Continue.py", "Extract.py", "Pause.py", "Stop.py"])
        self.assertFalse(os.path.exists(os.path.join(self.folder, ".config", "ParaView")), "the user's own settings stay as they are")

    def assert_let_go_and_complete(self, name, before):
        """The run has told that nobody answered, once, and goes on, and ends when it is told to."""
        self.wait("a word", lambda: "ParaView did not respond within 30 s; the connection was closed" in self.text(name + ".log"), name + ".log")
        self.assertEqual(self.text(name + ".log").count("\n"), 1, self.text(name + ".log"))
        self.wait("steps", lambda: self.steps(name) > before)

    def last_status(self, name):
        lines = [line for line in self.text(os.path.join(name, "status.jsonl")).splitlines() if '"state"' in line]
        return json.loads(lines[-1]) if lines else {}

    def steps(self, name):
        return self.last_status(name).get("step", -1)

    def test_a_service_that_says_nothing_does_not_hold_a_run(self):
        for ranks in (1, 2):
            with socket.socket() as mute:
                mute.bind(("127.0.0.1", 0))
                mute.listen()
                self.port, name = mute.getsockname()[1], f"run_{ranks}"
                run = self.run_with_live(name, ranks)
                self.assert_let_go_and_complete(name, 0)
                self.stop(run, name)
                self.assertIn("stopped", json.loads(self.text(os.path.join(name, "summary.json")))["status"])

    def test_a_paraview_that_is_stopped_does_not_hold_a_run(self):
        screen = Screen(self.folder)
        self.addCleanup(screen.close)
        client = self.start(["pvpython", os.path.join(HERE, "live_client.py"), str(self.port), self.folder, "--freeze"], "pvpython.log",
                            DISPLAY=screen.name)
        self.wait("the port", lambda: listeners(self.port), "pvpython.log")
        run = self.run_with_live("run", 2)
        self.wait("a client that stands", lambda: state(client.pid) == "T", "client.log", "pvpython.log", "run.log")
        self.assert_let_go_and_complete("run", self.steps("run"))
        self.stop(run, "run")
        os.kill(client.pid, signal.SIGCONT)

    def test_a_port_that_is_taken_is_told(self):
        with socket.socket() as other:
            other.bind(("127.0.0.1", self.port))
            other.listen()
            told = subprocess.run([PROGRAM, "live", self.case, "--set", f"insitu.live.address='localhost:{self.port}'"], env=self.environment,
                                  capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(told.returncode, 2)
        self.assertIn(f"port {self.port}: ParaView cannot listen there", told.stderr)

    def test_a_window_without_a_display_is_refused_in_one_line(self):
        for display in ("", ":4077", ":4077.0"):
            environment = {name: value for name, value in self.environment.items() if name not in ("WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
            told = subprocess.run([PROGRAM, "live", self.case, "--set", f"insitu.live.address='localhost:{self.port}'"],
                                  env=dict(environment, DISPLAY=display), capture_output=True, text=True, timeout=PATIENCE)
            self.assertEqual(told.returncode, 2, told.stderr)
            self.assertIn("there is no display for its window", told.stderr)
            self.assertEqual((told.stdout, told.stderr.count("\n")), ("", 1), told.stderr)


class Loopback(unittest.TestCase):
    PROBE = """
import socket, sys
for family, address in ((socket.AF_INET, ""), (socket.AF_INET, "127.0.0.2"), (socket.AF_INET6, "::"), (socket.AF_UNIX, sys.argv[1])):
    try:
        with socket.socket(family) as probe:
            probe.bind(address if family == socket.AF_UNIX else (address, 0))
            name = probe.getsockname()
            print(name if family == socket.AF_UNIX else name[0])
    except OSError as error:
        print("no such family" if family == socket.AF_INET6 else error)
"""

    def bound(self, **environment):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "socket")
            lines = subprocess.run([sys.executable, "-c", self.PROBE, path], env={**os.environ, **environment}, capture_output=True, text=True,
                                   check=True).stdout.split("\n")
            return [line.replace(path, "path") for line in lines[:4]]

    def test_what_is_open_to_all_becomes_open_to_this_machine_and_the_rest_stays(self):
        plain, kept = self.bound(), self.bound(LD_PRELOAD=LOOPBACK)
        self.assertEqual(plain[0], "0.0.0.0")
        self.assertEqual(kept[0], "127.0.0.1")
        self.assertEqual(kept[1], "127.0.0.2")
        self.assertIn(kept[2], ("::1", "no such family"))
        self.assertEqual(kept[3], "path")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]], verbosity=2)
