# script-version: 2.0
"""The first script that the adaptor for Catalyst 2 hands to ParaView's implementation; it draws nothing itself.

That implementation runs all scripts at every execution, ends those that raise, and reports neither. Loaded before the others, this one lets only
the script run whose turn it is, keeps what it raises as one line, on all ranks when on any, and carries its requests to the solver. Its one
argument is the address of the functions through which it does so (script_bridge.cpp).
"""

import ctypes
import json
import os
import sys

from paraview import catalyst
from paraview.catalyst import v2_internals

try:
    import breccia_guard
except ImportError:
    folder = os.path.dirname(os.path.abspath(catalyst.get_script_filename() or __file__))
    sys.path[:0] = [folder, os.path.join(os.path.dirname(folder), "pipelines")]
    import breccia_guard

import breccia_insitu
import breccia_output

NEVER = 2**31 - 1  # a time step

options = catalyst.Options()
options.GenerateCinemaSpecification = 0


class Functions(ctypes.Structure):
    _fields_ = [("scripts", ctypes.CFUNCTYPE(ctypes.c_char_p)), ("turn", ctypes.CFUNCTYPE(ctypes.c_char_p)),
                ("agree", ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_char_p)), ("done", ctypes.CFUNCTYPE(None, ctypes.c_char_p)),
                ("request", ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_char_p, ctypes.c_double)),
                ("spare", ctypes.CFUNCTYPE(None, ctypes.c_void_p)),
                ("note", ctypes.CFUNCTYPE(None, ctypes.c_char_p, ctypes.c_char_p))]


solver = Functions.from_address(int(catalyst.get_args()[0]))
scripts = {script["script"]: script for script in json.loads(solver.scripts().decode())}
triggers = {}  # of scripts that have been read: their own options
failed = {}  # what they raised when they were read


def turn():
    """The script that is to run; "": none."""
    return solver.turn().decode()


def agree(text):
    """Whether any rank brings a text."""
    answer = solver.agree(text.encode())
    if answer == 2:
        raise RuntimeError("other ranks have not come")
    return answer == 1


def request(name, value):
    solver.request(name.encode(), float(value))


def enter(path):
    script = scripts[path]
    breccia_guard.enter(script["name"], path, script["folder"], script["parameters"], script["about"])


def note(path):
    """Passes on what the script has written."""
    script = scripts[path]
    solver.note(script["name"].encode(), breccia_output.take(script["folder"]).encode(errors="replace"))


def step_trigger(options):
    """Theirs by time step, whose name has a blank in newer ParaViews."""
    names = options.GetProperty("GlobalTrigger").Available
    options.GlobalTrigger = next(name for name in names if name.replace(" ", "") == "TimeStep")
    options.GlobalTrigger.UseStartTimeStep = 1
    return options.GlobalTrigger


def gate(path):
    """ParaView passes a script over, its extractors and views too, while the trigger of its options does not fire."""
    triggers[path].StartTimeStep = 0 if path == turn() else NEVER


def read(function):
    """Around the functions that read a script and begin with it: these run once for each, whosever turn it is."""

    def call(*arguments):
        path = catalyst.get_script_filename()
        if path not in scripts:
            return function(*arguments)
        enter(path)
        try:
            result = function(*arguments)
        except breccia_guard.ScriptFailed:
            failed[path] = breccia_guard.take_error() or "it failed on another rank"
            raise
        if hasattr(result, "options"):
            triggers[path] = step_trigger(result.options)
            gate(path)
        return result

    return call


def execute(function):
    """A script's turn. It raises nothing: ParaView would never run it again, and that is the solver's to decide."""

    def call(module):
        path = catalyst.get_script_filename()
        if path not in scripts:
            return function(module)
        if path != turn():
            return True
        enter(path)
        try:
            function(module)
        except breccia_guard.ScriptFailed:
            pass
        solver.done(breccia_guard.take_error().encode())
        note(path)
        return True

    return call


def finish(function):
    def call(module):
        path = catalyst.get_script_filename()
        if path not in scripts:
            return function(module)
        if path in failed:
            return None
        enter(path)
        try:
            function(module)
        except breccia_guard.ScriptFailed:
            if error := breccia_guard.take_error():
                breccia_output.warn(f"at its end: {error}")
        note(path)
        return None

    return call


def report(kind, error, trace):
    """ParaView prints exceptions through this hook; the solver reports those of scripts."""
    if kind is not breccia_guard.ScriptFailed:
        sys.__excepthook__(kind, error, trace)


breccia_guard.install(agree, solver.spare)
sys.excepthook = report
breccia_insitu.set_request(request)
v2_internals.import_and_validate = read(v2_internals.import_and_validate)
v2_internals.do_catalyst_initialize = read(v2_internals.do_catalyst_initialize)
v2_internals.do_catalyst_execute = execute(v2_internals.do_catalyst_execute)
v2_internals.do_catalyst_finalize = finish(v2_internals.do_catalyst_finalize)


def catalyst_execute(info):
    for path in triggers:
        gate(path)
    if turn() in failed:
        solver.done(failed[turn()].encode())
        note(turn())
