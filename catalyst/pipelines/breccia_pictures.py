"""Common parts of Breccia's picture pipelines: style of a view, camera position, captions, ranges of colours, sums over ranks.

A picture shows its case, subject, time and step, a colour bar and a length scale. The colour range is the same in all pictures of a
run; where it had to grow, a caption states since when. Parameters of every picture: width, height (pixels), azimuth, elevation
(degrees, from the front: along -z, y up), zoom, and orbit: so many pictures around the model, as a Cinema database (data.csv names every
picture); 0: one picture.
"""

import math
import os
import re
import stat

import numpy
from paraview.simple import (ColorBy, CreateExtractor, CreateRenderView, GetColorTransferFunction, GetScalarBar, Line, SetActiveView, Show, Text,
                             Threshold)
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

import breccia_insitu

INK = [0.13, 0.14, 0.17]
STONE = [0.82, 0.83, 0.85]
STONES = [0.0, *STONE, 1.0, 0.60, 0.66, 0.76]  # of the first body and of the last: one stands out before the other
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
    data = producer.GetClientSideObject().GetOutputDataObject(0)
    if not data.IsA("vtkPartitionedDataSet"):
        return data
    # Catalyst 2: a part for each domain of the rank, which is one.
    return data.GetPartition(0) if data.GetNumberOfPartitions() > 0 and data.GetPartition(0) is not None else vtkUnstructuredGrid()


def quantile_of(producer, array, part):
    """The value of a cell array below which a part of the cells of all ranks lies, up to a twelfth; 0 without positive values. Values that
    are not finite are left out, lest the rank that has them fails alone while the others wait for its counts."""
    values = data_of(producer).GetCellData().GetArray(array)
    mine = numpy.zeros(0) if values is None or values.GetNumberOfTuples() == 0 else vtk_to_numpy(values)
    mine = mine[numpy.isfinite(mine)]
    lowest, highest, bins_of_octave = -40, 60, 8  # powers of two; what is smaller counts as smallest
    positive = numpy.maximum(mine, 2.0 ** lowest) if len(mine) else mine
    bins = numpy.clip(numpy.ceil((numpy.log2(positive) - lowest) * bins_of_octave), 0, (highest - lowest) * bins_of_octave).astype(int)
    counts = sums_over_ranks(numpy.bincount(bins, minlength=(highest - lowest) * bins_of_octave + 1).astype(float))
    if counts.sum() == 0:
        return 0.0
    place = int(numpy.searchsorted(numpy.cumsum(counts), part * counts.sum()))
    return 0.0 if place == 0 else 2.0 ** (lowest + place / bins_of_octave)


def sums_over_ranks(values):
    """Element by element."""
    controller = vtkMultiProcessController.GetGlobalController()
    if controller is None or controller.GetNumberOfProcesses() == 1:
        return values
    mine, all_ranks = vtkDoubleArray(), vtkDoubleArray()
    for value in values:
        mine.InsertNextValue(value)
        all_ranks.InsertNextValue(0)
    controller.AllReduce(mine, all_ranks, vtkCommunicator.SUM_OP)
    return vtk_to_numpy(all_ranks).copy()


def cells_of(producer):
    """Cells of a channel on all ranks."""
    return int(over_ranks(data_of(producer).GetNumberOfCells()))


def bounds_of(producer):
    """Lowest and highest corner of a channel's box over all ranks; low > high when it is empty everywhere."""
    data = data_of(producer)
    bounds = data.GetBounds() if data.GetNumberOfPoints() > 0 else (1e300, -1e300) * 3
    return [-largest(-bounds[2 * i]) for i in range(3)], [largest(bounds[2 * i + 1]) for i in range(3)]


PREFIXES = (("G", 1e9), ("M", 1e6), ("k", 1e3), ("", 1.0), ("m", 1e-3), ("\u00b5", 1e-6), ("n", 1e-9))


def unit_of(value, unit):
    """The unit in which a value has one to three digits before its point, and what it is: 1.2e-5, "s" -> ("µs", 1e-6)"""
    for prefix, size in PREFIXES:
        if abs(value) >= size * 0.9999:
            return prefix + unit, size
    return unit, 1.0


def quantity(value, unit):
    """1.2e-5, "s" -> "12 µs" """
    if value == 0 or not math.isfinite(value):
        return f"{value:g} {unit}"
    name, size = unit_of(value, unit)
    return f"{value / size:.4g} {name}"


