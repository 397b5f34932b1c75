"""A folder in which the commands of a README are tried as if it were the repository: links to what the repository holds and to one build folder,
and a folder runs/ of its own."""

import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from commands import PROGRAM
from plans import RUN_GOING_ON, Problem

LINKED = ("meshes", "catalyst", "gui", "solver", "tests", "CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md")
PATIENCE = 240           # s for one command; the slowest takes ten on an idle machine, more under the sanitizers
PYTHON = "/usr/bin/python3"  # the one for which Debian has h5py
BLANK_PICTURE = 5000     # bytes; a picture of one colour takes less
STUB = "#!/bin/sh\necho \"$0 $*\" >>'{record}'\n{work}\n"
# Programs that must not do their work here. A test neither installs nor builds: what `./run` would build stands in the build folder, and
# dpkg-query says that every package is there. paraview would open a window.
STUBS = {"paraview": "exit 0", "cmake": "exit 0", "dpkg-query": "echo installed"}


class Scratch:
    def __init__(self, repository, build):
        self.repository, self.build = Path(repository).resolve(), Path(build).resolve()
        self.root = Path(tempfile.mkdtemp(prefix="breccia_readme_"))
        for name in LINKED:
            if (self.repository / name).exists():
                (self.root / name).symlink_to(self.repository / name)
        (self.root / "build").mkdir()
        (self.root / "build/release").symlink_to(self.build)
        shutil.copy(self.repository / "run", self.root / "run")  # a link would lead it home
        self.bin = self.root / "bin"
        self.bin.mkdir()
        self.record = self.root / "calls.txt"
        for name, work in STUBS.items():
            (self.bin / name).write_text(STUB.format(record=self.record, work=work), encoding="utf-8")
            (self.bin / name).chmod(0o755)
        for program in (PROGRAM, "meshes/breccia-picture"):  # as if they were installed
            (self.bin / Path(program).name).symlink_to(self.root / program)
        self.environment = {**os.environ, "PATH": f"{self.bin}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8",
                            "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                            "QT_QPA_PLATFORM": "offscreen"}  # `breccia live` asks for a display, though the stub opens no window
        if len(os.sched_getaffinity(0)) < 2:  # the READMEs are written for two cores
            self.environment["OMPI_MCA_rmaps_base_oversubscribe"] = "1"
        self.going_on = None

    def close(self):
        self.end_run()
        shutil.rmtree(self.root, ignore_errors=True)

    def lacks(self, need):
        """Why a command with that need cannot be tried on this machine, or ""."""
        if need == "adaptor" and not (self.build / "catalyst/libbreccia_catalyst.so").exists():
            return "the in-situ adaptor is not built"
        if need == "guide":
            return "" if (self.build / "solver/manual/guide/html/index.html").exists() else "the manual is not built (BRECCIA_GUIDE)"
        if need == "lists":
            return "" if any(Path("/var/lib/apt/lists").glob("*Packages*")) else "apt has no lists of packages"
        if need == "h5py":
            lacking = subprocess.run([PYTHON, "-c", "import h5py"], capture_output=True, check=False).returncode
            return "python3-h5py is not installed" if lacking else ""
        tools = {"adaptor": ("pvpython", "Xvfb"), "paraview": ("pvbatch", "xvfb-run")}[need]
        lacking = [tool for tool in tools if not shutil.which(tool)]
        return f"this machine lacks {', '.join(lacking)}" if lacking else ""

    def calls(self):
        """What the stubs were called with, a call a line."""
        return self.record.read_text(encoding="utf-8") if self.record.exists() else ""

    def type(self, text):
        """Types a command. Returns (exit code, everything printed)."""
        shell = subprocess.Popen(["bash", "-c", text], cwd=self.root, env=self.environment, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            printed = shell.communicate(timeout=PATIENCE)[0]
        except subprocess.TimeoutExpired:
            os.killpg(shell.pid, signal.SIGTERM)  # mpiexec passes it on to its ranks
            try:
                printed = shell.communicate(timeout=10)[0]
            except subprocess.TimeoutExpired:
                os.killpg(shell.pid, signal.SIGKILL)
                printed = shell.communicate()[0]
            raise Problem(f"took more than {PATIENCE} s\n{printed.decode(errors='replace')[-2000:]}") from None
        return shell.returncode, printed.decode(errors="replace")

    def start_run(self):
        """A run that goes on for as long as commands want to speak to it."""
        if self.going_on is not None and self.going_on.poll() is None:
            return
        shutil.rmtree(self.root / RUN_GOING_ON, ignore_errors=True)  # its status would be taken for that of the new run
        arguments = [self.root / PROGRAM, "run", "meshes/block_wall/case.toml", "-f", "-o", RUN_GOING_ON, "--progress", "none",
                     "--set", "stage.impact.end=\"1 s\""]
        self.going_on = subprocess.Popen(arguments, cwd=self.root, env=self.environment, stdout=subprocess.DEVNULL, start_new_session=True)
        status = self.root / RUN_GOING_ON / "status.jsonl"
        for _ in range(10 * PATIENCE):
            if status.exists() and status.stat().st_size > 0:
                return
            time.sleep(0.1)
        raise Problem("the run that commands are to speak to has not started")

    def end_run(self):
        if self.going_on is None:
            return
        if self.going_on.poll() is None:
            self.going_on.kill()
        self.going_on.wait()
        self.going_on = None

    def check_run(self, folder):
        """Throws Problem unless the run in that folder has ended well and each of its pipelines has worked."""
        file = self.root / folder / "summary.json"
        if not file.exists():
            raise Problem(f"left no {folder}/summary.json")
        summary = json.loads(file.read_text(encoding="utf-8"))
        if summary["status"] not in ("complete", "stopped: time.max_steps reached"):
            raise Problem(f"{folder}/summary.json says: {summary['status']}")
        for pipeline in summary.get("insitu", {}).get("pipelines", []):
            if pipeline["failed"] > 0 or (pipeline["executed"] == 0 and pipeline["name"] != "live"):
                raise Problem(f"pipeline {pipeline['name']}: executed {pipeline['executed']} times, failed {pipeline['failed']} times")
        for picture in sorted((self.root / folder / "extracts").rglob("*.png")):
            self.check_picture(picture)

    def check_file(self, name):
        if not (self.root / name).exists():
            raise Problem(f"left no {name}")
        if name.endswith(".png"):
            self.check_picture(self.root / name)

    def check_picture(self, file):
        if file.stat().st_size < BLANK_PICTURE or file.read_bytes()[:4] != b"\x89PNG":
            raise Problem(f"{file.name} is no picture, or one of a single colour")
