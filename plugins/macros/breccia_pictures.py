"""The five usual pictures of a run: cracks, fragments, stress, contacts, energy.

For ParaView's Python, in its window and in pvpython. Lies beside Breccia.so, the plugin, and loads it. Each function makes a layout of its own
and returns its views. The run is the one given (what BrecciaReader has returned) or that of the active source. All quantities are SI."""
import os
import stat
import tomllib

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

INK = [0.13, 0.14, 0.17]
GREY = [0.45, 0.48, 0.52]
SIZE = None            # of views: that of ParaView's window; pvpython, which has none, sets it
LOWER_SHARE = 0.995    # of the elements have a stress below the end of its colours
ZOOM = 1.2             # nearer than ParaView's own look at all there is
UP = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_filters = {}


class NoPicture(RuntimeError):
    """There is no run, or it lacks what the picture is of."""


def made(kind, **properties):
    """A reader or filter of the plugin's, or one of ParaView's own."""
    if not _filters:
        plugin = os.path.join(os.path.dirname(os.path.abspath(__file__)), "Breccia.so")
        simple.LoadPlugin(os.environ.get("BRECCIA_PARAVIEW_PLUGIN", plugin), remote=False, ns=_filters)
    return (_filters.get(kind) or getattr(simple, kind))(**properties)


def run_of(source=None):
    """The reader that a source, or else the active one, comes from; or else any reader of runs."""
    source = source or simple.GetActiveSource()
    while source is not None and source.GetXMLName() != "BrecciaReader":
        inputs = source.GetProperty("Input")
        source = inputs[0] if inputs is not None and len(inputs) else None
        source = getattr(source, "SMProxy", source) and source
    readers = [proxy for proxy in simple.GetSources().values() if proxy.GetXMLName() == "BrecciaReader"]
    if source is None and not readers:
        raise NoPicture("no run is open: File > Open its status.jsonl, then once more")
    return source or readers[0]


def folder_of(run):
    name = run.FileName
    name = name if isinstance(name, str) else name[0]
    while name and not os.path.isdir(os.path.join(name, "frames")) and os.path.dirname(name) != name:
        name = os.path.dirname(name)
    return name


def last_value(function):
    """Of a number or a function of time of a case."""
    if isinstance(function, dict):
        function = function.get("table", [[0, 0]])[-1][1] + function.get("constant", 0)
    return float(function) if isinstance(function, (int, float)) else 0.0


def regular(path):
    """The path of a regular file. A run's folder may be another's: a link would lead out of it, a pipe would be read for ever."""
    if not stat.S_ISREG(os.lstat(path).st_mode):
        raise OSError(f"{path} is no regular file")
    return path


def up_of(run):
    """The axis against gravity, or else that of the first velocity, or else z."""
    try:
        with open(regular(os.path.join(folder_of(run), "case.toml")), "rb") as file:
            case = tomllib.load(file)
        gravity = np.sum([[last_value(g) for g in stage.get("gravity", [0, 0, 0])] for stage in case.get("stage", [])] or [[0, 0, 0]],
                         axis=0)
        velocity = np.max([np.abs(start.get("velocity", [0, 0, 0])) for start in case.get("initial_velocity", [])] or [[0, 0, 0]], axis=0)
    except (OSError, ValueError, TypeError, AttributeError, IndexError):
        return "z"
    for vector in (gravity, velocity):
        if np.any(vector != 0):
            return "xyz"[int(np.argmax(np.abs(vector)))]
    return "z"


def times_of(run):
    run.UpdatePipelineInformation()
    times = run.TimestepValues
    return list(times) if hasattr(times, "__len__") else [times]


def time_shown(run, time=None):
    """The time given, that of the animation where there is a frame of it, or else the last one."""
    times = times_of(run)
    if time is None:
        simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
        now = simple.GetAnimationScene().AnimationTime
        time = now if times[0] < now <= times[-1] else times[-1]
    simple.GetAnimationScene().AnimationTime = time
    return time


