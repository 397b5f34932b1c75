"""Script of the desktop for ParaView (paraview --script=FILE): shows the frames of a run.

Bodies are coloured by stress, joints by the time at which they failed, both at the last frame; the play button of ParaView goes through all.
$BRECCIA_RESULTS is the folder of the run, $BRECCIA_RESULTS_UP the axis that is drawn upwards: x, y or z, with a minus where it is downwards.
"""

import os

from paraview.simple import (Calculator, ColorBy, GetActiveViewOrCreate, GetAnimationScene, GetColorTransferFunction, GetScalarBar,
                             OpenDataFile, Render, ResetCamera, SetActiveSource, Show, Text, Threshold)

PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "u"), (1e-9, "n"))
INK = [0.1, 0.1, 0.1]


def unit_of(largest, unit):
    """A unit in which a number has few digits, and its size."""
    for size, prefix in PREFIXES:
        if largest >= size and (unit != "s" or size <= 1.0):
            return prefix + unit, size
    return unit, 1.0


def series(folder, part):
    """The frames of a part of the model; None: there are none."""
    name = os.path.join(folder, "frames", part + ".hdf.series")
    return OpenDataFile(name, registrationName=part) if os.path.exists(name) else None


def coloured(source, array, words, unit, view, place, colours, representation="Surface"):
    """Shows the array of the cells in a unit of its own, with a key."""
    data = source.CellData.GetArray(array)
    if data is None:
        Show(source, view)
        return source
    low, high = data.GetRange()
    unit, size = unit_of(max(abs(low), abs(high)), unit)
    name = f"{words} [{unit}]"
    scaled = Calculator(registrationName=words, Input=source, AttributeType="Cell Data", ResultArrayName=name, Function=f"{array}/{size!r}")
    shown = Show(scaled, view)
    shown.SetRepresentationType(representation)
    shown.LineWidth = 3.0
    shown.Ambient, shown.Diffuse = 0.35, 0.7
    ColorBy(shown, ("CELLS", name))
    table = GetColorTransferFunction(name)
    table.ApplyPreset(colours, True)
    table.RescaleTransferFunction(low / size, high / size if high > low else low / size + 1.0)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = name, ""
    bar.TitleColor = bar.LabelColor = INK
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = bar.RangeLabelFormat = "%.3g"
    bar.WindowLocation = "Any Location"
    bar.Position, bar.ScalarBarLength = [0.86, place], 0.36
    shown.SetScalarBarVisibility(view, True)
    return scaled


def failed_only(joints, time):
    """Those that hold have the time -1."""
    broken = Threshold(registrationName="failed joints", Input=joints, Scalars=["CELLS", "time_of_failure"])
    broken.ThresholdMethod = "Above Upper Threshold"
    broken.UpperThreshold = 0.0
    broken.UpdatePipeline(time)
    return broken


def look(view, up):
    """At everything from a corner above it."""
    axis, sign = "xyz".index(up[-1]), -1.0 if up.startswith("-") else 1.0
    above = [sign if a == axis else 0.0 for a in range(3)]
    right = [0.0, 0.0, 1.0] if axis == 0 else [1.0, 0.0, 0.0]
    front = [right[1] * above[2] - right[2] * above[1], right[2] * above[0] - right[0] * above[2], right[0] * above[1] - right[1] * above[0]]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = [0.9 * r + 0.9 * u + 1.4 * f for r, u, f in zip(right, above, front)]
    view.CameraViewUp = above
    ResetCamera(view)


def open_run(folder, up="y"):
    """The view of a run; returns it."""
    view = GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    elements, joints = series(folder, "elements"), series(folder, "joints")
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.PlayMode = "Snap To TimeSteps"
    scene.AnimationTime = view.ViewTime = last = scene.EndTime
    active = None
    if elements is not None:
        elements.UpdatePipeline(last)
        active = coloured(elements, "von_mises", "von Mises stress", "Pa", view, 0.56, "Viridis (matplotlib)")
    if joints is not None:
        joints.UpdatePipeline(last)
        if joints.CellData.GetArray("time_of_failure") is not None:
            coloured(failed_only(joints, last), "time_of_failure", "time of failure", "s", view, 0.08, "Plasma (matplotlib)", "Wireframe")
    words = Text(registrationName="words", Text=os.path.basename(os.path.normpath(folder)))
    shown = Show(words, view)
    shown.Color, shown.WindowLocation, shown.FontSize = INK, "Upper Left Corner", 14
    look(view, up)
    if active is not None:
        SetActiveSource(active)
    Render(view)
    return view


if "BRECCIA_RESULTS" in os.environ:
    open_run(os.environ["BRECCIA_RESULTS"], os.environ.get("BRECCIA_RESULTS_UP", "y"))
