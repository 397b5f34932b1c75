"""What Breccia's picture pipelines share: the look of a view, where its camera stands, words over it, sums over ranks.

Parameters of every picture: width, height (pixels), azimuth, elevation (degrees, from the front: along -z, y up), zoom, and orbit: so many
pictures around the model, as a Cinema database (data.csv names every picture); 0: one picture.
"""

import math
import os
import re

from paraview.simple import ColorBy, CreateExtractor, CreateRenderView, GetColorTransferFunction, GetScalarBar, SetActiveView, Show, Text, Threshold
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

import breccia_insitu

INK = [0.13, 0.14, 0.17]
STONE = [0.82, 0.83, 0.85]
FRACTURE = [0.25, 0.26, 0.30]
# Position and red, green, blue, from weak to strong: light enough everywhere for dark cracks to stand out.
SEQUENTIAL = [0.00, 0.93, 0.94, 0.95, 0.20, 0.72, 0.84, 0.91, 0.45, 0.45, 0.68, 0.82, 0.65, 0.98, 0.85, 0.55, 0.85, 0.95, 0.55, 0.35,
              1.00, 0.80, 0.22, 0.24]
AGES = [0.00, 0.27, 0.00, 0.33, 0.35, 0.20, 0.41, 0.55, 0.65, 0.13, 0.57, 0.55, 0.85, 0.55, 0.78, 0.30, 1.00, 0.99, 0.80, 0.10]


def over_ranks(value, operation=vtkCommunicator.SUM_OP):
    """Sum (or another reduction) of a number over all ranks, on all of them."""
    controller = vtkMultiProcessController.GetGlobalController()
    if controller is None or controller.GetNumberOfProcesses() == 1:
        return value
    mine, all_ranks = vtkDoubleArray(), vtkDoubleArray()
    mine.InsertNextValue(value)
    all_ranks.InsertNextValue(0)
    controller.AllReduce(mine, all_ranks, operation)
    return all_ranks.GetValue(0)


def largest(value):
    return over_ranks(value, vtkCommunicator.MAX_OP)


def data_of(producer):
    """The channel's data on this rank."""
    return producer.GetClientSideObject().GetOutputDataObject(0)


def cells_of(producer):
    """Cells of a channel on all ranks."""
    return int(over_ranks(data_of(producer).GetNumberOfCells()))


def bounds_of(producer):
    """Lowest and highest corner of a channel's box over all ranks; low > high when it is empty everywhere."""
    data = data_of(producer)
    bounds = data.GetBounds() if data.GetNumberOfPoints() > 0 else (1e300, -1e300) * 3
    return [-largest(-bounds[2 * i]) for i in range(3)], [largest(bounds[2 * i + 1]) for i in range(3)]


def quantity(value, unit):
    """1.2e-5, "s" -> "12 µs" """
    if value == 0 or not math.isfinite(value):
        return f"{value:g} {unit}"
    for prefix, size in (("G", 1e9), ("M", 1e6), ("k", 1e3), ("", 1.0), ("m", 1e-3), ("\u00b5", 1e-6), ("n", 1e-9)):
        if abs(value) >= size * 0.9999:
            return f"{value / size:.4g} {prefix}{unit}"
    return f"{value:.3g} {unit}"


