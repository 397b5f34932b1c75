"""Picture of a run: meshes/breccia-picture RUN_FOLDER OUT.png [options]

Draws what was the bodies' surface before anything broke in the colour of a field, fracture surfaces and cracks dark.
breccia-picture runs this script with pvbatch under a virtual X display.
"""
import argparse
import json
import math
import os
import sys
import tomllib

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401  registers the text renderer
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  registers the back end
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkLight, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)

from render_fields import DAMAGE, DIVERGING, FIELDS, SEQUENTIAL, numbers_of, range_of, regular
from render_surface import FACES, edges_between, outer_faces, point_numbers

INK = (0.13, 0.14, 0.17)
STONE = (0.88, 0.89, 0.90)
FRACTURE = (0.30, 0.31, 0.35)
VIEWS = {  # from where, what is up; turned so that y is against gravity (turn_of)
    "front": ((0, 0, 1), (0, 1, 0)),
    "top": ((0, 1, 0), (0, 0, -1)),
    "bottom": ((0, -1, 0), (0, 0, 1)),
    "iso": ((0.8, 0.75, 1.0), (0, 1, 0)),
}
SIZE_OF_TEXT = 0.024   # of the picture's height
FINER = 2              # drawn so many times finer than asked for, then averaged: smooth edges on any machine


def stop(message):
    sys.stdout.flush()
    print(f"breccia-picture: {message}", file=sys.stderr, flush=True)
    os._exit(2)  # pvbatch turns sys.exit into success


class Arguments(argparse.ArgumentParser):
    def error(self, message):
        self.print_usage(sys.stderr)
        stop(message)


def parse_arguments():
    parser = Arguments(prog="breccia-picture", description=__doc__.splitlines()[0])
    parser.add_argument("run", help="folder of the run")
    parser.add_argument("picture", help="PNG file to write")
    parser.add_argument("--field", choices=list(FIELDS), default="von_mises")
    when = parser.add_mutually_exclusive_group()
    when.add_argument("--time", type=float, help="s; the frame nearest to it is drawn")
    when.add_argument("--last", action="store_true", help="the last frame (default)")
    parser.add_argument("--view", choices=list(VIEWS),
                        help="up is against the gravity of the case, y where it has none; without it iso, or along the axis of a plane model")
    parser.add_argument("--size", default="1600x1000", help="pixels, WIDTHxHEIGHT")
    parser.add_argument("--range", type=float, nargs=2, metavar=("LOW", "HIGH"),
                        help="of the colours, in the unit shown; less damaged joints than LOW are left out")
    parser.add_argument("--explode", type=float, default=1.0, metavar="FACTOR",
                        help="fragments move this times as far as they did, which shows them apart")
    parser.add_argument("--hide", type=int, action="append", default=[], metavar="BODY", help="leave out this body (repeatable)")
    arguments = parser.parse_args()
    try:
        arguments.pixels = tuple(int(n) for n in arguments.size.split("x"))
        if len(arguments.pixels) != 2 or min(arguments.pixels) < 64:
            raise ValueError
    except ValueError:
        parser.error(f"--size {arguments.size}: give WIDTHxHEIGHT, at least 64x64")
    return arguments


def series(run, part):
    """[(time, file)] of the complete frames."""
    folder = os.path.join(run, "frames")
    try:
        with open(regular(os.path.join(folder, f"{part}.hdf.series")), encoding="utf-8") as index:
            return [(entry["time"], regular(os.path.join(folder, os.path.basename(entry["name"])))) for entry in json.load(index)["files"]]
    except OSError as error:
        if part == "elements":
            stop(f"{run} holds no frames of elements: {error.strerror}")
        return []


def read(file):
    """(num_cells, corners, 3) points and the cell arrays by name, by ascending id, whichever ranks have written them."""
    reader = vtkHDFReader()
    reader.SetFileName(file)
    reader.Update()
    grid = reader.GetOutput()
    cells = grid.GetNumberOfCells()
    if cells == 0:
        return np.zeros((0, 3, 3)), {}
    points = vtk_to_numpy(grid.GetPoints().GetData()).reshape(cells, -1, 3)
    data = grid.GetCellData()
    arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    order = np.argsort(arrays["id"])
    return points[order], {name: values[order] for name, values in arrays.items()}


def polydata(corners, values=None):
    """Triangles or lines with points of their own, (num_cells, 3 or 2, 3), and a value a cell."""
    n, k = corners.shape[:2]
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(corners.reshape(-1, 3)), deep=1))
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, k * n + 1, k), deep=1), numpy_to_vtkIdTypeArray(np.arange(k * n), deep=1))
    surface = vtkPolyData()
    surface.SetPoints(points)
    (surface.SetLines if k == 2 else surface.SetPolys)(cells)
    if values is not None:
        surface.GetCellData().SetScalars(numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=1))
    return surface


