"""Data of the Breccia run that executes a Catalyst script, and requests of the script to the run.

    import breccia_insitu

    width = breccia_insitu.parameter("width", 1600)     # from the case file, or the default
    path = breccia_insitu.folder()                      # where the files of this script go
    breccia_insitu.request(info, extract=1)             # in catalyst_execute(info)

Outside a run (pvbatch script.py) the folder is $BRECCIA_INSITU_FOLDER or the current one and parameters have their defaults.
"""

import os

_name = ""
_folder = os.environ.get("BRECCIA_INSITU_FOLDER", os.getcwd())
_parameters = {}
_about = {}
_request = None

REQUESTS = ("stop", "pause", "extract", "frame_interval")


def set_active(name, folder, parameters, about):
    """Called by the adaptor before each execution of a script."""
    global _name, _folder, _parameters, _about
    _name, _folder, _parameters, _about = name, folder, dict(parameters), dict(about)


def pipeline():
    """Name of the pipeline; "" outside a run."""
    return _name


def folder():
    """Absolute folder of the pipeline's files; exists in a run. Extractors write there by themselves."""
    return _folder


def parameter(name, default):
    """One of the pipeline's parameters in the case file, or the default. Where the default is a text it is the text, as it is written; else a
    number, in SI, a whole one where the default is one.

    Write name and default as literals: names and kinds of parameters are checked before a run.
    """
    if name not in _parameters:
        return default
    number, text = _parameters[name]  # a text that reads as a quantity is both
    if isinstance(default, str):
        if text is None:
            raise TypeError(f"the parameter '{name}' is a text; given: {number:g}")
        return text
    if number is None:
        if default is None:
            return text
        raise TypeError(f"the parameter '{name}' is a number, or a text with a unit; given: \"{text}\"")
    return int(round(number)) if isinstance(default, int) and not isinstance(default, bool) else number


def title():
    """Title of the case; "" outside a run."""
    return _about.get("title", "")


def end():
    """Simulated time at which the run ends, s; 0: unknown."""
    return _about.get("end", 0.0)


def strength():
    """A stress at which something breaks in this case, Pa; 0: unknown."""
    return _about.get("strength", 0.0)


def set_request(function):
    """Called by the adaptor where requests are carried by function(name, value) instead of ParaView's data description."""
    global _request
    _request = function


def request(info, **wishes):
    """Requests that the solver stops, pauses or extracts (1), or changes its frame_interval (s); `info` is that of catalyst_execute."""
    for name, value in wishes.items():
        if name not in REQUESTS:
            raise ValueError(f"{name} cannot be requested; what can: {', '.join(REQUESTS)}")
        if _request is not None:
            _request(name, value)
        else:
            info.dataDescription.GetUserData().GetArray(name).SetValue(0, value)