def layout_with(count, name):
    """A new layout with room for `count` views side by side."""
    layout = simple.CreateLayout(name)
    if count > 1:
        layout.SplitHorizontal(0, 0.5)
    return layout


def placed(kind, layout, cell, time):
    simple._DisableFirstRenderCameraReset()
    view = simple.CreateView(kind)
    simple.AssignViewToLayout(view=view, layout=layout, hint=cell)
    if SIZE:
        view.ViewSize = SIZE
    if kind == "RenderView":
        view.UseColorPaletteForBackground = 0
        view.Background = [1.0, 1.0, 1.0]
        view.OrientationAxesLabelColor = INK
        view.ViewTime = time
    return view


def coloured(source, view, array, association="CELLS", highest=None):
    """Shows a source by an array, in the colours and with the title that the plugin gives it. @return  the representation"""
    source.UpdatePipeline(view.ViewTime)
    if (source.CellData if association == "CELLS" else source.PointData).GetArray(array) is None:
        raise NoPicture(f"there is nothing with an array '{array}' at {view.ViewTime:g} s")
    shown = simple.Show(source, view)
    simple.ColorBy(shown, (association, array))
    table = simple.GetColorTransferFunction(array)
    if not table.InterpretValuesAsCategories:
        shown.RescaleTransferFunctionToDataRange(False, True)
        if highest is not None:
            table.RescaleTransferFunction(0.0, highest)
    bar = simple.GetScalarBar(table, view)
    bar.TitleColor = bar.LabelColor = INK
    bar.WindowLocation, bar.Position, bar.ScalarBarLength = "Any Location", [0.85, 0.2], 0.6  # its title runs beside it, whole
    shown.SetScalarBarVisibility(view, True)
    shown.Ambient, shown.Specular = 0.3, 0.0
    return shown


def outlined(source, view, representation="Outline", colour=GREY):
    shown = simple.Show(source, view)
    shown.Representation = representation
    shown.ColorArrayName = ["CELLS", ""]
    shown.AmbientColor = shown.DiffuseColor = colour
    return shown


def looked_at(view, up, below=False):
    axis = np.array(UP[up])
    right = np.roll(axis, 2) if up == "y" else np.roll(axis, 1)
    look = 0.5 * right + (-0.9 if below else 0.8) * axis + 1.1 * np.cross(right, axis)
    view.CameraFocalPoint, view.CameraPosition, view.CameraViewUp = [0.0, 0.0, 0.0], list(look), list(axis)
    view.ResetCamera(False)
    view.CameraViewAngle /= ZOOM
    simple.Render(view)


def charted(view, source, x, columns, titles, legend, logarithmic=(0, 0)):
    """Curves of a table. columns: pairs of a column's name and what the legend calls it"""
    shown = simple.Show(source, view, "XYChartRepresentation")
    shown.UseIndexForXAxis = 0
    shown.XArrayName = x
    shown.SeriesVisibility = [name for name, _ in columns]
    shown.SeriesLabel = [text for pair in columns for text in pair]
    view.BottomAxisTitle, view.LeftAxisTitle = titles
    simple.SetActiveSource(run_of(source))  # an editor of series that opens for the active source would switch them off
    view.LegendLocation = legend
    view.BottomAxisLogScale, view.LeftAxisLogScale = logarithmic
    simple.Render(view)
    return shown


def elements_of(run):
    return made("ExtractBlock", registrationName="elements", Input=run, Selectors=["/Root/elements"])


def cracks(run=None, time=None):
    """The faces of failed joints: by mode on the left, by time of failure on the right."""
    run = run_of(run)
    time, up = time_shown(run, time), up_of(run)
    surface = made("FractureSurface", registrationName="Fracture Surface", Input=run, Up=up.upper())
    body = elements_of(run)
    surface.UpdatePipeline(time)
    if surface.GetDataInformation().GetNumberOfCells() == 0:
        raise NoPicture(f"no joint has failed until {time:g} s")
    layout, views = layout_with(2, "Cracks"), []
    for cell, array in ((1, "mode"), (2, "time_of_failure")):
        view = placed("RenderView", layout, cell, time)
        coloured(surface, view, array)
        outlined(body, view)
        looked_at(view, up)
        views.append(view)
    return views