def table_of(stops, low, high):
    """256 colours between the stops (position 0..1, red, green, blue)."""
    function = vtkColorTransferFunction()
    for position, *colour in stops:
        function.AddRGBPoint(position, *colour)
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    table.SetTableRange(low, high)
    for i in range(256):
        table.SetTableValue(i, *function.GetColor(i / 255), 1)
    return table


def categories(ids):
    """Number of each id's colour (0 for the commonest, which stays pale) and a table of as many colours."""
    names, numbers, counts = np.unique(ids, return_inverse=True, return_counts=True)
    rank = np.empty(len(names), dtype=int)
    rank[np.argsort(-counts, kind="stable")] = np.arange(len(names))
    table = vtkLookupTable()
    table.SetNumberOfTableValues(len(names))
    table.SetTableRange(-0.5, len(names) - 0.5)
    table.SetTableValue(0, *STONE, 1)
    for i in range(1, len(names)):
        hue, light = (0.1 + 0.61803398875 * i) % 1, 0.72 + 0.2 * ((7 * i) % 5) / 4  # golden angle: neighbours differ
        table.SetTableValue(i, *(light * (1 - 0.45 * (0.5 + 0.5 * math.cos(2 * math.pi * (hue + k / 3)))) for k in range(3)), 1)
    return rank[numbers], table


def actor_of(surface, table=None, colour=None):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    if table is None:
        mapper.ScalarVisibilityOff()
    else:
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    if colour is not None:
        look.SetColor(*colour)
    look.SetInterpolationToFlat()
    look.SetAmbient(0.25)
    look.SetDiffuse(0.85)
    return actor


def lines_of(cells, width, opacity=1.0, values=None, table=None):
    """Lines, or the edges of triangles, in the colours of their values or dark; width in pixels of the picture."""
    actor = actor_of(polydata(cells, values), table, None if table else INK)
    look = actor.GetProperty()
    look.SetRepresentationToWireframe()
    look.LightingOff()
    look.SetLineWidth(FINER * width)
    look.SetOpacity(opacity)
    return actor


def add_lights(renderer):
    """From the upper left behind the viewer, and a weaker one from the right; a face towards the viewer keeps its colour."""
    renderer.AutomaticLightCreationOff()
    for place, strength in (((-0.4, 0.6, 1.0), 0.80), ((0.8, -0.2, 1.0), 0.25)):
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*place)
        light.SetIntensity(strength)
        renderer.AddLight(light)


def style(text, pixels, bold=False):
    text.SetFontFamilyToArial()
    text.SetFontSize(pixels)
    text.SetColor(*INK)
    text.SetBold(bold)
    text.SetItalic(False)
    text.SetShadow(False)


def colour_bar(table, title, height):
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title + "\n ")  # the empty line keeps the title off the bar
    bar.SetMaximumNumberOfColors(256)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat(" %.3g")
    bar.UnconstrainedFontSizeOn()
    bar.SetBarRatio(0.22)
    bar.SetPosition(0.87, 0.2)
    bar.SetPosition2(0.1, 0.6)
    style(bar.GetLabelTextProperty(), round(0.9 * SIZE_OF_TEXT * height))
    style(bar.GetTitleTextProperty(), round(0.9 * SIZE_OF_TEXT * height))
    return bar


def time_text(seconds):
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("\u00b5s", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.4g} {unit}"
    return "0" if seconds == 0 else f"{seconds / 1e-9:.4g} ns"


def counted(number, what):
    return f"{number:,} {what}" + ("" if number == 1 else "s")


def label(text, height, x, y, bold=False):
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.SetPosition(x * height, y * height)
    style(actor.GetTextProperty(), round(SIZE_OF_TEXT * height * (1.15 if bold else 1.0)), bold)
    return actor


def last_value(function):
    """Of a number or a function of time of a case."""
    if isinstance(function, dict):
        function = function.get("table", [[0, 0]])[-1][1] + function.get("constant", 0)
    return float(function) if isinstance(function, (int, float)) else 0.0


def case_of(run):
    """The resolved case of a run; empty: it cannot be read."""
    try:
        with open(regular(os.path.join(run, "case.toml")), "rb") as file:
            return tomllib.load(file)
    except (OSError, ValueError):
        return {}


def plane_axis(case):
    """0 to 2, along which nothing moves in a plane model; None: it is none."""
    plane = case.get("plane")
    return "xyz".find(plane.get("axis", "z")) if isinstance(plane, dict) else None


