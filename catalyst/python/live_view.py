"""The view that `breccia live` opens in ParaView.

Listens on $BRECCIA_LIVE_PORT for a run with --live, takes its channels as they come, and shows the surface by stress, cracks by the time at
which they opened, the boxes of the ranks, the run's time, and its energies. When the run ends the last picture stays; the next run that
connects takes its place. $BRECCIA_LIVE_TITLE, _END (s) and _STRENGTH (Pa) pass data of the run that the view has no other source for; _PROGRAM controls the run
(live_steering.py).
"""

import math
import os
import textwrap
import time as clock

from paraview import live
from paraview.simple import (Calculator, ColorBy, CreateView, GetActiveSource, GetActiveViewOrCreate, GetAnimationScene,
                             GetColorTransferFunction, GetLayout, GetScalarBar, Render, ResetCamera, SetActiveSource, SetActiveView, Show, Text,
                             Threshold, TrivialProducer)
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkObject
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable, vtkUnstructuredGrid

import breccia_pictures as pictures
import live_steering


def told(name, default):
    """Texts of `breccia live` about the run."""
    return os.environ.get(f"BRECCIA_LIVE_{name}", default)


PORT = int(told("PORT", "22222"))
TITLE = told("TITLE", "")
END = float(told("END", "0"))
STRENGTH = float(told("STRENGTH", "0"))
BETWEEN = 200  # ms, between two looks at the link
TOLD = 15.0  # s that an answer of the run stands in the view
WIDTH = 70  # letters of a line of it, beside the keys
EMPTY = {"surface": vtkPolyData, "fractures": vtkPolyData, "domains": vtkUnstructuredGrid, "history": vtkPolyData}
# Curves of the plot: columns of the history that are added, and colours.
CURVES = {"kinetic": (("kinetic [J]",), (0.15, 0.35, 0.75)), "elastic": (("elastic [J]", "joint elastic [J]"), (0.30, 0.62, 0.35)),
          "fracture": (("joint mode 1 [J]", "joint mode 2 [J]"), (0.78, 0.20, 0.22)),
          "friction": (("joint friction [J]", "contact friction [J]"), (0.85, 0.55, 0.15))}


class Plot:
    """Curves of energies over time, beside the bodies, from the rows of the history that have come."""

    def __init__(self, beside):
        self._table = vtkTable()
        for name in ("time", *CURVES):
            column = vtkDoubleArray()
            column.SetName(name)
            self._table.AddColumn(column)
        self.view = CreateView("XYChartView")
        self.view.LeftAxisTitle = "energy [J]"
        GetLayout(beside).SplitViewHorizontal(beside, 0.68)
        GetLayout(beside).AssignView(2, self.view)
        self._source = TrivialProducer(registrationName="energies")
        self._shown = None
        self._unit, self._size = pictures.unit_of(END or 1e-3, "s")
        self.view.BottomAxisTitle = f"time [{self._unit}]"

    def add(self, row):
        """The history's latest row, as the values of a point; or no point."""
        if row.GetNumberOfCells() == 0:
            return

        def sum_of(columns):
            arrays = (row.GetCellData().GetArray(name) for name in columns)
            return sum(array.GetTuple1(0) for array in arrays if array is not None)

        time = sum_of(("time [s]",)) / self._size
        rows = self._table.GetNumberOfRows()
        if rows > 0 and time < self._table.GetValue(rows - 1, 0).ToDouble():
            self._table.SetNumberOfRows(0)  # another run
        elif rows > 0 and time == self._table.GetValue(rows - 1, 0).ToDouble():
            return
        for i, value in enumerate([time] + [sum_of(columns) for columns, colour in CURVES.values()]):
            self._table.GetColumn(i).InsertNextValue(value)
        copy = vtkTable()
        copy.DeepCopy(self._table)
        self._source.GetClientSideObject().SetOutput(copy)
        self._source.MarkModified(self._source.SMProxy)
        if copy.GetNumberOfRows() > 1:  # a curve
            self._shown = self._shown or self._show()
            Render(self.view)

    def _show(self):
        shown = Show(self._source, self.view, "XYChartRepresentation")
        shown.UseIndexForXAxis = 0
        shown.XArrayName = "time"
        shown.SeriesVisibility = list(CURVES)
        shown.SeriesColor = [text for name, (columns, colour) in CURVES.items() for text in (name, *map(str, colour))]
        shown.SeriesLineThickness = [text for name in CURVES for text in (name, "3")]
        return shown


