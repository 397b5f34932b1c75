"""pvpython draw_report.py RUN FOLDER [--plugin FILE] [--up x|y|z] [--no-pictures]

What `breccia report` shows of a run's frames: pictures and statistics, made by the plugin's filters. Writes PNG files into
FOLDER, and figures.json beside them: anew after each part, so that what is done stays when a later part takes too long.
A part that fails is named in "problems"; the others continue."""
import argparse
import json
import os
import sys

import numpy as np
import paraview
from paraview import servermanager
from paraview.simple import *  # noqa: F403: ParaView's way
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFileOutputWindow, vtkOutputWindow

SIZE = [900, 600]
INK = [0.13, 0.14, 0.17]
PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
LARGEST = 10  # rows of a table
AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def prefix(largest):
    """(factor, prefix): values up to `largest` are at least 1 in the unit with that prefix."""
    return next(((f, p) for f, p in PREFIXES if abs(largest) >= f), PREFIXES[3] if largest == 0 else PREFIXES[-1])


def version():
    of = servermanager.vtkSMProxyManager
    return f"{of.GetVersionMajor()}.{of.GetVersionMinor()}.{of.GetVersionPatch()}"


def data_of(source, port=0):
    return source.GetClientSideObject().GetOutputDataObject(port)


def column(table, name):
    array = table.GetRowData().GetArray(name)
    if array is None:
        raise RuntimeError(f"no column '{name}'")
    return vtk_to_numpy(array)


def facts(thing):
    """Numbers in the field data that are finite."""
    fields = thing.GetFieldData()
    found = {}
    for i in range(fields.GetNumberOfArrays()):
        array = fields.GetArray(i)
        if array is not None and array.GetNumberOfTuples() == 1 and np.isfinite(array.GetComponent(0, 0)):
            found[array.GetName()] = array.GetComponent(0, 0)
    return found


def words(thing):
    """Texts in the field data."""
    fields = thing.GetFieldData()
    arrays = [fields.GetAbstractArray(i) for i in range(fields.GetNumberOfArrays())]
    return {array.GetName(): array.GetValue(0) for array in arrays if array.IsA("vtkStringArray") and array.GetNumberOfValues() == 1}


def finite(thing):
    """The same with None, which JSON knows, for numbers that are not finite."""
    if isinstance(thing, dict):
        return {key: finite(value) for key, value in thing.items()}
    if isinstance(thing, (list, tuple)):
        return [finite(value) for value in thing]
    return None if isinstance(thing, float) and not np.isfinite(thing) else thing


def rows(table, names, order, count=LARGEST):
    """The first rows in an order, as lists."""
    chosen = order[:count]
    return [{name: column(table, name)[i].tolist() for name in names} for i in chosen]