def gravity_of(case):
    """The first that is not zero, or none."""
    try:
        along = [np.array([last_value(g) for g in stage.get("gravity", [0, 0, 0])]) for stage in case.get("stage", [])]
    except (TypeError, AttributeError, IndexError):
        return None
    return next((g for g in along if g.any()), None)


def turn_of(case):
    """Rotation that turns the views so that what is up is against gravity; none where the case has none, or it is along y."""
    gravity = gravity_of(case)
    gravity = np.array([0.0, -1.0, 0.0]) if gravity is None else gravity
    axis = int(np.argmax(np.abs(gravity)))
    turn = {0: [[0, 1, 0], [-1, 0, 0], [0, 0, 1]], 1: np.eye(3), 2: [[1, 0, 0], [0, 0, -1], [0, 1, 0]]}[axis]
    upright = 1.0 if gravity[axis] < 0 else -1.0
    return np.array(turn, dtype=float) @ np.diag([1.0, upright, upright])


def view_of(arguments, case):
    """From where, what is up. A plane model is looked at along its axis unless the view is given."""
    turn, axis = turn_of(case), plane_axis(case)
    if arguments.view is not None or axis is None:
        return [turn @ np.array(v, dtype=float) for v in VIEWS[arguments.view or "iso"]]
    up = turn @ np.array([0.0, 1.0, 0.0])
    return [np.eye(3)[axis], up if abs(up[axis]) < 0.5 else np.eye(3)[(axis + 1) % 3]]


def aim(renderer, points, view, aspect):
    """Turns the camera so that the points fill the picture's left nine tenths; the colour bar has the rest. Returns
    the height of the picture, m. `view`: from where, what is up."""
    towards, up = (np.array(v, dtype=float) for v in view)
    towards /= np.linalg.norm(towards)
    right = np.cross(up, towards)
    right /= np.linalg.norm(right)
    up = np.cross(towards, right)
    shadow = np.column_stack((points @ right, points @ up, points @ towards))
    low, high = shadow.min(axis=0), shadow.max(axis=0)
    middle = (low + high) / 2
    scale = 0.5 * max((high - low)[1] / 0.86, (high - low)[0] / (0.82 * aspect))
    centre = middle[0] * right + middle[1] * up + middle[2] * towards + 0.05 * aspect * 2 * scale * right
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(scale)
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*(centre + towards * 4 * max(np.ptp(points, axis=0))))
    camera.SetViewUp(*up)
    return 2 * scale


def exploded(points, arrays, factor):
    """Points of the elements with each fragment moved on by (factor - 1) times its mean displacement."""
    numbers = np.unique(arrays["fragment"], return_inverse=True)[1]
    sums = np.stack([np.bincount(numbers, weights=component) for component in arrays["displacement"].T], axis=1)
    return points + (factor - 1) * (sums / np.bincount(numbers)[:, None])[numbers][:, None, :]


def in_view(reference, now):
    """Points the picture must show: the reference shape and where almost all of the material is now (dust may fly out)."""
    centres = now.mean(axis=1)
    near = np.all((centres >= np.quantile(centres, 0.01, axis=0)) & (centres <= np.quantile(centres, 0.99, axis=0)), axis=1)
    shown = now[near].reshape(-1, 3) if near.any() else now.reshape(-1, 3)
    return np.concatenate((reference.reshape(-1, 3), shown))


def surface_actor(arguments, triangles, arrays, elements):
    """The fragments' surface, its colour table and the title of the bar (None: no bar)."""
    if FIELDS[arguments.field] is None:
        numbers, table = categories(arrays[arguments.field])
        return actor_of(polydata(triangles, numbers[elements]), table), None, None
    title, unit, size, array, component = FIELDS[arguments.field]
    title += f"\n[{unit}]" if unit else ""
    if arguments.field == "damage":
        return actor_of(polydata(triangles), colour=STONE), table_of(DAMAGE, *(arguments.range or (0, 1))), title
    values = numbers_of(arrays[array], component)[elements].astype(float) / size
    signed = component is not None and array != "von_mises"
    table = table_of(DIVERGING if signed else SEQUENTIAL, *(arguments.range or range_of(values, signed)))
    return actor_of(polydata(triangles, values), table), table, title


