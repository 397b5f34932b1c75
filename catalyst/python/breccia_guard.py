"""Stands between ParaView Catalyst and the scripts that it runs; the adaptor calls it.

What a script raises is kept as one line instead of being printed as a traceback, which goes to its log; when it raises on one rank, it has
raised on all of them, so that no rank continues alone into work that needs the others; sys.exit ends the script's step, not the process.
"""

import importlib
import os
import re
import sys
import traceback

import breccia_extractors
import breccia_insitu
import breccia_output

_error = ""
_script = ""
_unusable = set()  # scripts that raised when they were imported or initialized
_agree = None
_spare = None


def install(agree, spare):
    """Wraps the functions through which ParaView calls scripts. May be called more than once. agree(text) is true if any rank passes a
    text; it raises if another rank does not take part. spare(display) keeps the process alive when the server of an X display, an address,
    has closed."""
    global _agree, _spare
    from paraview import catalyst
    from paraview.catalyst import detail, v2_internals

    _agree, _spare = agree, spare
    if getattr(v2_internals, "breccia_guarded", False):
        return
    v2_internals.breccia_guarded = True
    import_and_validate = v2_internals.import_and_validate

    def import_into_folder(name):
        module = importlib.import_module(name)
        if not hasattr(module, "options"):  # ParaView warns of that; the case is what counts
            module.options = catalyst.Options()
        import_and_validate(name)
        # Extracts go where the solver wants them, whatever folder stood in ParaView's dialogue when the script was exported.
        module.options.ExtractsOutputDirectory = breccia_insitu.folder()
        return module

    v2_internals.import_and_validate = _guarded(import_into_folder, starts=True)
    detail._transform_registration_name = _channel_of_source
    breccia_extractors.install()
    breccia_output.install()
    v2_internals.do_catalyst_execute = _naming_files(v2_internals.do_catalyst_execute)
    v2_internals.do_catalyst_initialize = _guarded(v2_internals.do_catalyst_initialize, starts=True)
    for name in ("register_module", "do_request_data_description", "do_catalyst_execute", "do_catalyst_finalize"):
        setattr(v2_internals, name, _guarded(getattr(v2_internals, name)))
    # ParaView prints what we raise through this hook; it has been kept already.
    sys.excepthook = _keep_unseen


def _naming_files(do_catalyst_execute):
    """ParaView writes the extracts when this has returned."""

    def call(module):
        from paraview.catalyst import v2_internals

        result = do_catalyst_execute(module)
        description = v2_internals._get_active_data_description()
        information = v2_internals.CatalystV1Information(description) if description else v2_internals.CatalystV2Information()
        breccia_extractors.name_files(information.time)
        return result

    return call


def _channel_of_source(name):
    """A source is named after its channel, or after the file of a recording that ParaView had opened: surface, surface.pvd."""
    return re.sub(r"^(\w+?)(_\d+)?\.\w+\*?$", r"\1", name or "")


def enter(name, script, folder, parameters, about):
    """Called before each execution of a pipeline."""
    global _error, _script
    _error = ""
    _script = script
    breccia_insitu.set_active(name, folder, parameters, about)
    breccia_output.enter(folder)
    directory = os.path.dirname(script)
    if directory not in sys.path:
        sys.path.append(directory)  # modules beside the script


def take_error():
    """One line of what went wrong since the last call, "" when nothing did."""
    global _error
    text, _error = _error, ""
    return text


def usable():
    """Whether ParaView can execute the script: not after a failure of its import or of its catalyst_initialize, on any rank, which leaves ParaView
    without the objects that an execution reads."""
    return _script not in _unusable


class ScriptFailed(Exception):
    """A script raised, on this rank or on another one."""


def _guarded(function, starts=False):
    """`starts`: without its success the script cannot be executed."""

    def call(*arguments):
        global _error
        result, text = None, ""
        try:
            result = function(*arguments)
        except BaseException as error:  # SystemExit and KeyboardInterrupt too: the solver decides when to end
            text = _described(error)
            breccia_output.record("".join(traceback.format_exception(type(error), error, error.__traceback__)))
        _spare_windows()
        if _agree(text):
            if starts:
                _unusable.add(_script)
            _error = _error or text  # nothing where only another rank has something to tell
            raise ScriptFailed(_error)
        return result

    return call


def _spare_windows():
    """Xlib ends a process whose server has closed, unless a handler is set for each connection; views connect when they are first drawn."""
    from paraview import servermanager
    from paraview.modules.vtkRemotingViews import vtkPVProcessWindow

    if servermanager.ActiveConnection is None:
        return
    views = servermanager.ProxyManager().GetProxiesInGroup("views").values()
    windows = [view.GetRenderWindow() for view in views if hasattr(view, "GetRenderWindow")]
    if any(windows):
        windows.append(vtkPVProcessWindow.GetRenderWindow())  # shares what the others draw with
    # Of windows that draw without X, it is something else.
    windows = [window for window in windows if window is not None and window.IsA("vtkXOpenGLRenderWindow")]
    for display in (window.GetGenericDisplayId() for window in windows):
        if display:
            _spare(int(display.split("_")[1], 16))


def _keep_unseen(kind, error, trace):
    global _error
    if kind is not ScriptFailed and not _error:
        _error = _described(error)


def _described(error):
    """ "TypeError: what (script.py:12)": the line of the script, or the deepest one when the script's own does not occur."""
    if isinstance(error, SyntaxError):
        place = (error.filename or "", error.lineno)
        message = error.msg
    else:
        frames = traceback.extract_tb(error.__traceback__)
        own = [frame for frame in frames if os.path.abspath(frame.filename) == _script] or frames
        place = (own[-1].filename, own[-1].lineno) if own else ("", 0)
        message = "called sys.exit" if isinstance(error, SystemExit) else _message_of(error)
    where = f" ({os.path.basename(place[0])}:{place[1]})" if place[0] else ""
    return " ".join(f"{type(error).__name__}: {message}{where}".split())


def _message_of(error):
    try:
        return str(error)
    except Exception:  # the script's own class
        return "an error without a text"