class Picture:
    """A view, and the extractor that writes it as folder/NAME_000000123.png."""

    def __init__(self):
        self.view = CreateRenderView()
        self.view.ViewSize = [breccia_insitu.parameter("width", 1600), breccia_insitu.parameter("height", 1000)]
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [1, 1, 1]
        self.view.OrientationAxesVisibility = 0
        self.view.CameraParallelProjection = 1
        SetActiveView(self.view)
        self._placed = False
        self._words = Text()
        words = Show(self._words, self.view)
        words.WindowLocation = "Upper Left Corner"
        words.Color = INK
        words.Justification = "Left"
        words.FontSize = max(8, self.view.ViewSize[1] // 45)
        self._name = name = breccia_insitu.pipeline() or "picture"
        self._times = {}
        self.extractor = CreateExtractor("PNG", self.view)
        self.extractor.Trigger = "TimeStep"
        self.extractor.Writer.FileName = name + "_{timestep:09d}{camera}.png"
        self.extractor.Writer.ImageResolution = self.view.ViewSize
        orbit = breccia_insitu.parameter("orbit", 0)
        if orbit > 0:
            self.extractor.Writer.CameraMode = "Phi-Theta"
            self.extractor.Writer.PhiResolution = orbit
            self.extractor.Writer.ThetaResolution = max(2, orbit // 2)
        else:
            self.extractor.Writer.FileName = name + "_{timestep:09d}.png"

    def solid(self, producer, colour):
        shown = Show(producer, self.view)
        shown.ColorArrayName = ["POINTS", ""]
        shown.DiffuseColor = shown.AmbientColor = colour
        shown.Ambient, shown.Diffuse = 0.3, 0.75
        return shown

    def opened(self, surface):
        """Shows the bodies as shells whose near side is left out, so that one looks at what is inside. Nothing here is translucent:
        ranks would have to trade their geometry for it, which takes long and fails with the XML parser of Debian 12 (expat)."""
        outside = Threshold(Input=surface, Scalars=["CELLS", "crack"], LowerThreshold=0, UpperThreshold=0.5, ThresholdMethod="Between")
        self.solid(outside, STONE).BackfaceRepresentation = "Cull Frontface"

    def coloured(self, producer, array, colours, title, label="%-#6.3g"):
        """Shows cells in the colours of an array; with a bar. Returns the colour table, whose range is the caller's."""
        shown = Show(producer, self.view)
        ColorBy(shown, ("CELLS", array))
        shown.Ambient, shown.Diffuse = 0.3, 0.75
        table = GetColorTransferFunction(array)
        table.AutomaticRescaleRangeMode = "Never"
        table.ColorSpace = "RGB"
        table.RGBPoints = colours
        if title is not None:
            bar = GetScalarBar(table, self.view)
            bar.Title, bar.ComponentTitle = title, ""
            bar.TitleColor = bar.LabelColor = INK
            bar.RangeLabelFormat = bar.LabelFormat = label
            bar.AutomaticLabelFormat = 0
            bar.WindowLocation = "Any Location"
            bar.Position = [0.88, 0.2]
            bar.ScalarBarLength = 0.6
            shown.SetScalarBarVisibility(self.view, True)
        return table

    def lines(self, producer, colour=INK, width=2.0):
        shown = Show(producer, self.view)
        shown.SetRepresentationType("Wireframe")
        shown.ColorArrayName = ["POINTS", ""]
        shown.DiffuseColor = shown.AmbientColor = colour
        shown.LineWidth = width
        return shown

    def say(self, info, *lines):
        """The time and other words in the corner of the picture that is drawn next."""
        self._words.Text = "\n".join(("t = " + quantity(info.time, "s"),) + lines)
        self.list_pictures()
        self._times[info.timestep] = info.time

    def list_pictures(self):
        """Writes data.csv, which makes the folder a Cinema database (specification D): the pictures that are complete."""
        controller = vtkMultiProcessController.GetGlobalController()
        if controller is not None and controller.GetLocalProcessId() > 0:
            return
        folder = breccia_insitu.folder()
        pattern = re.compile(re.escape(self._name) + r"_(\d{9})(\D*([-\d.]+)\D+([-\d.]+)\D*)?\.png")
        found = (match for match in map(pattern.fullmatch, sorted(os.listdir(folder))) if match)
        rows = [(self._times[int(m[1])], m[3], m[4], m[0]) for m in found if int(m[1]) in self._times]
        turns = any(row[1] for row in rows)
        lines = ["time,phi,theta,FILE" if turns else "time,FILE"]
        lines += [f"{time!r},{phi},{theta},{file}" if turns else f"{time!r},{file}" for time, phi, theta, file in rows]
        temporary = os.path.join(folder, ".data.csv.tmp")
        with open(temporary, "w", encoding="utf-8") as table:
            table.write("\n".join(lines) + "\n")
            table.flush()
            os.fsync(table.fileno())
        os.replace(temporary, os.path.join(folder, "data.csv"))

    def place_camera(self, producer):
        """Where the parameters say, so that the channel is seen whole; once, so that pictures can be laid over each other."""
        if self._placed:
            return
        low, high = bounds_of(producer)
        if low[0] > high[0]:
            return  # nothing to see yet
        self._placed = True
        azimuth = math.radians(breccia_insitu.parameter("azimuth", 38.0))
        elevation = math.radians(breccia_insitu.parameter("elevation", 32.0))
        towards = [math.sin(azimuth) * math.cos(elevation), math.sin(elevation), math.cos(azimuth) * math.cos(elevation)]
        up = [-math.sin(azimuth) * math.sin(elevation), math.cos(elevation), -math.cos(azimuth) * math.sin(elevation)]
        right = [math.cos(azimuth), 0.0, -math.sin(azimuth)]
        # The shadow of a box on an axis is the sum of the shadows of its edges.
        wide, tall = (sum(abs(axis[i]) * (high[i] - low[i]) for i in range(3)) for axis in (right, up))
        aspect = self.view.ViewSize[0] / self.view.ViewSize[1]
        scale = 0.5 * max(tall / 0.85, wide / (0.80 * aspect)) / breccia_insitu.parameter("zoom", 1.0)
        shift = 0.06 * aspect * 2 * scale  # the bar of the colours stands on the right
        centre = [(low[i] + high[i]) / 2 + shift * right[i] for i in range(3)]
        distance = 4 * max(high[i] - low[i] for i in range(3))
        self.view.CameraFocalPoint = centre
        self.view.CameraPosition = [centre[i] + distance * towards[i] for i in range(3)]
        self.view.CameraViewUp = up
        self.view.CameraParallelScale = scale
        self.view.CenterOfRotation = centre


def table_range(table, low, high):
    if high <= low:
        high = low + (abs(low) or 1.0)
    table.RescaleTransferFunction(low, high)
