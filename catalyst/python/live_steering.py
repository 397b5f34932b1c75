"""The panel by which the view of `breccia live` steers the run that it watches.

It is the source "Run" in ParaView's pipeline browser: its properties become requests to the run when Apply is pressed, as by
`breccia control`, with the same commands, and the view shows the answer. The run is the one whose folder comes with its data,
field data "run"; it must be on this machine.
"""

import os
import subprocess

from paraview import servermanager
from vtkmodules.vtkCommonDataModel import vtkPolyData

REQUESTS = ("", "pause", "resume", "extract", "frame", "stop")
NAME = "Run"
PATIENCE = "20"  # s, for the answer
PANEL = """<ServerManagerConfiguration><ProxyGroup name="sources">
<SourceProxy name="BrecciaRun" class="vtkPVTrivialProducer" label="Run">
<Documentation short_help="Requests to the run.">Requests to the run, sent when Apply is pressed.</Documentation>
<IntVectorProperty name="Request" label="Request" number_of_elements="1" default_values="0">
<EnumerationDomain name="enum"><Entry value="0" text="none"/><Entry value="1" text="pause"/><Entry value="2" text="resume"/>
<Entry value="3" text="extract now"/><Entry value="4" text="write a frame now"/><Entry value="5" text="stop, with a checkpoint"/>
</EnumerationDomain></IntVectorProperty>
<StringVectorProperty name="FrameInterval" label="Frame interval" number_of_elements="1" default_values="">
<Documentation>Simulated time between frames, such as 2 us; nothing: as it is.</Documentation></StringVectorProperty>
<StringVectorProperty name="Opening" label="Show cracks open by" number_of_elements="1" default_values="">
<Documentation>The view shows cracks that are open by more, such as 0.5 um; nothing: all. The run and its pipelines stay as they are: theirs stand in
the case.</Documentation>
</StringVectorProperty></SourceProxy></ProxyGroup></ServerManagerConfiguration>"""
LENGTHS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}


def length(text):
    """Metres, or None where a text is no length."""
    number, _, unit = text.strip().partition(" ")
    try:
        return float(number) * LENGTHS[unit.strip() or "m"]
    except (ValueError, KeyError):
        return None


def folder_of(data):
    """The run's folder in the field data of what it has sent, "" where there is none."""
    told = data.GetFieldData().GetArray("run")
    return bytes(told.GetValue(i) for i in range(told.GetNumberOfTuples())).decode() if told is not None else ""


class Steering:
    """@param program: breccia, "": the run is controlled elsewhere; say(line): shows a line; show_open_by(m or None): filters cracks"""

    def __init__(self, program, say, show_open_by):
        self._program, self._say, self._show_open_by = program, say, show_open_by
        self.folder = ""
        self._asked, self._waiting = None, []
        session = servermanager.ActiveConnection.Session
        session.GetSessionProxyManager().GetProxyDefinitionManager().LoadConfigurationXMLFromString(PANEL)
        manager = servermanager.ProxyManager()
        self.panel = servermanager._getPyProxy(manager.NewProxy("sources", "BrecciaRun"))
        self.panel.UpdateVTKObjects()
        self.panel.SMProxy.GetClientSideObject().SetOutput(vtkPolyData())
        manager.RegisterProxy("sources", NAME, self.panel.SMProxy)
        self._frame_interval = self._opening = ""

    def can_steer(self):
        return bool(self._program) and os.path.isabs(self.folder) and os.path.isdir(self.folder)

    def ask(self, command):
        """Sends one request after the other to the run."""
        if not self._program:
            self._say("this view was not opened by `breccia live` and cannot steer the run")
        elif not self.folder:
            self._say("no run has sent anything yet")
        elif not self.can_steer():
            self._say(f"{self.folder} is not on this machine; steer the run there, by breccia control")
        else:
            self._waiting.append((self.folder, command))

    def look(self):
        """Takes what was set in the panel and what the run has answered. The panel is taken when Apply has been pressed: then its values
        are those of the proxy."""
        self._take_panel()
        if self._asked is not None:
            command, process = self._asked
            if process.poll() is None:
                return
            lines = [line.strip() for line in process.communicate()[0].splitlines() if line.strip()]
            self._asked = None
            complaint = lines[-1].removeprefix("breccia: error: ").removeprefix(f"{command}: ") if lines else "failed"
            self._say(f"{command}: {'done' if process.returncode == 0 else complaint}")
        if self._waiting:
            folder, command = self._waiting.pop(0)
            # What is preloaded into ParaView is nothing to it.
            environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
            words = [self._program, "control", folder, *command.split(), "--patience", PATIENCE]
            try:
                process = subprocess.Popen(words, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                           text=True, errors="replace")
            except OSError as error:
                self._say(f"{command}: {error}")
                return
            self._asked = command, process
            self._say(f"requested: {command}")

    def _take_panel(self):
        proxy = self.panel.SMProxy
        asked = REQUESTS[proxy.GetProperty("Request").GetElement(0)]
        if asked:
            proxy.GetProperty("Request").SetElement(0, 0)
            proxy.UpdateVTKObjects()
            self.ask(asked)
        interval = proxy.GetProperty("FrameInterval").GetElement(0).strip()
        if interval != self._frame_interval:
            self._frame_interval = interval
            if interval:
                self.ask(f"frame_interval {interval}")
        opening = proxy.GetProperty("Opening").GetElement(0).strip()
        if opening != self._opening:
            self._opening = opening
            least = length(opening) if opening else None
            if opening and least is None:
                self._say(f"'{opening}' is no length; allowed: a number with one of {', '.join(LENGTHS)}")
            else:
                self._show_open_by(least)
                self._say(f"this view shows {'cracks open by more than ' + opening if opening else 'all cracks'}; the run and its pipelines stay as they are")