class Bodies:
    """The bodies by stress, cracks by age, boxes of the ranks, and words."""

    def __init__(self):
        self.view = GetActiveViewOrCreate("RenderView")
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [1, 1, 1]
        self.sources = {name: TrivialProducer(registrationName=name) for name in EMPTY}
        for name, kind in EMPTY.items():
            self._put(name, kind())
        self._stresses = pictures.Range("colours", "Pa", 0.0, STRENGTH)
        self._ages = pictures.Range("colours", "s", END, 0.0)
        self._words = self._text("")
        self._words.WindowLocation = "Upper Left Corner"
        self._placed = False
        self._lines, self._told = (), ("", 0.0)
        self._open = None
        self.say("waiting for a run: breccia run CASE.toml --live" + ("" if PORT == 22222 else f"=localhost:{PORT}"))

    def _text(self, text):
        self._source = Text(registrationName="words", Text=text)
        shown = Show(self._source, self.view)
        shown.Color, shown.FontSize, shown.Justification = pictures.INK, 16, "Left"
        return shown

    def say(self, *lines):
        self._lines = lines
        self.add("")

    def add(self, line):
        """A further line, until it is replaced."""
        told, until = self._told
        self._source.Text = "\n".join(filter(None, (TITLE, *self._lines, line, told if clock.time() < until else "")))

    def tell(self, line):
        """A line that remains for a while beside the others."""
        self._told = textwrap.fill(line, WIDTH), clock.time() + TOLD
        self.add("")
        Render(self.view)

    def _put(self, name, data):
        self.sources[name].GetClientSideObject().SetOutput(data)
        self.sources[name].MarkModified(self.sources[name].SMProxy)

    def take(self, channels, time, step):
        """@param channels: name -> data that have come"""
        for name, data in channels.items():
            self._put(name, data)
        if not self._placed:
            if pictures.data_of(self.sources["surface"]).GetNumberOfCells() == 0:
                return
            self._placed, active = True, GetActiveSource()
            self._build()
            self._place_camera()
            SetActiveSource(active)
        stresses, ages = self._tables
        self._stresses.include(pictures.quantile_of(self.sources["surface"], "von_mises", 0.99), time)
        pictures.table_range(stresses, 0.0, self._stresses.upper / self._size_of_stress)
        pictures.table_range(ages, 0.0, self._ages.include(time, time) / self._size_of_age)
        broken = pictures.cells_of(self.sources["fractures"])
        ranks = pictures.cells_of(self.sources["domains"])
        self.say(f"t = {pictures.quantity(time, 's')}, step {step:,}", f"{broken:,} broken joints, {ranks} rank{'s' if ranks != 1 else ''}",
                 self._stresses.news())

    def _build(self):
        unit, self._size_of_stress = pictures.unit_of(self._stresses.upper or 1e6, "Pa")
        stress = Calculator(registrationName="stress", Input=self.sources["surface"], AttributeType=1,
                            ResultArrayName=f"von Mises stress [{unit}]", Function=f"von_mises/{self._size_of_stress!r}")
        unit, self._size_of_age = pictures.unit_of(self._ages.upper or 1e-6, "s")
        cracks = Calculator(registrationName="cracks", Input=self.sources["fractures"], AttributeType=1,
                            ResultArrayName=f"time of failure [{unit}]", Function=f"time_of_failure/{self._size_of_age!r}")
        self._cracks = cracks
        self._tables = (self._coloured(stress, pictures.SEQUENTIAL, 0.56, "Surface"), self._coloured(cracks, pictures.AGES, 0.08, "Wireframe", 4.0))
        boxes = Show(self.sources["domains"], self.view)
        boxes.SetRepresentationType("Wireframe")
        boxes.ColorArrayName = ["POINTS", ""]
        boxes.DiffuseColor = boxes.AmbientColor = pictures.INK
        boxes.LineWidth = 2.0

    def show_open_by(self, least):
        """Of the cracks those that are open by more than so many metres; None: all."""
        if not self._placed:
            return
        active = GetActiveSource()
        if least is None:
            self._cracks.Input = self.sources["fractures"]
        else:
            self._open = self._open or Threshold(registrationName="open cracks", Input=self.sources["fractures"], Scalars=["CELLS", "opening"])
            self._open.ThresholdMethod = "Above Upper Threshold"
            self._open.UpperThreshold = least
            self._cracks.Input = self._open
        SetActiveSource(active)
        Render(self.view)

    def _place_camera(self):
        azimuth, elevation = math.radians(38.0), math.radians(32.0)
        self.view.CameraParallelProjection = 1
        self.view.CameraPosition = [math.sin(azimuth) * math.cos(elevation), math.sin(elevation), math.cos(azimuth) * math.cos(elevation)]
        self.view.CameraFocalPoint = [0, 0, 0]
        self.view.CameraViewUp = [0, 1, 0]
        ResetCamera(self.view)
        # Words stand above and keys on the right.
        scale = self.view.CameraParallelScale = 1.15 * self.view.CameraParallelScale
        move = [0.22 * scale * math.cos(azimuth), 0.08 * scale, -0.22 * scale * math.sin(azimuth)]
        for name in ("CameraPosition", "CameraFocalPoint"):
            setattr(self.view, name, [old + new for old, new in zip(getattr(self.view, name), move)])

    def _coloured(self, source, colours, height, representation, width=1.0):
        array = source.ResultArrayName
        shown = Show(source, self.view)
        shown.SetRepresentationType(representation)
        shown.LineWidth = width
        ColorBy(shown, ("CELLS", array))
        shown.Ambient, shown.Diffuse = 0.3, 0.75
        table = GetColorTransferFunction(array)
        table.AutomaticRescaleRangeMode = "Never"
        table.ColorSpace = "RGB"
        table.RGBPoints = colours
        bar = GetScalarBar(table, self.view)
        bar.Title, bar.ComponentTitle = array, ""
        bar.TitleColor = bar.LabelColor = pictures.INK
        bar.AutomaticLabelFormat = 0
        bar.LabelFormat = bar.RangeLabelFormat = "%g"
        bar.WindowLocation = "Any Location"
        bar.Position, bar.ScalarBarLength = [0.86, height], 0.36
        shown.SetScalarBarVisibility(self.view, True)
        return table