def round_above(value):
    """The smallest of 1, 2, 5, 10, ... (and their tenths, ...) that is not below a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1, 2, 5, 10) if step * power >= value * (1 - 1e-9))


class Range:
    """The upper end of colours (or lengths) that mean the same over a run: given, or a round number that grows, in words, when it must."""

    def __init__(self, name, unit, given, least):
        self._name, self._unit, self._given = name, unit, given
        self.upper = given or (round_above(least) if least > 0 else 0.0)
        self._since = None

    def include(self, value, time):
        if not self._given and value > self.upper:
            self._since = time if self.upper > 0 else None
            self.upper = round_above(value)
        return self.upper or 1.0

    def news(self):
        """A line with the time since which the range is the present one; "" if it has not changed."""
        return "" if self._since is None else f"{self._name} up to {quantity(self.upper, self._unit)} since t = {quantity(self._since, 's')}"


class Picture:
    """A view, and the extractor that writes it as folder/NAME_000000123.png.

    @param subject  what it shows, in words
    @param copies   how often it shows the model, beside or below each other: solid(..., copy=1) is in the second one"""

    def __init__(self, subject, copies=()):
        self.view = CreateRenderView()
        self.view.ViewSize = [breccia_insitu.parameter("width", 1600), breccia_insitu.parameter("height", 1000)]
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [1, 1, 1]
        self.view.OrientationAxesVisibility = 0
        self.view.CameraParallelProjection = 1
        SetActiveView(self.view)
        self._subject = subject
        self._copies, self._moved = copies, []
        self._size = max(9, self.view.ViewSize[1] // 38)  # of letters, pixels
        self._placed = False
        self._bodies = None
        self._keys = []
        self._orbit = orbit = breccia_insitu.parameter("orbit", 0)
        self._title = self.words("", 1.15, bold=True)
        self._lines = self.words("")
        self._names = [self.words("") for _ in copies]
        self._scale, self._scale_words = Line(), self.words("")
        self.line_of(self._scale, INK)
        self._name = name = breccia_insitu.pipeline() or "picture"
        self._times = {}
        self.extractor = CreateExtractor("PNG", self.view)
        self.extractor.Trigger = "TimeStep"
        self.extractor.Writer.FileName = name + "_{timestep:09d}{camera}.png"
        self.extractor.Writer.ImageResolution = self.view.ViewSize
        if orbit > 0:
            self.extractor.Writer.CameraMode = "Phi-Theta"
            self.extractor.Writer.PhiResolution = orbit
            self.extractor.Writer.ThetaResolution = max(2, orbit // 2)
        else:
            self.extractor.Writer.FileName = name + "_{timestep:09d}.png"

    def words(self, text, size=1.0, colour=INK, bold=False):
        """Caption over the picture; stand(...) sets its position. Returns the text and its representation."""
        source = Text(Text=text)
        shown = Show(source, self.view)
        shown.WindowLocation = "Any Location"
        shown.Color, shown.Bold = colour, int(bold)
        shown.Justification = "Left"
        shown.FontSize = int(self._size * size)
        return source, shown

    def stand(self, words, text, x, y):
        """Puts words with their lower left corner at x, y, parts of the picture's width and height."""
        words[0].Text = text
        words[1].Position = [x, y]

    def line_of(self, source, colour, width=4.0):
        """A line of the length scale or of a key; not in an orbit, in which it would stand in the model."""
        shown = Show(source, self.view)
        shown.Visibility = int(self._orbit == 0)
        shown.ColorArrayName = ["POINTS", ""]
        shown.DiffuseColor = shown.AmbientColor = colour
        shown.Ambient, shown.Diffuse = 1.0, 0.0
        shown.LineWidth = width
        return shown

    def solid(self, producer, colour, copy=0):
        shown = Show(producer, self.view)
        shown.ColorArrayName = ["POINTS", ""]
        shown.DiffuseColor = shown.AmbientColor = colour
        shown.Ambient, shown.Diffuse = 0.3, 0.75
        self._in_copy(shown, copy)
        return shown

    def bodies(self, surface):
        """Shows bodies in a shade each, as two of the same orientation could not be distinguished otherwise."""
        self._bodies = surface, self.coloured(surface, "body", STONES, None)

    def _shade_bodies(self):
        surface, table = self._bodies
        last = largest(data_of(surface).GetCellData().GetArray("body").GetRange()[1] if data_of(surface).GetNumberOfCells() > 0 else 0.0)
        table.RescaleTransferFunction(0.0, max(last, 1.0))

    def _in_copy(self, shown, copy):
        if copy > 0:
            self._moved.append((shown, copy))

    def opened(self, surface, copy=0):
        """Shows the bodies as shells without their near side, so that the inside is visible. Nothing here is translucent:
        ranks would have to trade their geometry for it, which takes long and fails with the XML parser of Debian 12 (expat)."""
        self.solid(outside(surface), STONE, copy).BackfaceRepresentation = "Cull Frontface"

    def coloured(self, producer, array, colours, title, label="%g", copy=0):
        """Shows cells in the colours of an array; with a bar. Returns the colour table, whose range is the caller's."""
        shown = Show(producer, self.view)
        ColorBy(shown, ("CELLS", array))
        shown.Ambient, shown.Diffuse = 0.3, 0.75
        self._in_copy(shown, copy)
        table = GetColorTransferFunction(array)
        table.AutomaticRescaleRangeMode = "Never"
        table.ColorSpace = "RGB"
        table.RGBPoints = colours
        if title is not None:
            self.bar(shown, table, title, label)
        return table

    def bar(self, shown, table, title, label="%g"):
        bar = GetScalarBar(table, self.view)
        bar.Title, bar.ComponentTitle = title, ""
        bar.TitleColor = bar.LabelColor = INK
        bar.TitleFontSize = bar.LabelFontSize = self._size
        bar.RangeLabelFormat = bar.LabelFormat = label
        bar.AutomaticLabelFormat = 0
        bar.ScalarBarThickness = self._size
        bar.WindowLocation = "Any Location"
        bar.Position = [0.87, 0.2]
        bar.ScalarBarLength = 0.6
        shown.SetScalarBarVisibility(self.view, True)

    def coloured_lines(self, producer, array, copy=0, width=3.0):
        """The edges of cells in the colours that coloured(...) has given the array."""
        shown = Show(producer, self.view)
        shown.SetRepresentationType("Wireframe")
        ColorBy(shown, ("CELLS", array))
        shown.Ambient, shown.Diffuse = 1.0, 0.0
        shown.LineWidth = width
        self._in_copy(shown, copy)
        return shown

    def lines(self, producer, colour=INK, width=2.0, copy=0):
        shown = Show(producer, self.view)
        shown.SetRepresentationType("Wireframe")
        shown.ColorArrayName = ["POINTS", ""]
        shown.DiffuseColor = shown.AmbientColor = colour
        shown.LineWidth = width
        self._in_copy(shown, copy)
        return shown

    def key(self, colour):
        """A key beside the length scale: a line of that colour with words of what its length means, which set_keys(...) gives."""
        line, words = Line(), self.words("", colour=colour)
        self.line_of(line, colour, 6.0)
        self._keys.append((line, words))

    def say(self, info, *lines):
        """Case, subject, time, step and other lines, over the picture that is drawn next; empty lines are left out."""
        title = breccia_insitu.parameter("title", "") or breccia_insitu.title() or self._name
        most = int(1.6 * self.view.ViewSize[0] / (1.15 * self._size))
        self.stand(self._title, title if len(title) <= most else title[: most - 1] + "\u2026", 0.015, 1 - self._height(1.7))
        text = [self._subject, f"t = {quantity(info.time, 's')}, step {info.timestep:,}", *filter(None, lines)]
        self.stand(self._lines, "\n".join(text), 0.015, 1 - self._height(1.9 + 1.25 * len(text)))
        self.list_pictures()
        self._times[info.timestep] = info.time

    def _height(self, lines):
        return lines * self._size / self.view.ViewSize[1]

    def list_pictures(self):
        """Writes data.csv, which makes the folder a Cinema database (specification D): the pictures that are complete."""
        controller = vtkMultiProcessController.GetGlobalController()
        if controller is not None and controller.GetLocalProcessId() > 0:
            return
        folder = breccia_insitu.folder()
        pattern = re.compile(re.escape(self._name) + r"_(\d{9})(\D*([-\d.]+)\D+([-\d.]+)\D*)?\.png")
        if not self._times:
            self._times = listed_times(os.path.join(folder, "data.csv"), pattern)
        found = (match for match in map(pattern.fullmatch, sorted(os.listdir(folder))) if match)
        rows = [(self._times[int(m[1])], m[3], m[4], m[0]) for m in found if int(m[1]) in self._times]
        turns = any(row[1] for row in rows)
        lines = ["time,phi,theta,FILE" if turns else "time,FILE"]
        lines += [f"{time!r},{phi},{theta},{file}" if turns else f"{time!r},{file}" for time, phi, theta, file in rows]
        temporary = os.path.join(folder, ".data.csv.tmp")
        if os.path.lexists(temporary):  # of a run that was killed, or a link that somebody put there
            os.unlink(temporary)
        with open(temporary, "x", encoding="utf-8") as table:
            table.write("\n".join(lines) + "\n")
            table.flush()
            os.fsync(table.fileno())
        os.replace(temporary, os.path.join(folder, "data.csv"))

    def place_camera(self, producer):
        """Places the camera by the parameters so that the whole channel is visible; once, so that pictures can be compared."""
        if self._placed:
            return
        low, high = bounds_of(producer)
        if low[0] > high[0]:
            return  # nothing to see yet
        self._placed = True
        if self._bodies is not None:
            self._shade_bodies()
        azimuth = math.radians(breccia_insitu.parameter("azimuth", 38.0))
        elevation = math.radians(breccia_insitu.parameter("elevation", 32.0))
        towards = numpy.array([math.sin(azimuth) * math.cos(elevation), math.sin(elevation), math.cos(azimuth) * math.cos(elevation)])
        up = numpy.array([-math.sin(azimuth) * math.sin(elevation), math.cos(elevation), -math.cos(azimuth) * math.sin(elevation)])
        right = numpy.array([math.cos(azimuth), 0.0, -math.sin(azimuth)])
        # The shadow of a box on an axis is the sum of the shadows of its edges.
        wide, tall = (sum(abs(axis[i]) * (high[i] - low[i]) for i in range(3)) for axis in (right, up))
        aspect = self.view.ViewSize[0] / self.view.ViewSize[1]
        # Words stand above, the length scale below, the bar of the colours on the right: what is left, in parts of the height.
        below, above, rim = self._height(3.2), self._height(7.5), 0.02 * aspect
        room = (0.84 * aspect - 2 * rim, 1 - below - above)
        count = max(1, len(self._copies))
        beside = max(1.06 * count * wide / room[0], tall / room[1])
        stacked = max(wide / room[0], 1.12 * count * tall / room[1])
        whole = min(beside, stacked) / breccia_insitu.parameter("zoom", 1.0)  # the picture's height, m
        step = 1.06 * wide * right if beside <= stacked else -1.12 * tall * up
        centre = (numpy.array(low) + high) / 2 + 0.5 * (count - 1) * step
        focus = centre + (0.5 * aspect - (rim + room[0] / 2)) * whole * right + (0.5 - (below + room[1] / 2)) * whole * up
        distance = 4 * max(high[i] - low[i] for i in range(3)) + whole
        self.view.CameraFocalPoint = list(focus)
        self.view.CameraPosition = list(focus + distance * towards)
        self.view.CameraViewUp = list(up)
        self.view.CameraParallelScale = whole / 2
        self.view.CenterOfRotation = list(centre)
        for shown, copy in self._moved:
            # ParaView 5.13 calls it otherwise than 5.11.
            setattr(shown, "Translation" if "Translation" in shown.ListProperties() else "Position", list(copy * step))
        self._near = focus + 0.45 * distance * towards  # in front of everything
        self._axes = (right, up, whole, aspect)
        for i, name in enumerate(self._copies):
            place = (numpy.array(low) + high) / 2 + i * step - 0.5 * wide * right + 0.42 * tall * up - focus
            self.stand(self._names[i], name, 0.5 + place @ right / (whole * aspect), 0.5 + place @ up / whole)
        if self._orbit == 0:
            length = round_above(0.06 * whole * aspect)
            self._show_length(self._scale, self._scale_words, 0.015, length, quantity(length, "m"))

    def _show_length(self, line, words, x, length, text):
        """A line of a length, m, that begins at x, with words over it. Returns where it ends."""
        right, up, whole, aspect = self._axes
        begin = self._near + (x - 0.5) * whole * aspect * right + (self._height(0.8) - 0.5) * whole * up
        line.Point1, line.Point2 = list(begin), list(begin + length * right)
        self.stand(words, text, x, self._height(1.2))
        return x + max(length / (whole * aspect), len(text) * 0.55 * self._size / self.view.ViewSize[0])

    def set_keys(self, *keys):
        """What the lines of the keys mean: (length in m, words) for each, in their order. @pre place_camera has placed the camera"""
        if not self._placed or self._orbit > 0:
            return
        x = 0.16
        for (line, words), (length, text) in zip(self._keys, keys):
            x = self._show_length(line, words, x, length, text) + 0.03


def listed_times(file, pattern):
    """Times by step of the pictures that a table lists: those drawn before the run was interrupted and resumed."""
    times = {}
    try:
        if not stat.S_ISREG(os.lstat(file).st_mode):  # not to be led elsewhere, or to wait for a pipe
            return times
        with open(file, encoding="utf-8") as table:
            for line in table.read().splitlines()[1:]:
                time, *_, name = line.split(",")
                picture = pattern.fullmatch(name)
                if picture:
                    times[int(picture[1])] = float(time)
    except (OSError, ValueError):  # there is none, or not of this form
        pass
    return times


def outside(surface):
    """The faces of a surface that no crack has laid bare."""
    return Threshold(Input=surface, Scalars=["CELLS", "crack"], LowerThreshold=0, UpperThreshold=0.5, ThresholdMethod="Between")


def table_range(table, low, high):
    if high <= low:
        high = low + (abs(low) or 1.0)
    table.RescaleTransferFunction(low, high)