def fragments(run=None, time=None):
    """The fragments by their diameter, with cracks as lines, and the sieve curve with its fits."""
    run = run_of(run)
    time, up = time_shown(run, time), up_of(run)
    parts = made("Fragments", registrationName="Fragments", Input=run)
    edges = made("FractureSurface", registrationName="cracks", Input=run)
    parts.UpdatePipeline(time)
    several = parts.GetDataInformation(2).GetNumberOfRows() > 1  # a curve needs two sizes
    layout = layout_with(2 if several else 1, "Fragments")
    view = placed("RenderView", layout, 1 if several else 0, time)
    coloured(parts, view, "fragment_diameter")
    edges.UpdatePipeline(time)
    if edges.GetDataInformation().GetNumberOfCells() > 0:
        outlined(edges, view, "Wireframe", INK)
    looked_at(view, up)
    if not several:
        return [view]
    chart = placed("XYChartView", layout, 2, time)
    charted(chart, simple.OutputPort(parts, 2), "size", [("passing", "mass that passes"), ("rosin_rammler", "Rosin-Rammler"),
                                                        ("swebrec", "Swebrec")], ["size [m]", "share of the mass"], "TopLeft", (1, 0))
    return [view, chart]


def stress(run=None, time=None):
    """Von Mises stress of the elements; the colours end where half a percent of the elements lies beyond."""
    run = run_of(run)
    time, up = time_shown(run, time), up_of(run)
    body = elements_of(run)
    view = placed("RenderView", layout_with(1, "Stress"), 0, time)
    body.UpdatePipeline(time)
    highest, local = None, body.GetClientSideObject()
    if local is not None:  # not on a server elsewhere
        block = local.GetOutputDataObject(0)
        while block is not None and block.IsA("vtkMultiBlockDataSet"):
            block = block.GetBlock(0)
        values = vtk_to_numpy(block.GetCellData().GetArray("von_mises")) if block is not None else np.zeros(0)
        values = values[np.isfinite(values)]
        highest = float(np.quantile(values, LOWER_SHARE)) if len(values) and values.max() > 0 else None
    coloured(body, view, "von_mises", highest=highest)
    looked_at(view, up)
    return [view]


def contacts(run=None, time=None):
    """Force chains between fragments as tubes."""
    run = run_of(run)
    time, up = time_shown(run, time), up_of(run)
    network = made("ContactNetwork", registrationName="Contact Network", Input=run)
    network.UpdatePipeline(time)
    if network.GetDataInformation().GetNumberOfCells() == 0:
        raise NoPicture(f"no fragments press on each other at {time:g} s: choose another time")
    view = placed("RenderView", layout_with(1, "Contacts"), 0, time)
    coloured(network, view, "force", "POINTS")
    outlined(elements_of(run), view)
    looked_at(view, up)
    return [view]


def energy(run=None, time=None):
    """The terms of the energy budget over time, stacked: the distance between two curves is a term."""
    run = run_of(run)
    time = time_shown(run, time)
    balance = made("EnergyBalance", registrationName="Energy Balance", Input=simple.OutputPort(run, 1))
    balance.UpdatePipeline(time)
    rows = balance.GetDataInformation().DataInformation.GetRowDataInformation()
    names = [rows.GetArrayInformation(i).GetName() for i in range(rows.GetNumberOfArrays())]
    stacked = [name for name in names if name.startswith("up to ")]
    if not stacked or balance.GetDataInformation().GetNumberOfRows() < 2:
        raise NoPicture("the run's history has no two lines yet")
    view = placed("XYChartView", layout_with(1, "Energy"), 0, time)
    charted(view, balance, "time [s]", [(name, "+ " + name[6:-4]) for name in stacked] + [("external work [J]", "external work")],
            ["time [s]", "energy, stacked [J]"], "BottomRight")
    return [view]


PICTURES = {"cracks": cracks, "fragments": fragments, "stress": stress, "contacts": contacts, "energy": energy}