def add_joints(renderer, arguments, time, table, line, narrow, layer):
    """Broken joints dark, with their edges where they gape less than `narrow` (m): wider cracks show by themselves. In a
    picture of the damage also the others, in the table's colours. Returns how many are broken."""
    frames = [frame for frame in series(arguments.run, "joints") if frame[0] == time]
    joints, arrays = read(frames[0][1]) if frames else (np.zeros((0, 3, 3)), {})
    if len(joints) == 0:
        return 0
    broken = arrays["broken"] != 0
    if arguments.explode != 1:  # the joints lie where the fragments were
        return int(broken.sum())
    if arguments.field == "damage":
        drawn = ~broken & (arrays["damage"] >= table.GetTableRange()[0])
        coloured = actor_of(polydata(joints[drawn], arrays["damage"][drawn]), table)
        coloured.GetProperty().SetAmbient(0.6)
        renderer.AddActor(coloured)
        if layer:  # they stand on edge
            renderer.AddActor(lines_of(joints[drawn], 2 * line, values=arrays["damage"][drawn], table=table))
    if broken.any():
        renderer.AddActor(actor_of(polydata(joints[broken]), colour=FRACTURE))
        renderer.AddActor(lines_of(joints[broken & (arrays["opening"] < narrow)], line))
    return int(broken.sum())


def build(arguments):
    frames = series(arguments.run, "elements")
    if not frames:
        stop(f"{arguments.run} holds no complete frame")
    wanted = frames[-1][0] if arguments.time is None else arguments.time
    time, file = min(frames, key=lambda frame: abs(frame[0] - wanted))
    if not frames[0][0] * (1 - 1e-9) <= wanted <= frames[-1][0] * (1 + 1e-9):
        print(f"breccia-picture: there are frames from {frames[0][0]:g} to {frames[-1][0]:g} s: the one at {time:g} s is drawn",
              file=sys.stderr, flush=True)
    reference, first = read(frames[0][1])
    now, arrays = read(file)
    if len(now) == 0 or len(reference) != len(now) or not np.array_equal(first["id"], arrays["id"]):
        stop(f"{file} and the first frame do not hold the same elements")
    now = exploded(now, arrays, arguments.explode)
    shown = ~np.isin(arrays["body"], arguments.hide)
    if not shown.any():
        stop("every body is hidden")
    numbers = point_numbers(reference, first["neighbour"], first["id"])
    whole = outer_faces(numbers, first["fragment"]) & shown[:, None]
    fracture = outer_faces(numbers, arrays["fragment"]) & shown[:, None] & ~whole
    elements, faces = np.nonzero(whole)

    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetBackground2(0.90, 0.92, 0.94)
    renderer.GradientBackgroundOn()
    add_lights(renderer)
    width, height = (FINER * n for n in arguments.pixels)
    surface, table, title = surface_actor(arguments, now[elements[:, None], FACES[faces]], arrays, elements)
    renderer.AddActor(surface)
    if table is not None:
        renderer.AddViewProp(colour_bar(table, title, height))
    elements, faces = np.nonzero(fracture)
    if len(elements) > 0 and arguments.field != "damage":
        renderer.AddActor(actor_of(polydata(now[elements[:, None], FACES[faces]]), colour=FRACTURE))
    line = max(1.0, arguments.pixels[1] / 700)
    for (owner, ends), opacity in zip(edges_between(numbers, reference, whole, arrays["fragment"]), (1.0, 0.6)):
        if len(owner) > 0:
            renderer.AddActor(lines_of(now[owner[:, None], ends], line, opacity))
    case = case_of(arguments.run)
    tall = aim(renderer, in_view(reference[shown], now[shown]), view_of(arguments, case), width / height)
    if arguments.field == "damage":
        surface.GetProperty().SetOpacity(0.35)
    broken = add_joints(renderer, arguments, time, table, line, 3 * tall / arguments.pixels[1], plane_axis(case) is not None)
    fragments = len(np.unique(arrays["fragment"][shown]))
    texts = (f"t = {time_text(time)}", counted(fragments, "fragment"), counted(broken, "broken joint"))
    for i, text in enumerate(texts):
        renderer.AddViewProp(label(text, height, 0.03, 0.945 - 0.036 * i, bold=i == 0))
    renderer.ResetCameraClippingRange()
    return renderer


def main():
    arguments = parse_arguments()
    if not os.environ.get("DISPLAY"):
        stop("drawing needs an X display; breccia-picture starts a virtual one (Debian: apt-get install xvfb xauth)")
    renderer = build(arguments)
    renderer.UseDepthPeelingOn()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*(FINER * n for n in arguments.pixels))
    window.AddRenderer(renderer)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    save(grab.GetOutput(), arguments)


def save(fine, arguments):
    width, height = arguments.pixels
    colours = vtk_to_numpy(fine.GetPointData().GetScalars()).reshape(height, FINER, width, FINER, 3)
    mean = np.rint(colours.mean(axis=(1, 3))).astype(np.uint8)
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(mean.reshape(-1, 3), deep=1))
    writer = vtkPNGWriter()
    writer.SetFileName(arguments.picture)
    writer.SetInputData(image)
    writer.Write()
    if writer.GetErrorCode() != 0:
        stop(f"cannot write {arguments.picture}")


main()
