"""Output of scripts: what they write to stdout and stderr, and warnings of Python and VTK.

All of it goes to script.log in the script's folder. The solver reports each line once: those of stdout as they are, the others as warnings. A
rank that has other output than the first one has a log of its own, script_rank_N.log.
"""

import hashlib
import io
import json
import logging
import os
import stat
import sys
import warnings

import paraview

MOST = 10  # lines, and as many warnings, that are reported at a time; the log has all
MOST_KNOWN = 100000  # lines that are not reported again
LONGEST = 300  # characters of a reported line
WARNING = "warning: "

_logs = {}  # by folder
_active = None


def install():
    """Takes the place of sys.stdout, sys.stderr and of Python's display of warnings. May be called more than once."""
    if isinstance(sys.stdout, _Stream):
        return
    sys.stdout, sys.stderr = _Stream("", sys.stdout), _Stream(WARNING, sys.stderr)
    # Its warnings reach us as VTK's, and once.
    paraview.logger.setLevel(logging.WARNING)
    paraview.logger.propagate = False
    show = warnings.showwarning

    def show_in_log(message, category, filename, lineno, file=None, line=None):
        if _active is None or file is not None:
            show(message, category, filename, lineno, file, line)
        else:
            _active.write(WARNING, f"{category.__name__}: {message} ({os.path.basename(filename)}:{lineno})\n")

    warnings.showwarning = show_in_log


def enter(folder):
    """Output from now on is that of the script with this folder."""
    global _active
    _active = _logs.setdefault(folder, _Log(folder))


def warn(text):
    """A warning of VTK's."""
    _active.write(WARNING, text + "\n")


def record(text):
    """For the log alone."""
    _active.record(text)


def take(folder):
    """Lines to report since the last call, each ended by a newline; warnings begin with WARNING. Collective."""
    return _logs[folder].take() if folder in _logs else ""


class _Stream(io.TextIOBase):
    def __init__(self, kind, before):
        self._kind, self._before = kind, before

    def write(self, text):
        if _active is None:
            return self._before.write(text)
        _active.write(self._kind, text)
        return len(text)

    def writable(self):
        return True


class _Log:
    """Of one script, on this rank."""

    def __init__(self, folder):
        self._folder = folder
        self._unfinished = {"": "", WARNING: ""}
        self._known = set()  # hashes of lines
        self._fault = ""
        self._begin()

    def _begin(self):
        self._text = []  # of other ranks than the first, until it is known whether it differs from the first one's
        self._lines, self._further = [], 0
        self._digest = hashlib.sha256()

    def write(self, kind, text):
        *lines, self._unfinished[kind] = (self._unfinished[kind] + text).split("\n")
        for line in lines:
            self._add(kind, line.rstrip())

    def record(self, text):
        self._digest.update(text.encode(errors="replace"))
        if _rank() == 0:
            self._append(self._name(), text)
        else:
            self._text.append(text)

    def take(self):
        for kind, rest in self._unfinished.items():
            if rest:
                self.write(kind, "\n")
        if _size() > 1:
            digest, reported = _of_first([self._digest.hexdigest(), self._lines])
            if _rank() > 0 and digest == self._digest.hexdigest():
                self._begin()
            elif _rank() > 0:
                self._lines = [line for line in self._lines if list(line) not in reported]
        if self._text:
            self._append(self._name(), "".join(self._text))
        where = f"rank {_rank()}: " if _rank() > 0 else ""
        lines = [f"{kind}{where}{line}\n" for kind, line in self._lines]
        if self._further:
            lines.append(f"{where}{self._further} more lines in {os.path.join(self._folder, self._name())}\n")
        self._begin()
        return "".join(lines)

    @staticmethod
    def _name():
        return f"script_rank_{_rank()}.log" if _rank() > 0 else "script.log"

    def _add(self, kind, line):
        self.record(kind + line + "\n")
        short = line if len(line) <= LONGEST else line[:LONGEST] + "..."
        if not line or hash((kind, short)) in self._known:
            return
        if len(self._known) < MOST_KNOWN:
            self._known.add(hash((kind, short)))
        if sum(known == kind for known, _ in self._lines) < MOST:
            self._lines.append((kind, short))
        else:
            self._further += 1

    def _append(self, name, text):
        """A log that cannot be written is reported once and costs the script nothing."""
        path = os.path.join(self._folder, name)
        try:
            # The folder may be another's: no link, pipe or device is opened.
            file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o666)
            with os.fdopen(file, "wb") as stream:
                if not stat.S_ISREG(os.fstat(file).st_mode):
                    raise OSError(f"{path}: no regular file")
                stream.write(text.encode(errors="replace"))
        except OSError as error:
            if not self._fault:
                self._lines.append((WARNING, f"{path} cannot be written: {error.strerror or error}"))
            self._fault = str(error)


def _controller():
    from paraview.vtk.vtkParallelCore import vtkMultiProcessController

    return vtkMultiProcessController.GetGlobalController()


def _rank():
    controller = _controller()
    return 0 if controller is None else controller.GetLocalProcessId()


def _size():
    controller = _controller()
    return 1 if controller is None else controller.GetNumberOfProcesses()


def _of_first(value):
    """The first rank's. Collective."""
    from paraview.vtk.vtkCommonCore import vtkUnsignedCharArray

    letters = vtkUnsignedCharArray()
    for letter in json.dumps(value).encode():
        letters.InsertNextValue(letter)
    _controller().Broadcast(letters, 0)
    return json.loads(bytes(letters.GetValue(i) for i in range(letters.GetNumberOfValues())))