class Drawing:
    def __init__(self, arguments):
        self.folder, self.up = arguments.folder, arguments.up
        self.draws = arguments.pictures
        self.result = {"paraview": version(), "pictures": [], "problems": []}
        self.log = os.path.join(self.folder, "messages.log")
        window = vtkFileOutputWindow()
        window.SetFileName(self.log)
        window.FlushOn()
        vtkOutputWindow.SetInstance(window)
        self.said = 0
        self.file, self.times = arguments.run, []

    def messages(self):
        """Messages of ParaView since the last call: the last words of each error, once."""
        if not os.path.exists(self.log):
            return []
        with open(self.log, encoding="utf-8", errors="replace") as file:
            file.seek(self.said)
            text = file.read()
            self.said = file.tell()
        kept = []
        for block in text.split("\n\n"):
            words = block.split("):", 1)[-1].strip().replace("\n", " ") if "ERROR" in block else ""
            if words and words not in kept:
                kept.append(words[:400])
        return kept

    def part(self, name, work):
        try:
            work()
        except Exception as error:  # whatever it is, the other parts go on
            self.result["problems"].append(f"{name}: {error}")
        self.result["problems"] += [f"{name}: {words}" for words in self.messages()]
        self.write()

    def write(self):
        path = os.path.join(self.folder, "figures.json")
        with open(path + ".tmp", "w", encoding="utf-8") as file:
            json.dump(finite(self.result), file, allow_nan=False)
        os.replace(path + ".tmp", path)

    # Views.

    def view(self, time):
        view = CreateView("RenderView")
        view.ViewSize = SIZE
        view.UseColorPaletteForBackground = 0
        view.Background = [1, 1, 1]
        view.OrientationAxesLabelColor = INK
        view.CameraParallelProjection = 1
        view.ViewTime = time
        return view

    def coloured(self, source, view, array, title, unit, preset, association="CELLS", highest=None):
        """Shows a source in the colours of an array, in a unit with a fitting prefix. @return  the representation"""
        source.UpdatePipeline(view.ViewTime)
        info = (source.CellData if association == "CELLS" else source.PointData)[array]
        low, high = info.GetRange() if highest is None else (0.0, highest)
        if low < high < low + 1e-3 * abs(high):  # marks could not be told apart
            low = min(low, 0.0)
        factor, letter = prefix(max(abs(low), abs(high)))
        kind = "Cell Data" if association == "CELLS" else "Point Data"
        name = f"{title} [{letter}{unit}]" if unit else title
        scaled = Calculator(Input=source, AttributeType=kind, Function=f"{array}*{1 / factor:.17g}", ResultArrayName=name)
        shown = Show(scaled, view)
        ColorBy(shown, (association, name))
        table = GetColorTransferFunction(name)
        table.ApplyPreset(preset, True)
        low = low if high > low else min(low, 0.0)
        table.RescaleTransferFunction(low / factor, high / factor if high > low else low / factor + 1)
        bar = GetScalarBar(table, view)
        bar.Title, bar.ComponentTitle = name, ""
        bar.TitleColor = bar.LabelColor = INK
        bar.TitleFontSize = bar.LabelFontSize = 21
        bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%-#6.3g", "%-#6.3g"
        bar.WindowLocation, bar.ScalarBarLength = "Any Location", 0.6
        bar.Position = [0.85, 0.2]
        shown.SetScalarBarVisibility(view, True)
        shown.Ambient, shown.Specular = 0.3, 0.0
        return shown

    def save(self, view, name, title, text, points, below=False):
        """points: (n, 3) what the picture must show; outermost hundredths may fly out of it."""
        up = np.array(AXES[self.up])
        right = np.roll(up, 2) if self.up == "y" else np.roll(up, 1)
        front = np.cross(right, up)
        look = 0.5 * right + (-0.9 if below else 0.8) * up + 1.1 * front
        look /= np.linalg.norm(look)
        side = np.cross(up, look)
        side /= np.linalg.norm(side)
        upwards = np.cross(look, side)
        shadow = points @ np.column_stack((side, upwards, look))
        low, high = np.quantile(shadow, 0.005, axis=0), np.quantile(shadow, 0.995, axis=0)
        middle, extent = (low + high) / 2, high - low
        scale = 0.56 * max(extent[1], extent[0] / (0.78 * SIZE[0] / SIZE[1]), 1e-12)
        centre = middle @ np.array([side, upwards, look]) + 0.12 * scale * SIZE[0] / SIZE[1] * side
        reach = 4 * float(np.linalg.norm(shadow.max(axis=0) - shadow.min(axis=0))) + scale
        view.CameraFocalPoint, view.CameraPosition, view.CameraViewUp = list(centre), list(centre + reach * look), list(up)
        view.CameraParallelScale = scale
        Render(view)
        file = name + ".png"
        SaveScreenshot(os.path.join(self.folder, file), view, ImageResolution=SIZE, CompressionLevel="9")
        self.result["pictures"].append({"file": file, "title": title, "text": text, "time": view.ViewTime})
        Delete(view)

    def outline(self, view):
        """The box that the bodies filled in the first frame."""
        shown = Show(ForceTime(Input=self.elements, ForcedTime=self.times[0]), view)
        shown.Representation = "Outline"
        shown.ColorArrayName = ["CELLS", ""]
        shown.AmbientColor = shown.DiffuseColor = [0.45, 0.48, 0.52]

    def edges(self, view):
        """Edges of failed joints, so that fragments of like size are seen apart."""
        shown = Show(self.cracks, view)
        shown.Representation, shown.LineWidth = "Wireframe", 1.5
        shown.ColorArrayName = ["CELLS", ""]
        shown.AmbientColor = shown.DiffuseColor = INK

    def centres(self, time):
        self.elements.UpdatePipeline(time)
        block = data_of(self.elements)
        while block.IsA("vtkCompositeDataSet"):
            block = block.GetBlock(0)
        return vtk_to_numpy(block.GetPoints().GetData())[::4].astype(float)

    def box(self):
        """Corners of the box that the bodies filled in the first frame."""
        self.elements.UpdatePipeline(self.times[0])
        bounds = self.elements.GetDataInformation().GetBounds()
        return np.array([[bounds[i], bounds[2 + j], bounds[4 + k]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])

    def frame_at_most_of(self, name):
        """Time of the frame at which a column of the history is the largest; of the last one where there is none."""
        history = data_of(self.run, 1)
        if history.GetRowData().GetArray(name) is None or history.GetNumberOfRows() == 0:
            return self.times[-1]
        at_frames = np.interp(self.times, column(history, "time [s]"), column(history, name))
        return self.times[int(at_frames.argmax())]

    # Parts.

    def start(self):
        self.run = BrecciaReader(registrationName="run", FileName=self.file)
        self.run.UpdatePipelineInformation()
        values = self.run.TimestepValues  # of one frame: a number
        times = [values] if isinstance(values, (int, float)) else list(values or ())
        if not times:
            raise RuntimeError("the run holds no whole frame")
        time = times[-1]
        self.run.UpdatePipeline(time)
        self.result["frames"], self.result["time"] = len(times), time
        blocks = data_of(self.run)
        self.channels = [blocks.GetMetaData(i).Get(blocks.NAME()) for i in range(blocks.GetNumberOfBlocks())]
        self.elements = ExtractBlock(registrationName="elements", Input=self.run, Selectors=["/Root/elements"])
        self.cracks = FractureSurface(registrationName="Fracture Surface", Input=self.run, Up=self.up.upper())
        self.times = times

    def stress(self):
        time = self.frame_at_most_of("elastic [J]")
        if not self.draws:
            return
        view = self.view(time)
        self.elements.UpdatePipeline(time)
        block = data_of(self.elements).GetBlock(0)
        values = vtk_to_numpy(block.GetCellData().GetArray("von_mises"))
        self.coloured(self.elements, view, "von_mises", "von Mises stress", "Pa", "Viridis (matplotlib)",
                      highest=float(np.quantile(values[np.isfinite(values)], 0.995)))
        self.save(view, "stress", "Stress", "Von Mises stress of the elements when the elastic energy is largest; colours end at the "
                  "stress that half a percent of the elements exceed.", self.centres(time))

    def fragments(self):
        time = self.times[-1]
        found = Fragments(registrationName="Fragments", Input=self.run)
        found.UpdatePipeline(time)
        table, sieve = data_of(found, 1), data_of(found, 2)
        mass = column(table, "mass")
        part = {"count": int(table.GetNumberOfRows()), "mass": float(mass.sum()), **facts(sieve), **words(sieve)}
        names = [n for n in ("fragment", "body", "elements", "mass", "volume", "diameter", "velocity", "spin", "elongation", "flatness",
                             "sphericity") if table.GetRowData().GetArray(n) is not None]
        part["largest"] = rows(table, names, np.argsort(-mass, kind="stable"))
        if sieve.GetNumberOfRows() > 0:
            curves = {name: column(sieve, name) for name in ("size", "passing", "rosin_rammler", "swebrec")
                      if sieve.GetRowData().GetArray(name) is not None}
            part["sieve"] = {name: [v if np.isfinite(v) else None for v in values.tolist()] for name, values in curves.items()}
        self.result["fragments"] = part
        if self.draws:
            for below in (False, True):
                view = self.view(time)
                self.coloured(found, view, "fragment_diameter", "diameter", "m", "Viridis (matplotlib)")
                self.edges(view)
                self.save(view, "fragments_below" if below else "fragments", "Fragments from below" if below else "Fragments",
                          "Fragments by the diameter of a sphere of the same volume, at the last frame"
                          + (", seen from below." if below else "."), self.centres(time), below)

    def fracture(self):
        time = self.times[-1]
        found = self.cracks
        found.UpdatePipeline(time)
        surface, tip = data_of(found), data_of(found, 3)
        self.result["cracks"] = {**facts(surface), **{f"tip_{k}": v for k, v in facts(tip).items()}}
        if surface.GetNumberOfCells() > 0 and self.draws:
            view = self.view(time)
            self.coloured(found, view, "time_of_failure", "time of failure", "s", "Plasma (matplotlib)")
            self.outline(view)
            self.save(view, "cracks", "Fracture surfaces", "Faces of all failed joints, by the time at which they failed; the box is that "
                      "of the bodies in the first frame.", self.box())

    def events(self):
        time = self.times[-1]
        found = CrackEvents(registrationName="Crack Events", Input=self.run)
        found.UpdatePipeline(time)
        table, sizes = data_of(found, 1), data_of(found, 2)
        part = {"count": int(table.GetNumberOfRows()), **facts(table), **facts(sizes)}
        if part["count"] > 0:
            part["largest"] = rows(table, ("event", "time", "duration", "joints", "area", "energy", "centre", "energy_magnitude"),
                                   np.argsort(-column(table, "energy"), kind="stable"))
            part["magnitudes"] = {name: column(sizes, name).tolist() for name in ("magnitude", "events_of_it_or_more",
                                                                                  "gutenberg_richter")}
        self.result["events"] = part
        if part["count"] > 0 and self.draws:
            view = self.view(time)
            wide = Calculator(Input=found, AttributeType="Point Data", Function="sqrt(area)", ResultArrayName="width")
            balls = Glyph(Input=wide, GlyphType="Sphere", ScaleArray=["POINTS", "width"], GlyphMode="All Points")
            body = self.box()
            extent = float(np.max(np.ptp(body, axis=0)))
            balls.ScaleFactor = 0.06 * extent / float(np.sqrt(column(table, "area").max()))
            self.coloured(balls, view, "time", "time", "s", "Plasma (matplotlib)", "POINTS")
            self.outline(view)
            self.save(view, "events", "Crack events", "Events (joints that failed near each other in space and time): spheres as wide as the "
                      "root of their area, by their time.", body)

    def contacts(self):
        if "contacts" not in self.channels:
            return
        time = self.frame_at_most_of("contacts")
        found = ContactNetwork(registrationName="Contact Network", Input=self.run)
        found.UpdatePipeline(time)
        chains, of_fragments, walls = (data_of(found, port) for port in range(3))
        part = {"time": time, **facts(of_fragments), "fragments": int(of_fragments.GetNumberOfRows()), "walls": []}
        if walls.GetNumberOfRows() > 0:
            force = column(walls, "force")
            part["walls"] = rows(walls, ("body", "other_body", "force", "contacts"),
                                 np.argsort(-np.linalg.norm(force.reshape(len(force), -1), axis=1), kind="stable"))
        self.result["contacts"] = part
        if chains.GetNumberOfCells() > 0 and self.draws:
            view = self.view(time)
            self.coloured(found, view, "force", "contact force", "N", "Plasma (matplotlib)", "POINTS")
            self.outline(view)
            self.save(view, "contacts", "Force chains", "Contact forces between fragments at the frame with the most contacts; tubes are "
                      "as thick as the force.", self.box())

    def ranks(self):
        time = self.times[-1]
        found = RankView(registrationName="Rank View", Input=self.run)
        found.UpdatePipeline(time)
        table = data_of(found, 1)
        count = int(table.GetNumberOfRows())
        self.result["ranks"] = {**facts(table), "rows": rows(table, ("rank", "elements", "cost", "load"), np.arange(count), count)}
        if count > 1 and self.draws:
            view = self.view(time)
            self.coloured(self.elements, view, "rank", "rank", "", "Viridis (matplotlib)")
            self.save(view, "ranks", "Ranks", "Which rank computes which elements, at the last frame.", self.centres(time))


def parse_arguments():
    parser = argparse.ArgumentParser(prog="draw_report.py")
    parser.add_argument("run")
    parser.add_argument("folder")
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--up", choices=list(AXES), default="z")
    parser.add_argument("--no-pictures", dest="pictures", action="store_false")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    LoadPlugin(arguments.plugin, remote=False, ns=globals())
    paraview.simple._DisableFirstRenderCameraReset()
    drawing = Drawing(arguments)
    drawing.part("frames", drawing.start)
    if not drawing.times:
        return
    for name, work in (("fragments", drawing.fragments), ("fracture", drawing.fracture), ("events", drawing.events),
                       ("contacts", drawing.contacts), ("ranks", drawing.ranks), ("stress", drawing.stress)):
        drawing.part(name, work)
    drawing.result["finished"] = True
    drawing.write()


main()
sys.stdout.flush()