class Link:
    """The link to a run, made anew whenever it has ended."""

    def __init__(self, bodies, plot):
        self._bodies, self._plot = bodies, plot
        self.steering = live_steering.Steering(told("PROGRAM", ""), bodies.tell, bodies.show_open_by)
        self._listen()

    def _listen(self):
        self._extracts, self._seen, self._closed, self._pauses = {}, {}, False, False
        self.link = live.ConnectToCatalyst("localhost", PORT)
        self.link.AddObserver("ConnectionClosedEvent", self._close)

    def _close(self, *_):
        self._closed = True

    def look(self, *_):
        """Reads the data that the run has sent since the last call."""
        warns = vtkObject.GetGlobalWarningDisplay()
        vtkObject.GlobalWarningDisplayOff()  # a run that ends is no error
        try:
            self.steering.look()
            self._look()
        finally:
            vtkObject.SetGlobalWarningDisplay(warns)

    def _look(self):
        live.ProcessServerNotifications()
        if self._closed:
            self._bodies.add("the run has ended; waiting for the next one")
            Render(self._bodies.view)
            self._listen()
            return
        proxies = self.link.GetInsituProxyManager()
        if proxies is None or proxies.GetNumberOfProxies("sources") == 0:
            return
        if not self._extracts:
            self._extracts = {name: self.link.CreateExtract("sources", name, 0) for name in EMPTY if proxies.GetProxy("sources", name) is not None}
        self._take(self._news())

    def pause(self, pause):
        """Pauses the run at its next update, or resumes it."""
        if self.link.GetInsituProxyManager() is None:
            return
        if self.steering.can_steer():
            self.steering.ask("pause" if pause else "resume")
            return
        live.PauseCatalyst(self.link, pause)
        self._pauses = pause
        self._bodies.add("the run pauses" if pause else "")
        Render(self._bodies.view)

    def _news(self):
        news = {}
        for name, extract in self._extracts.items():
            extract.GetClientSideObject().Update()
            data = extract.GetClientSideObject().GetOutputDataObject(0)
            if not isinstance(data, EMPTY[name]) or data.GetMTime() == self._seen.get(name):
                continue  # it has not come yet, or nothing is new
            self._seen[name] = data.GetMTime()
            news[name] = data.NewInstance()
            news[name].ShallowCopy(data)
        return news

    def _take(self, news):
        if not news:
            return
        self.steering.folder = next(filter(None, map(live_steering.folder_of, news.values())), "")
        values = {name: next((data.GetFieldData().GetArray(name).GetTuple1(0) for data in news.values()
                              if data.GetFieldData().GetArray(name) is not None), 0.0) for name in ("TimeValue", "step")}
        SetActiveView(self._bodies.view)
        self._bodies.take(news, values["TimeValue"], int(values["step"]))
        if self._pauses:
            self._bodies.add("the run pauses")  # what was under way still comes
        scene = GetAnimationScene()
        scene.StartTime, scene.EndTime = 0.0, END or values["TimeValue"] or 1.0
        scene.AnimationTime = values["TimeValue"]
        Render(self._bodies.view)
        if "history" in news:
            self._plot.add(news["history"])
            SetActiveView(self._bodies.view)


def start():
    """The view, in a window of ParaView; polls the connection while the window is open."""
    global link
    bodies = Bodies()
    link = Link(bodies, Plot(bodies.view))
    SetActiveView(bodies.view)
    SetActiveSource(link.steering.panel)
    Render(bodies.view)
    interactor = bodies.view.GetInteractor()
    interactor.AddObserver("TimerEvent", link.look)
    interactor.CreateRepeatingTimer(BETWEEN)


link = None  # of the view that was started
